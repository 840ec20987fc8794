#include "plate/formulation/discretised.hpp"

#include <algorithm>

namespace plate {

void Stopwatch::lap(const std::string& stage) {
  const auto now = std::chrono::steady_clock::now();
  add(stage, std::chrono::duration<double>(now - last_).count());
  last_ = now;
}

void Stopwatch::add(const Stopwatch& other) {
  for (const auto& [stage, spent] : other.seconds_) add(stage, spent);
}

void Stopwatch::add(const std::string& stage, double spent) {
  const auto entry = std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& s) { return s.first == stage; });
  if (entry == seconds_.end())
    seconds_.emplace_back(stage, spent);
  else
    entry->second += spent;
}

double Stopwatch::seconds(const std::string& stage) const {
  for (const auto& [name, spent] : seconds_)
    if (name == stage) return spent;
  return 0;
}

double Stopwatch::total() const {
  double sum = 0;
  for (const auto& [stage, seconds] : seconds_) sum += seconds;
  return sum;
}

}  // namespace plate
