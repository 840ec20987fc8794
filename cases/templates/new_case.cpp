#include "cases/templates/new_case.hpp"

#include <fmt/format.h>

#include "cases/input/toml_reader.hpp"
#include "post/files/atomic_file.hpp"

namespace cases {
namespace {

const std::string ending = ".toml", marked = "# shows: ", of_case = "\ncase = \"";

/// Writes the case that a study names beside it, unless it is there; what was done, a line.
std::string case_beside(std::string_view study, const std::filesystem::path& path) {
  const auto at = study.find(of_case);
  if (at == std::string::npos) return "";
  const auto begin = at + of_case.size();
  const std::string name(study.substr(begin, study.find('"', begin) - begin));
  const auto beside = path.parent_path() / name;
  if (std::filesystem::exists(beside))
    return fmt::format("{} exists and is used as the case of the study\n", beside.string());
  post::write_atomically(beside, std::string(templates().at(name)));
  return fmt::format("{} written: the case of the study\n", beside.string());
}

}  // namespace

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const auto& one : templates()) names.push_back(one.first.substr(0, one.first.size() - ending.size()));
  return names;
}

std::string template_menu() {
  std::string text;
  for (const auto& [file, content] : templates()) {
    const auto begin = content.find(marked) + marked.size();
    text += fmt::format("{:<16} {}\n", file.substr(0, file.size() - ending.size()),
                        content.substr(begin, content.find('\n', begin) - begin));
  }
  return text + "pdplate new NAME [FILE] writes one of them\n";
}

std::string new_case(const std::string& name, const std::string& file) {
  const auto found = templates().find(name + ending);
  if (found == templates().end())
    throw CaseError({{"new", name,
                      fmt::format("no such template{}; there are {}", did_you_mean(name, template_names()),
                                  fmt::join(template_names(), ", "))}});
  const std::filesystem::path path = file.empty() ? name + ending : file;
  if (std::filesystem::exists(path)) throw CaseError({{"new", path.string(), "exists, and is not overwritten"}});
  post::write_atomically(path, std::string(found->second));
  const auto beside = case_beside(found->second, path);
  return fmt::format("{}{} written; pdplate {} {}\n", beside, path.string(), beside.empty() ? "run" : "study",
                     path.string());
}

}  // namespace cases
