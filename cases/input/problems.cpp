#include "cases/input/problems.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cases {
namespace {

std::string report(const std::vector<Problem>& problems) {
  constexpr std::size_t most = 100;
  std::vector<std::string> lines;
  for (const auto& problem : problems) {
    if (lines.size() == most) {
      lines.push_back(fmt::format("... and {} problems more", problems.size() - most));
      break;
    }
    lines.push_back(problem.key.empty() ? fmt::format("{}: {}", problem.place, problem.what)
                                        : fmt::format("{}: {}: {}", problem.place, problem.key, problem.what));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

CaseError::CaseError(std::vector<Problem> problems)
    : std::runtime_error(report(problems)), problems_(std::move(problems)) {}

std::string Source::place(const std::string& key) const {
  for (std::string parent = key;;) {
    for (const auto& [given, where] : places)
      if (given == parent) return where;
    if (parent.empty()) return "";
    const auto cut = parent.find_last_of(".[");
    parent.resize(cut == std::string::npos ? 0 : cut);
  }
}

}  // namespace cases
