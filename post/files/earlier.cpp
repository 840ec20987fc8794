#include "post/files/earlier.hpp"

#include <algorithm>
#include <regex>

#include "post/files/whole_file.hpp"

namespace post {
namespace {

namespace fs = std::filesystem;

constexpr auto mark = "case.resolved.toml";  // the first file of every run

bool is_result(const std::string& name) {
  static const std::regex names(
      R"((case\.resolved\.toml|summary\.json|state\.h5(\.\d+)?|fields\.pvd|fields_\d{4,}(_\d+)?\.vtu|fields_\d{4,}\.pvtu|cracks(_\d{4,})?\.vtp|cracks\.pvd|)"
      R"(curves\.svg|report\.html|checkpoint(\.before|\.\d\.\d+)?|)"
      R"((history|probes|reactions|frequencies|srif|envelope|impact|response|growth|tips|cracks)\.csv)(\.partial)?)");
  return std::regex_match(name, names);
}

}  // namespace

std::vector<std::string> strangers(const fs::path& folder) {
  std::error_code none;
  std::vector<std::string> names;
  if (!fs::is_directory(folder, none) || fs::exists(folder / mark, none)) return names;
  for (const auto& entry : fs::directory_iterator(folder, none)) names.push_back(entry.path().filename().string());
  std::erase(names, std::string(mark) + ".partial");  // of a run that was killed at its first file
  std::ranges::sort(names);
  return names;
}

bool is_of(const fs::path& folder, const std::string& resolved) {
  std::error_code none;
  return fs::exists(folder / mark, none) && read_text(folder / mark) == resolved;
}

std::size_t remove_earlier(const fs::path& folder, Parts parts) {
  std::error_code none;
  if (!fs::exists(folder / mark, none)) return 0;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file(none) && is_result(entry.path().filename().string())) old.push_back(entry.path());
  // what one could go on from, or take for an end, goes first; the mark last: a folder that was cleared in part is
  // still one of results
  std::ranges::sort(old, {}, [](const fs::path& path) {
    const auto name = path.filename().string();
    return name == mark ? 2 : name.starts_with("checkpoint") || name == "summary.json" ? 0 : 1;
  });
  std::size_t count = 0;
  for (const char* part : {"motion", "ordinary", "galerkin"}) {
    if (parts == Parts::stay) break;
    count += remove_earlier(folder / part);
    if (fs::is_empty(folder / part, none) && !none) fs::remove(folder / part, none);
  }
  for (const auto& path : old) count += fs::remove(path);
  return count;
}

}  // namespace post
