#pragma once
#include <array>
#include <stdexcept>
#include "post/files/results_in_memory.hpp"

/// Interface that Python calls. Only types of the standard library cross it (why: results_in_memory.hpp).
namespace cases::door {

/// A case as text, or the path of its file; overrides as in read_case.
struct Source {
  std::string path, text;
  std::vector<std::string> overrides;
};

struct Run {
  post::ResultsInMemory in_memory;
  std::string failure;  // of the numbers: what was good until then is kept
};

/// Exception with all problems of a case: place, key, message.
struct [[gnu::visibility("default")]] Wrong : std::runtime_error {
  using Problem = std::array<std::string, 3>;
  Wrong(const char* what, std::vector<Problem> all) : std::runtime_error(what), problems(std::move(all)) {}
  std::vector<Problem> problems;
};

using Key = std::array<std::string, 5>;  // name, unit, allowed values, default, meaning

#pragma GCC visibility push(default)
/// Runs a case; with `fields`, its frames stay in memory. `threads` 0: as many as there are. Throws Wrong.
Run run(const Source& source, bool fields, int threads);
/// Estimates the cost of a run, as text. Throws Wrong.
std::string check(const Source& source, int threads);
std::vector<Key> keys();
/// Version of the program, and the instruction set of its kernels.
std::array<std::string, 2> version();
#pragma GCC visibility pop

}  // namespace cases::door
