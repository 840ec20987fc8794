#include "cases/input/case_file.hpp"
#include <fstream>
#include <optional>
#include <string_view>
#include "cases/input/formulations.hpp"
#include "cases/input/keys.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "post/studies/accuracy/path.hpp"

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

std::string contents(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw CaseError({{path.string(), "", "no such file"}});
  std::ifstream file(path, std::ios::binary);
  if (std::filesystem::is_directory(path, ignored) || !file) throw CaseError({{path.string(), "", "cannot be read"}});
  constexpr std::size_t most = 16 << 20, piece = 1 << 16;  // [bytes]; it may be a pipe or a device
  std::string text;
  for (std::size_t read = piece; read == piece && text.size() <= most;) {
    text.resize(text.size() + piece);
    file.read(text.data() + text.size() - piece, piece);
    read = std::size_t(file.gcount());
    text.resize(text.size() - piece + read);
  }
  if (text.size() > most)
    throw CaseError({{path.string(), "", fmt::format("has more than {} MiB: no file of ours", most >> 20)}});
  return text;
}

/// The line with a key of more parts than any that there is: the library follows the parts by recursion, and 100,000
/// of them are the end of its stack.
std::optional<std::size_t> line_of_deep_key(const std::string& text) {
  constexpr std::size_t deepest = 64;
  std::size_t line = 1, parts = 0;
  char before = ' ';
  bool comment = false;
  for (const char c : text) {
    if (c == '\n') ++line, comment = false;
    if (c == '#') comment = true;
    if (comment || c == ' ' || c == '\t') continue;
    if (c == '.' && before != '.' && ++parts > deepest) return line;
    if (std::string_view("\n,=[]{}").find(c) != std::string_view::npos) parts = 0;
    before = c;
  }
  return std::nullopt;
}

}  // namespace

namespace {

toml::table parsed_text(const std::string& text, const std::string& name) {
  if (const auto line = line_of_deep_key(text))
    throw CaseError({{fmt::format("{}:{}", name, *line), "", "a key of more than 64 parts"}});
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const auto at = error.source().begin;
    throw CaseError({{fmt::format("{}:{}:{}", name, at.line, at.column), "", std::string(error.description())}});
  }
}

}  // namespace

toml::table parsed(const std::filesystem::path& path) {
  return parsed_text(contents(path), path.string());
}

namespace {

/// analysis.kind decides about other keys: it is needed before they are read.
std::optional<Analysis::Kind> kind_of(const toml::table& root) {
  const auto given = root["analysis"]["kind"].value<std::string>();
  for (const auto& [name, kind] : analysis_kinds().allowed)
    if (given == name) return kind;
  return std::nullopt;
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

namespace {

CaseFile case_of(toml::table root, const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  Reading reading(path.string());
  for (const auto& setting : overrides) apply_override(root, setting, reading);
  reading.kind = kind_of(root);
  reading.finds_spacing = bool(root["srif"]["accuracy"]);

  Case content;
  content.title = path.stem().string();
  content.discretization.formulation = &plate::galerkin;  // unless the file states another
  read_fields(case_fields(), Value(root, "", reading), content);
  snap_cracks(content, reading);
  settle_formulation(states_formulation(root), content, reading);
  settle_method(content, reading);
  check_case(content, reading);
  if (!reading.problems().empty()) throw CaseError(reading.problems());
  if (content.srif && content.srif->accuracy)
    content.discretization = post::discretization_of(content, content.analysis.kind == Analysis::Kind::dynamic, 1);
  return {std::move(content), reading.found()};
}

}  // namespace

CaseFile read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return case_of(parsed(path), path, overrides);
}

CaseFile read_case_text(const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
  return case_of(parsed_text(text, name), name, overrides);
}

std::string resolved_toml(const Case& content) {
  return write_fields(case_fields(), content, content.analysis.kind, "\n") + "\n";
}

}  // namespace cases
