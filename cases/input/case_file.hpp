#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>
#include "cases/input/case.hpp"

namespace cases {

/// One thing that is wrong with a case file.
struct Problem {
  std::string place;  // file:line, or "--set KEY"
  std::string key;    // dotted path: section.poisson, load[1].edges
  std::string what;   // value, what is allowed, nearest match
};

/// All problems of a case file together; what() lists them, one line each.
class CaseError : public std::runtime_error {
public:
  explicit CaseError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

private:
  std::vector<Problem> problems_;
};

/// A row of the key table.
struct Key {
  std::string name;      // dotted path; [[support]] and [[load]] as support[].kind
  std::string unit;      // "length", "force/length^2", "-"
  std::string allowed;   // bounds or list of values
  std::string standard;  // the default as TOML, "required", or "absent"
  std::string help;
};

/// The one table of keys: what is read, checked, documented and printed by `pdplate keys`.
const std::vector<Key>& keys();

/// The key table as Markdown, as it stands in cases/README.md.
std::string key_table_markdown();

/// A case together with the place of every key that its file gave, so that later checks can name file and line.
struct CaseFile {
  Case content;
  std::vector<std::pair<std::string, std::string>> places;  // key -> place
  std::vector<std::string> notes = {};                      // what was changed in the case, for its warnings

  /// Place of a key, or of its nearest parent that was given.
  std::string place(const std::string& key) const;
};

/// Reads a case file and applies the overrides in turn: "key=value" (value as TOML; a bare word is a string), or
/// "-key", which takes the key out. Checks syntax, unknown and unused keys, types, bounds, geometry, edge names. Throws
/// CaseError.
CaseFile read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides);

/// The same of text; `name` stands for the file.
CaseFile read_case_text(const std::string& text, const std::string& name, const std::vector<std::string>& overrides);

/// The whole case with all defaults as TOML: reading it gives the same case.
std::string resolved_toml(const Case& content);

}  // namespace cases
