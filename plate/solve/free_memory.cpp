#include "plate/solve/free_memory.hpp"

#include <fstream>
#include <string>

namespace plate {

double free_memory() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string name, unit; meminfo >> name;) {
    double kibibytes = 0;
    if (name == "MemAvailable:" && meminfo >> kibibytes) return 1024 * kibibytes;
    std::getline(meminfo, unit);
  }
  return 0;
}

}  // namespace plate
