#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cases {

/// Problem of a case file.
struct Problem {
  std::string place;  // file:line, or "--set KEY"
  std::string key;    // dotted path: section.poisson, load[1].edges
  std::string what;   // value, what is allowed, nearest match
};

/// A key of a case, such as "combination[0].of", and what is wrong with it.
struct KeyError {
  std::string key, what;
};

/// Exception with all problems of a case file; what() lists them, one line each.
class CaseError : public std::runtime_error {
public:
  explicit CaseError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

private:
  std::vector<Problem> problems_;
};

/// The file of a case: the place of every key that it gave, so that later checks can name file and line.
struct Source {
  std::vector<std::pair<std::string, std::string>> places;  // key -> place
  std::vector<std::string> notes = {};                      // what was changed in the case, for its warnings

  /// Place of a key, or of its nearest parent that was given.
  std::string place(const std::string& key) const;
};

}  // namespace cases
