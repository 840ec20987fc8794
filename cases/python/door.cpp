#include "cases/python/door.hpp"
#include <omp.h>
#include "cases/driver/cost_samples.hpp"
#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/keys.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/process.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/summary.hpp"

namespace cases::door {
namespace {

CaseFile read(const Source& source) {
  return source.path.empty() ? read_case_text(source.text, "case", source.overrides)
                             : read_case(source.path, source.overrides);
}

/// The number of threads of OpenMP while this lives; 0: as it is.
class Threads {
public:
  explicit Threads(int wanted) : before_(omp_get_max_threads()) {
    omp_set_num_threads(plate::sensible_threads(wanted > 0 ? wanted : before_));
  }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

private:
  int before_;
};

template <typename Action>
auto refused(const Action& action) {
  try {
    return action();
  } catch (const CaseError& error) {
    std::vector<Wrong::Problem> problems;
    for (const auto& [place, key, what] : error.problems()) problems.push_back({place, key, what});
    throw Wrong(error.what(), std::move(problems));
  }
}

}  // namespace

Run run(const Source& source, bool fields, int threads) {
  return refused([&] {
    const plate::StopOnSignals signals;  // from the first point on: Python hears of them when all is over
    const auto file = read(source);
    const Threads these(threads);
    Run result;
    result.in_memory.wants_fields = fields;
    try {
      cases::run(file, {{}, true, &result.in_memory});
    } catch (const plate::NumericalError& error) {
      result.failure = error.what();
    }
    plate::stop_if_asked("a run that has just ended");
    return result;
  });
}

std::string check(const Source& source, int threads) {
  return refused([&] {
    const Threads these(threads);
    return cost(read(source));
  });
}

std::vector<Key> keys() {
  std::vector<Key> result;
  for (const auto& key : cases::keys()) result.push_back({key.name, key.unit, key.allowed, key.standard, key.help});
  return result;
}

std::array<std::string, 2> version() {
  return {PDPLATE_VERSION, PDPLATE_KERNELS};
}

}  // namespace cases::door
