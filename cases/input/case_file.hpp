#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "cases/input/case.hpp"
#include "cases/input/problems.hpp"

namespace cases {

/// A case together with the file that it is from.
struct CaseFile {
  Case content;
  Source source;

  std::string place(const std::string& key) const { return source.place(key); }
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
