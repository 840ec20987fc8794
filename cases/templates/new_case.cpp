#include "cases/templates/new_case.hpp"

#include <fmt/format.h>

#include "cases/input/toml_reader.hpp"
#include "post/files/whole_file.hpp"

namespace cases {
namespace {

const std::string ending = ".toml", marked = "# shows: ";

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
  post::write_whole(path, std::string(found->second));
  const bool study = name.starts_with("study_");
  return fmt::format("{} written; pdplate {} {}\n", path.string(), study ? "study" : "run", path.string());
}

}  // namespace cases
