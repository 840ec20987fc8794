#include "post/files/hdf5/state_file.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/unit/post/files/hdf5/look.hpp"
#include "tests/unit/post/files/lattice_in_boxes.hpp"
#include "tests/unit/post/small_run.hpp"

using hdf5_look::Look, small_run::TemporaryFolder;
using lattice_in_boxes::own_mesh, lattice_in_boxes::state;

namespace {

post::Frame frame(const post::Mesh& mesh, std::size_t step) {
  post::Frame result;
  result.time = 0.5 * double(step), result.step = step, result.state = state(mesh, result.time);
  result.resultants = {5 * result.state, 6 * result.state.topRows<2>(), 7 * result.state.row(2).transpose()};
  return result;
}

const post::Table table{{"time", "probe"}, {{0.5, "tip"}}};

post::StateFile::Options options(const std::filesystem::path& path, bool goes_on = false) {
  return {path, "title = \"a\"\n", "1.2.3", true, goes_on};
}

/// Datasets and what describes them.
void require_same(const std::filesystem::path& one, const std::filesystem::path& other) {
  const Look first(one), second(other);
  const auto names = first.datasets();
  REQUIRE(names.size() == 12);
  REQUIRE(second.datasets() == names);
  for (const std::string& name : names) {
    CAPTURE(name);
    CHECK(first.text_attribute(name.c_str(), "unit") == second.text_attribute(name.c_str(), "unit"));
    if (name == "tables/table/probe")
      CHECK(first.words(name.c_str()) == second.words(name.c_str()));
    else
      CHECK((first.numbers(name.c_str()) == second.numbers(name.c_str())));
  }
  CHECK(first.text_attribute("/", "case") == second.text_attribute("/", "case"));
}

}  // namespace

TEST_CASE("state.h5 of several processes is that of one") {
  const TemporaryFolder folder;
  const auto whole = own_mesh(0, 1);
  {
    post::StateFile file(options(folder / "one.h5"), whole);
    for (const std::size_t step : {0, 1}) {
      const plate::State rates = 3 * state(whole, double(step));
      file.write(frame(whole, step), &rates);
    }
    file.write("table", table);
    file.close();
  }
  for (const int processes : {1, 2, 5}) {
    thread_ranks::run(processes, [&](const plate::Communicator& all) {
      auto mesh = own_mesh(all.rank(), processes);
      mesh.own = mesh.positions.size();
      mesh.positions.emplace_back(9, 9), mesh.areas.push_back(9), mesh.cut.push_back(9);  // of another process
      post::StateFile file(options(folder / "state.h5"), mesh, all);
      for (const std::size_t step : {0, 1}) {
        const plate::State rates = 3 * state(mesh, double(step));
        file.write(frame(mesh, step), &rates);
      }
      file.write("table", table);
      file.close();
    });
    require_same(folder / "one.h5", folder / "state.h5");
  }
  CHECK(folder.entries() == 2);
}

TEST_CASE("state.h5 of several processes goes on after frames of another number of them") {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, int processes, bool goes_on, std::vector<std::size_t> steps) {
    thread_ranks::run(processes, [&](const plate::Communicator& all) {
      const auto mesh = own_mesh(all.rank(), processes);
      post::StateFile file(options(folder / name, goes_on), mesh, all);
      if (goes_on) file.go_on(steps.front());
      const plate::State rates = state(mesh, 1);
      for (const auto step : steps) file.write(frame(mesh, step), &rates), file.part();
      file.write("table", table);
      file.close();
    });
  };
  write("whole.h5", 3, false, {0, 1, 2, 3});
  write("state.h5", 2, false, {0, 1, 2});
  write("state.h5", 5, true, {2, 3});
  require_same(folder / "whole.h5", folder / "state.h5");
}
