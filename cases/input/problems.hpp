#pragma once
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
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

/// Exception with all problems of a case file; what() lists them, one line each. Settings that a problem names in
/// backticks, as messages of the folders below do, get their keys.
class CaseError : public std::runtime_error {
public:
  explicit CaseError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

private:
  std::vector<Problem> problems_;
};

/// Returns the key of a setting: of "spacing" it is "discretization.spacing", of a list "support" it is "[[support]]",
/// of an entry "support 1" it is "support[1]". Returns nothing where no single setting has this name.
std::optional<std::string> key_of_setting(std::string_view name);

/// Returns a message with the key of every setting that it names in backticks: "set `spacing` = 0.1" becomes "set
/// discretization.spacing = 0.1". Other text in backticks stays: edges may have any name.
std::string with_keys(std::string_view message);

/// The file of a case: the place of every key that it gave, so that later checks can name file and line.
struct Source {
  std::vector<std::pair<std::string, std::string>> places;  // key -> place
  std::vector<std::string> notes = {};                      // what was changed in the case, for its warnings

  /// Place of a key, or of its nearest parent that was given.
  std::string place(const std::string& key) const;
};

}  // namespace cases
