#include "cases/driver/recording.hpp"
#include "cases/runs/quasi_static_run.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder, small_run::text_of;

namespace {

/// Leaves the last checkpoint, as a run that was killed after it.
std::size_t advances(const cases::CaseFile& file, const std::filesystem::path& folder, bool goes_on) {
  const cases::RunOptions options{folder, true, nullptr, goes_on};
  auto recording = cases::recording({file.content, options});
  CHECK(recording.checkpoints->goes_on() == goes_on);
  cases::QuasiStaticRun run({file.content, options}, plate::discretise(file.content));
  return run(std::move(recording.recorder), recording.checkpoints.get()).growth->advances;
}

}  // namespace

TEST_CASE("quasi-static memory: a growth that goes on writes what one writes that was never ended") {
  for (const char* growth : {"growth={fracture_energy=1,max_advances=1}",
                             "growth={criterion=\"bond_energy\",fracture_energy=1,max_advances=1}"}) {
    const auto file = case_text::read(
        case_text::plain, {growth, "discretization.spacing=0.1", "geometry.cracks=[[[-1.0,0.0],[-0.1,0.0]]]",
                           "load[0].value=1000", "output.fields=[]", "output.checkpoint_every=1e-9"});
    const TemporaryFolder folder;
    CHECK(advances(file, folder.path(), false) == 1);
    std::map<std::string, std::string> whole;
    for (const char* name : {"growth.csv", "tips.csv", "history.csv", "cracks.csv", "reactions.csv"})
      whole[name] = text_of(folder / name), std::filesystem::remove(folder / name);
    CHECK(advances(file, folder.path(), true) == 1);
    for (const auto& [name, text] : whole) {
      INFO(name);
      CHECK_FALSE(text.empty());
      CHECK(text_of(folder / name) == text);
    }
  }
}
