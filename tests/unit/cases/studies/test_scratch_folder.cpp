#include "post/files/run_folder.hpp"

#include <fstream>
#include <optional>

#include "tests/catch.hpp"

TEST_CASE("scratch folder: of its own for each, counted with all in it, and gone with it") {
  std::optional<post::ScratchFolder> one(std::in_place, "pdplate_scratch"), other(std::in_place, "pdplate_scratch");
  const auto path = one->path();
  CHECK(path != other->path());
  CHECK(one->bytes() == 0);
  std::filesystem::create_directories(path / "a/b");
  std::ofstream(path / "a/b/file") << std::string(1000, 'x');
  std::ofstream(path / "file") << "12";
  CHECK(one->bytes() == 1002);
  one.reset();
  CHECK_FALSE(std::filesystem::exists(path));
  std::filesystem::remove_all(other->path());
  other.reset();  // it is gone already
  CHECK_THROWS(post::ScratchFolder("no/such/place"));
}
