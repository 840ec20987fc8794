#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace cases {

/// Step of a dotted key: a name in a table or an index in a list.
using KeyStep = std::variant<std::string, std::size_t>;

/// load[0].value and load.0.value are the same key.
std::vector<KeyStep> steps(const std::string& key);

/// load[0].value
std::string dotted(const std::vector<KeyStep>& path);

/// A program as its user sees it: commands with what they take.
struct Program {
  struct Argument {
    std::string name, about;
    bool required = false;
  };
  struct Option {
    std::vector<std::string> names;  // "--set"
    std::string value, about;        // of the value; empty where there is none
  };
  struct Command {
    std::string name, about;
    std::vector<Argument> arguments;
    std::vector<Option> options;
  };
  std::string name, version, about;
  std::vector<Option> options;  // without a command
  std::vector<Command> commands;
};

/// A key of its case files.
struct ManualKey {
  std::string name;      // dotted path; tables that come in lists as support[].kind
  std::string unit;      // "length", "force/length^2", "-"
  std::string allowed;   // bounds or list of values
  std::string standard;  // the default as TOML, "required", or "absent"
  std::string help;
};

/// Two lines for each key whose name contains this.
std::string key_lines(const std::vector<ManualKey>& keys, const std::string& wanted);

/// The page for man(1), in roff.
std::string man_page(const Program& program, const std::vector<ManualKey>& keys);

/// Completion of commands, options, keys behind --set and --unset, files and folders for "bash" or "fish". `templates`
/// complete what follows "new". None for any other shell.
std::optional<std::string> completion(const std::string& shell, const Program& program,
                                      const std::vector<ManualKey>& keys, const std::vector<std::string>& templates);

/// JSON schema (draft-07) of a case file: tables, types, bounds and words as the keys allow them.
std::string schema(const std::string& title, const std::vector<ManualKey>& keys);

}  // namespace cases
