#include "post/files/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::FullDisk, small_run::TemporaryFolder, small_run::text_of;

TEST_CASE("a file is written whole and nothing else is left") {
  const TemporaryFolder folder;
  const std::string text("two\nlines, and a zero byte: \0.", 30);
  post::write_atomically(folder / "a.txt", text);
  CHECK(text_of(folder / "a.txt") == text);
  post::write_atomically(folder / "a.txt", "again");
  CHECK(text_of(folder / "a.txt") == "again");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a writer that fails leaves the old file and nothing beside it") {
  const TemporaryFolder folder;
  post::write_atomically(folder / "a.txt", "old");
  const auto fails = [](const std::filesystem::path& path) {
    std::ofstream(path) << "half";
    throw std::runtime_error("in mid-write");
  };
  CHECK_THROWS_WITH(post::write_atomically(folder / "a.txt", fails), "in mid-write");
  CHECK(text_of(folder / "a.txt") == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a full disk is an error, for long and for short texts") {
  const TemporaryFolder folder;
  const FullDisk full(100);
  for (const std::size_t length : {101U, 1000000U}) {
    CHECK_THROWS_AS(post::write_atomically(folder / "a.txt", std::string(length, 'x')),
                    std::filesystem::filesystem_error);
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("a folder that gets another name, or goes, in mid-write keeps nothing half-written") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "one");
  const auto renamed = [&](const std::filesystem::path& beside) {
    std::ofstream(beside) << "whole";
    std::filesystem::rename(folder / "one", folder / "other");
  };
  CHECK_THROWS_WITH(post::write_atomically(folder / "one" / "a.txt", renamed), Catch::Contains("a.txt"));
  CHECK(std::filesystem::is_empty(folder / "other"));
  const auto gone = [&](const std::filesystem::path& beside) {
    std::ofstream(beside) << "whole";
    std::filesystem::remove_all(folder / "other");
  };
  CHECK_THROWS_WITH(post::write_atomically(folder / "other" / "a.txt", gone), Catch::Contains("a.txt"));
  CHECK(folder.entries() == 0);
}

TEST_CASE("a folder that is not there is an error with the path") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(post::write_atomically(folder / "none/a.txt", "text"), Catch::Contains("none/a.txt"));
}

TEST_CASE("a link where the half-written file would stand is not followed") {
  const TemporaryFolder folder;
  std::ofstream(folder / "precious") << "not ours";
  std::filesystem::create_symlink(folder / "precious", folder / "a.txt.partial");
  post::write_atomically(folder / "a.txt", "text");
  CHECK(text_of(folder / "precious") == "not ours");
  CHECK(text_of(folder / "a.txt") == "text");
}
