#include "plate/model/free_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace plate {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A number of a file of the system; nothing where there is none, as in "max".
double number_in(const char* path, double otherwise) {
  double value = 0;
  return std::ifstream(path) >> value ? value : otherwise;
}

}  // namespace

double free_memory() {
  const double limit = number_in("/sys/fs/cgroup/memory.max", unlimited);
  const double left = limit - number_in("/sys/fs/cgroup/memory.current", 0);
  std::ifstream meminfo("/proc/meminfo");
  for (std::string name, unit; meminfo >> name;) {
    double kibibytes = 0;
    if (name == "MemAvailable:" && meminfo >> kibibytes) return std::min(1024 * kibibytes, std::max(left, 0.0));
    std::getline(meminfo, unit);
  }
  return left < unlimited ? std::max(left, 0.0) : 0;
}

}  // namespace plate
