#include "cases/python/door.hpp"
#include <omp.h>
#include <memory>
#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/keys.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/files/summary.hpp"

namespace cases::door {
namespace {

CaseFile read(const Source& source) {
  return source.path.empty() ? read_case_text(source.text, "case", source.overrides)
                             : read_case(source.path, source.overrides);
}

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
    const auto file = read(source);
    const std::shared_ptr<void> at_end(nullptr, [n = omp_get_max_threads()](void*) { omp_set_num_threads(n); });
    if (threads > 0) omp_set_num_threads(threads);
    Run result;
    result.kept.wants_fields = fields;
    try {
      cases::run(file, {{}, true, &result.kept});
    } catch (const plate::NumericalError& error) {
      result.failure = error.what();
    }
    return result;
  });
}

std::string check(const Source& source) {
  return refused([&] { return cost(read(source)); });
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
