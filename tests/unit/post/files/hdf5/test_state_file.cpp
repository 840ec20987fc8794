#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <functional>
#include <optional>
#include <random>

#include "post/files/atomic_file.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/files/hdf5/look.hpp"
#include "tests/unit/post/small_run.hpp"

using hdf5_look::Look, small_run::FullDisk, small_run::TemporaryFolder;

namespace {

const std::string long_case(200000, '#');  // more than the 64 KiB that an attribute can hold in place

void write_with_velocity(post::StateFile& file, std::size_t number) {
  const auto frame = small_run::frame(0.5 * double(number), number);
  const plate::State velocity = 3 * frame.state;
  file.write(frame, &velocity);
}

/// In a process that is killed after it.
void killed(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
}

}  // namespace

TEST_CASE("a run comes back from state.h5") {
  const TemporaryFolder folder;
  const post::Frame first = small_run::frame(0, 0), second = small_run::frame(0.5, 10);
  post::StateFile file({folder / "state.h5", long_case, "1.2.3"}, small_run::mesh());
  file.write(first, nullptr);
  file.write(second, nullptr);
  CHECK_FALSE(std::filesystem::exists(folder / "state.h5"));
  file.close();
  file.close();  // a second time is harmless
  CHECK(folder.entries() == 1);

  const post::StoredRun run = post::read_run(folder / "state.h5");
  CHECK(run.positions == small_run::mesh().positions);
  CHECK(run.times == std::vector<double>{0, 0.5});
  REQUIRE(run.states.size() == 2);
  CHECK(run.states[0] == first.state);
  CHECK(run.states[1] == second.state);
}

TEST_CASE(
    "state.h5 keeps the displacements and forces in the plane where they are asked for, of a run that went on, too") {
  const TemporaryFolder folder;
  const auto frame = [](double time) {
    auto result = small_run::frame(time, std::size_t(time));
    auto& fields = result.in_plane.emplace();
    fields.displacement = (2 + time) * result.state.topRows<2>(), fields.force = (3 + time) * result.state;
    return result;
  };
  const auto bent = small_run::frame(0, 0);
  {
    post::StateFile file({.path = folder / "state.h5", .resolved_case = "", .version = "1", .in_plane = true},
                         small_run::mesh());
    file.write(frame(0), nullptr);
    file.part();
    file.write(frame(1), nullptr);
    CHECK_THROWS_WITH(file.write(bent, nullptr), Catch::Contains("the fields in the plane do not fit"));
    file.close();
  }
  const auto run = post::read_run(folder / "state.h5");
  REQUIRE(run.displacements.size() == 2);
  for (const std::size_t i : {0, 1}) CHECK(run.displacements[i] == frame(double(i)).in_plane->displacement);
  const Look look(folder / "state.h5");
  const auto forces = look.numbers("/frames/membrane_forces");
  REQUIRE(forces.size() == 2 * 6 * 3);
  CHECK(forces[3 * (6 + 4) + 2] == frame(1).in_plane->force(2, 4));
  CHECK(look.text_attribute("/frames/displacement", "unit") == "length");
  CHECK(look.text_attribute("/frames/membrane_forces", "unit") == "force/length");

  post::StateFile file({.path = folder / "bent.h5", .resolved_case = "", .version = "1"}, small_run::mesh());
  file.write(bent, nullptr);
  file.close();
  CHECK(post::read_run(folder / "bent.h5").displacements.empty());
  const auto names = Look(folder / "bent.h5").datasets();
  CHECK(std::ranges::find(names, "frames/displacement") == names.end());
}

TEST_CASE("state.h5 explains itself") {
  const TemporaryFolder folder;
  const post::Frame frame = small_run::frame(0.5, 10);
  const plate::State velocity = 7 * frame.state;
  {
    post::StateFile file({folder / "state.h5", long_case, "1.2.3", true}, small_run::mesh());
    file.write(frame, &velocity);
    file.write("probes", {{"time", "probe", "w"}, {{0.0, "tip", 1.5}, {0.5, "edge", post::Cell()}}});
    file.write("probes", {{"time", "probe", "w"}, {{0.0, "tip", 2.5}, {0.5, "edge", post::Cell()}}});
    file.write("srif", {{"time", "K1"}, {}});
    file.close();
  }
  const Look look(folder / "state.h5");
  CHECK(look.text_attribute("/", "program") == "PDPlate");
  CHECK(look.text_attribute("/", "version") == "1.2.3");
  CHECK(look.text_attribute("/", "case") == long_case);
  CHECK(look.text_attribute("/points/area", "unit") == "length^2");
  CHECK(look.text_attribute("/frames/moments", "unit") == "force");
  CHECK(look.text_attribute("/frames/shear_forces", "unit") == "force/length");
  CHECK(look.text_attribute("/frames/von_mises", "unit") == "force/length^2");
  CHECK(look.text_attribute("/tables/srif/K1", "unit") == "force length^(1/2)");
  CHECK(look.numbers("/frames/velocity")[4] == velocity(1, 1));
  CHECK(look.numbers("/frames/moments")[3 * 4 + 2] == frame.resultants.moments(2, 4));
  CHECK(look.numbers("/frames/shear_forces")[2 * 4 + 1] == frame.resultants.shear(1, 4));
  CHECK(look.numbers("/frames/von_mises")[4] == frame.resultants.von_mises[4]);
  CHECK(look.numbers("/frames/step") == std::vector<double>{10});
  CHECK(look.numbers("/points/cut") == small_run::mesh().cut);
  CHECK(look.words("/tables/probes/probe") == std::vector<std::string>{"tip", "edge"});
  CHECK(look.numbers("/tables/probes/w")[0] == 2.5);
  CHECK(std::isnan(look.numbers("/tables/probes/w")[1]));
  const auto datasets = look.datasets();
  CHECK(datasets.size() == 15);
  for (const std::string& name : datasets) {
    CAPTURE(name);
    CHECK(look.text_attribute(name.c_str(), "unit") != "no attribute");
    CHECK(look.text_attribute(name.c_str(), "description").size() > 1);
  }
}

TEST_CASE("a run that fails keeps its last good frame, one without a frame leaves nothing") {
  const TemporaryFolder folder;
  {
    post::StateFile file({folder / "empty.h5", "", "1"}, small_run::mesh());
    CHECK(std::filesystem::exists(folder / "empty.h5.0"));
  }
  CHECK(folder.entries() == 0);
  {
    post::StateFile file({folder / "state.h5", "", "1"}, small_run::mesh());
    file.write(small_run::frame(0.25, 1), nullptr);
    CHECK_THROWS_AS(file.write(small_run::frame(0.5, 2, 5), nullptr), std::invalid_argument);
    auto bare = small_run::frame(0.5, 2);
    bare.resultants = {};
    CHECK_THROWS_WITH(file.write(bare, nullptr), Catch::Contains("the resultants do not fit"));
  }
  CHECK(post::read_run(folder / "state.h5").times == std::vector<double>{0.25});
  CHECK(folder.entries() == 1);
}

TEST_CASE("an interrupted write leaves no state.h5") {
  const TemporaryFolder folder;
  const std::optional<FullDisk> full(std::in_place, 50000);
  post::Mesh mesh = small_run::mesh();
  {
    post::StateFile file({folder / "state.h5", "", "1"}, mesh);
    file.write(small_run::frame(0, 0), nullptr);
    const post::Table table{{"a"}, std::vector<std::vector<post::Cell>>(50000, {1.0})};
    CHECK_THROWS_WITH(file.write("table", table), Catch::Contains("File too large"));
    CHECK_THROWS_AS(file.close(), std::filesystem::filesystem_error);
  }
  std::mt19937_64 random(1);  // numbers that do not shrink
  for (std::size_t i = mesh.positions.size(); i < 5000; ++i) {
    mesh.positions.emplace_back(double(random()), double(random()));
    mesh.areas.push_back(double(random())), mesh.cut.push_back(double(random()));
  }
  CHECK_THROWS_AS(post::StateFile({folder / "state.h5", "", "1"}, mesh), std::filesystem::filesystem_error);
  CHECK(folder.entries() == 0);
}

TEST_CASE("a process that is killed leaves the frames of its parts, and others go on after them") {
  const TemporaryFolder folder;
  const post::StateFile::Options options{folder / "state.h5", long_case, "1", true};
  killed([&] {
    auto* file = new post::StateFile(options, small_run::mesh());
    for (std::size_t i = 0; i < 5; ++i) {
      write_with_velocity(*file, i);
      if (i == 1 || i == 3) file->part();
    }
  });
  auto again = options;
  again.goes_on = true;
  killed([&] {
    auto* file = new post::StateFile(again, small_run::mesh());
    file->go_on(4);
    for (std::size_t i = 4; i < 8; ++i) {
      write_with_velocity(*file, i);
      if (i == 5) file->part();
    }
  });
  const auto expect = [&](std::size_t last) {
    const post::StoredRun run = post::read_run(folder / "state.h5");
    REQUIRE(run.times.size() == last + 1);
    for (std::size_t i = 0; i <= last; ++i) {
      CHECK(run.times[i] == 0.5 * double(i));
      CHECK(run.states[i] == small_run::frame(run.times[i], i).state);
    }
    const Look look(folder / "state.h5");
    const auto velocities = look.numbers("/frames/velocity");
    REQUIRE(velocities.size() == (last + 1) * small_run::mesh().positions.size() * 3);
    CHECK(velocities.back() == 3 * run.states.back()(2, run.states.back().cols() - 1));
    const auto von_mises = look.numbers("/frames/von_mises");
    CHECK(von_mises.size() == velocities.size() / 3);
    CHECK(von_mises.back() == small_run::frame(0, 0).resultants.von_mises[5]);
    CHECK(look.numbers("/frames/step").back() == double(last));
    CHECK(look.numbers("/tables/table/a") == std::vector<double>{double(last)});
  };
  for (const std::size_t last : {8, 4}) {  // after the killed run; then after frames of the one that has ended
    {
      post::StateFile file(again, small_run::mesh());
      const std::size_t first = last == 8 ? 6 : 3;
      file.go_on(first);
      for (std::size_t i = first; i <= last; ++i) write_with_velocity(file, i);
      file.write("table", {{"a"}, {{double(last)}}});
      file.close();
    }
    expect(last);
    CHECK(folder.entries() == 1);
  }
  {
    post::StateFile file(again, small_run::mesh());
    CHECK_THROWS_AS(file.go_on(6), std::filesystem::filesystem_error);  // there are five
  }
}

TEST_CASE("parts stay after a failure for the checkpoint that knows of them, and go without one") {
  for (const bool known : {false, true}) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "state.h5");  // in the way
    if (known) std::ofstream(folder / "checkpoint") << "known";
    {
      post::StateFile file({folder / "state.h5", "", "1", true}, small_run::mesh());
      write_with_velocity(file, 0);
      file.part();
      write_with_velocity(file, 1);
      CHECK_THROWS_AS(file.close(), std::filesystem::filesystem_error);
    }
    CHECK(folder.entries() == (known ? 4 : 1));  // with two parts
    CHECK_FALSE(std::filesystem::exists(folder / "state.h5.partial"));
  }
}

TEST_CASE("a folder that gets another name while it is written to keeps nothing half-written") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "one");
  {
    post::StateFile file({folder / "one" / "state.h5", "", "1", true}, small_run::mesh());
    write_with_velocity(file, 0);
    file.part();
    std::filesystem::rename(folder / "one", folder / "other");
  }
  CHECK(std::filesystem::is_empty(folder / "other"));
}

TEST_CASE("frames that are dropped once stay dropped: a part is no longer than what goes on after it") {
  const TemporaryFolder folder;
  const post::StateFile::Options options{folder / "state.h5", long_case, "1", true};
  {
    post::StateFile file(options, small_run::mesh());
    for (std::size_t i = 0; i < 6; ++i) write_with_velocity(file, i);
    file.close();  // asked to end; its checkpoint is of five frames
  }
  auto again = options;
  again.goes_on = true;
  killed([&] {
    auto* file = new post::StateFile(again, small_run::mesh());
    file->go_on(5);
    file->part();
    for (std::size_t i = 10; i < 12; ++i) write_with_velocity(*file, i);
    file->part();
  });
  {
    post::StateFile file(again, small_run::mesh());
    file.go_on(7);
    file.close();
  }
  CHECK(post::read_run(folder / "state.h5").times == std::vector<double>{0, 0.5, 1, 1.5, 2, 5, 5.5});
  CHECK(folder.entries() == 1);
}

TEST_CASE("a part without frames is one to go on after") {
  const TemporaryFolder folder;
  post::StateFile::Options options{folder / "state.h5", long_case, "1", true};
  killed([&] {
    auto* file = new post::StateFile(options, small_run::mesh());
    file->part();
    write_with_velocity(*file, 0);
  });
  options.goes_on = true;
  {
    post::StateFile file(options, small_run::mesh());
    file.go_on(0);
    write_with_velocity(file, 0), write_with_velocity(file, 1);
    file.close();
  }
  CHECK(post::read_run(folder / "state.h5").times == std::vector<double>{0, 0.5});
  CHECK(folder.entries() == 1);
}

TEST_CASE("more points than are written at once: state.h5 has them all, of a run that went on, too") {
  const TemporaryFolder folder;
  const std::size_t points = 2 * post::points_at_once + 7;
  post::Mesh mesh = small_run::mesh();
  mesh.positions.resize(points, {1, 2}), mesh.positions.back() = {3, 4};
  mesh.areas.resize(points, 5), mesh.cut.resize(points, 0.5);
  const auto frame = [&](std::size_t step) { return small_run::frame(double(step), step, Eigen::Index(points)); };
  post::StateFile file({folder / "state.h5", "", "1"}, mesh);
  file.write(frame(0), nullptr);
  file.part();
  file.write(frame(1), nullptr);
  file.close();
  const post::StoredRun run = post::read_run(folder / "state.h5");
  CHECK((run.positions == mesh.positions));
  for (const std::size_t step : {0, 1}) CHECK((run.states.at(step) == frame(step).state));
  CHECK((Look(folder / "state.h5").numbers("/points/area") == mesh.areas));
}
