#include "cases/driver/case_plan.hpp"

#include "cases/driver/run.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace case_text;

TEST_CASE("results of a case: what it asks for is what is recorded, and a plan refers to the case itself") {
  const auto file = read(plain, {"output.fields=[\"hdf5\"]", "output.checkpoint_every=7", "output.probes.a=[0.5,0.5]"});
  const cases::RunOptions options{"somewhere", true, nullptr, true};
  const auto recording = cases::recording_options(file.content, options);
  CHECK(recording.folder == "somewhere");
  CHECK(recording.hdf5);
  CHECK_FALSE(recording.vtk);
  CHECK_FALSE(recording.velocities);  // at rest
  CHECK(recording.checkpoint_every == 7);
  CHECK(recording.goes_on);
  CHECK(cases::resolved_toml(read(recording.resolved).content) == recording.resolved);
  const auto plan = cases::plan_of(file.content, options);
  CHECK(&plan.probes == &file.content.output.probes);
  CHECK_FALSE(plan.fields);
  CHECK(plan.states);
}

TEST_CASE("results of a case: kept in memory nothing is written, and parts keep theirs apart") {
  const small_run::TemporaryFolder folder;
  const auto file = read(plain);
  post::ResultsInMemory in_memory;
  in_memory.wants_fields = true;
  const cases::RunOptions options{folder / "run", true, &in_memory};
  CHECK_FALSE(cases::plan_of(file.content, options).report);
  CHECK_FALSE(cases::recording_of(file.content, options).checkpoints);
  CHECK(in_memory.resolved == cases::resolved_toml(file.content));
  CHECK(folder.entries() == 0);
  const auto part = options.part("second");
  CHECK(part.folder == folder / "run/second");
  CHECK(part.in_memory == &in_memory.parts.at("second"));
  CHECK(part.in_memory->wants_fields);
  const cases::RunOptions files{folder / "run"};
  CHECK(files.part("second").in_memory == nullptr);
}
