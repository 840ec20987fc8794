#include "post/files/run_folder.hpp"

#include <fstream>

#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

namespace fs = std::filesystem;

namespace {

struct Folder {
  small_run::TemporaryFolder own;
  const fs::path& path = own.path();
  void file(const std::string& name) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name) << "x";
  }
};

}  // namespace

TEST_CASE("earlier results: no folder and an empty one are free, one with other files is not") {
  const Folder folder;
  CHECK(post::strangers(folder.path / "none").empty());
  CHECK(post::strangers(folder.path).empty());
  folder.file("notes.txt");
  folder.file("a.csv");
  CHECK(post::strangers(folder.path) == std::vector<std::string>{"a.csv", "notes.txt"});
  CHECK(post::remove_earlier(folder.path) == 0);
  CHECK(fs::exists(folder.path / "notes.txt"));
}

TEST_CASE("earlier results: the folder of a run that was killed at its first file is free") {
  const Folder folder;
  folder.file("case.resolved.toml.partial");
  CHECK(post::strangers(folder.path).empty());
}

TEST_CASE("earlier results: all that a run writes goes, the rest stays") {
  const Folder folder;
  for (const char* name : {"case.resolved.toml", "summary.json", "history.csv", "srif.csv", "fields.pvd",
                           "fields_0000.vtu", "fields_12345.vtu", "cracks.vtp", "state.h5", "state.h5.partial",
                           "checkpoint.end", "motion/case.resolved.toml", "motion/growth.csv"})
    folder.file(name);
  for (const char* name : {"notes.txt", "my_history.csv", "fields_1.vtu", "ordinary/summary.json"}) folder.file(name);
  CHECK(post::strangers(folder.path).empty());
  CHECK(post::remove_earlier(folder.path) == 13);
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path))
    if (entry.is_regular_file()) left.push_back(fs::relative(entry.path(), folder.path).string());
  std::ranges::sort(left);
  CHECK(left == std::vector<std::string>{"fields_1.vtu", "my_history.csv", "notes.txt", "ordinary/summary.json"});
  CHECK_FALSE(fs::exists(folder.path / "motion"));
}
