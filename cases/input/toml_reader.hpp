#pragma once
#include <toml++/toml.h>
#include <filesystem>
#include <optional>

#include "cases/input/problems.hpp"
#include "plate/model/wording.hpp"
#include "plate/solve/analysis.hpp"

/// Values of a case file that know their key and their place, and complain by themselves.
namespace cases {

/// Data collected while one file is read: places of keys, problems.
class Reading {
public:
  explicit Reading(std::string file) : folder(std::filesystem::path(file).parent_path()) {
    found_.places.emplace_back("", std::move(file));
  }

  std::filesystem::path folder;  // of the file: what it names is sought there

  std::optional<plate::Analysis::Kind> kind;  // analysis.kind, where it is known
  bool finds_spacing = false;                 // srif.accuracy or [accuracy] is given
  bool metres = false;                        // units = "SI"
  std::optional<double> spacing;              // discretization.spacing, where it is a number
  bool distributed = false;                   // several ranks are to run the case

  /// The file does not give the key: `place`, as "--set KEY", is its place and that of everything below it.
  void overridden(const std::string& key, const std::string& place) { overridden_.emplace_back(key, place); }
  /// The file gives this key at this line (0: not in the file).
  void note(const std::string& key, std::size_t line);
  /// Reports an error of the key at its place or that of its nearest parent.
  void report_error(const std::string& key, const std::string& what) {
    problems_.push_back({found_.place(key), key, what});
  }
  void report_error(Problem problem) { problems_.push_back(std::move(problem)); }

  bool given(const std::string& key) const;
  /// True where no error has been reported at or below this key.
  bool sound(const std::string& key) const;

  /// Problems of the command line first, then problems of the file by line.
  std::vector<Problem> problems() const;
  Source& found() { return found_; }

private:
  Source found_;
  std::vector<std::pair<std::string, std::string>> overridden_;
  std::vector<Problem> problems_;
};

/// A value of the file. The readers complain and return nothing where the value has another form.
class Value {
public:
  Value(const toml::node& node, std::string key, Reading& reading);

  const std::string& key() const { return key_; }
  Reading& reading() const { return *reading_; }
  std::string below(const std::string& name) const { return key_.empty() ? name : key_ + "." + name; }
  void report_error(const std::string& what) const { reading_->report_error(key_, what); }
  /// Complains "VALUE given, must be ...".
  void refuse(const std::string& must_be) const { report_error(shown() + " given, must be " + must_be); }
  /// The value as TOML, in one line.
  std::string toml() const;
  /// The value as TOML, shortened.
  std::string shown() const;

  bool is_text() const { return node_->is_string(); }
  bool is_table() const { return node_->is_table(); }
  const toml::table* table() const;
  std::optional<double> number() const;
  std::optional<std::string> text() const;
  std::optional<bool> boolean() const;
  std::optional<std::vector<double>> numbers(std::size_t count, const std::string& form) const;
  std::optional<std::vector<std::string>> texts() const;
  std::optional<geometry::Point> point() const;
  std::optional<std::vector<geometry::Point>> points() const;
  std::vector<Value> elements(const std::string& form) const;

private:
  const toml::node* node_;
  std::string key_;
  Reading* reading_;
};

/// Puts "key=value" into the tree, or takes the key of "-key" out of it, before anything is read. Complains where the
/// key cannot be reached.
void apply_override(toml::table& root, const std::string& setting, Reading& reading);

using plate::did_you_mean;
using plate::listed;
using plate::number_text;
using plate::quoted;
using plate::text_of;

/// A file, or text that has such a name, as a tree. Throws CaseError where it is no TOML, or for another `command`.
toml::table parsed(const std::filesystem::path& path, const std::string& command);
toml::table parsed_text(const std::string& text, const std::string& name);

}  // namespace cases
