#include "cases/papers/dai2021.hpp"

#include "cases/studies/study.hpp"
#include "post/files/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

TEST_CASE("papers: the studies of Dai et al. that the program brings along read, with all that they name") {
  const small_run::TemporaryFolder folder;
  for (const auto& [name, text] : cases::paper_files()) {
    std::filesystem::create_directories((folder / name).parent_path());
    post::write_atomically(folder / name, std::string(text));
  }
  const auto approaches = cases::read_study(folder / "static/study_thirty_cracks_approaches.toml");
  CHECK(approaches.runs.size() == 90);
  CHECK(approaches.references.size() == 30);
  CHECK(cases::read_study(folder / "static/study_thirty_cracks.toml").runs.size() == 30);
  CHECK(cases::read_study(folder / "static/study_dai2021_spacing.toml").runs.size() == 20);
  CHECK(cases::read_study(folder / "dynamic/study_dai2021_approaches.toml").runs.size() == 8);
  const auto motion = cases::read_study(folder / "dynamic/study_dai2021_motion.toml");
  CHECK(motion.runs.size() == 5);
  for (const auto& run : motion.runs) CHECK(run.wanted.size() == 2);
}
