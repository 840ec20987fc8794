/// Everything that the program reads, from bytes that may be anything: each input must be read or refused in words.
/// Built in two ways:
/// - as a program of the tests, which replays files:   inputs FOLDER   (FOLDER/TARGET/*, one folder per target)
/// - with -DPDPLATE_FUZZ as what libFuzzer drives, for the target that PDPLATE_TARGET names:   tests/reliability/fuzz
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "cases/driver/prepared.hpp"
#include "cases/driver/run.hpp"
#include "cases/studies/comparison.hpp"
#include "cases/studies/extremes.hpp"
#include "cases/studies/study.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/loads.hpp"
#include "post/files/checkpoints.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/summary.hpp"
#include "tests/reliability/mutated.hpp"

namespace fs = std::filesystem;

namespace {

constexpr const char* small_case = R"([section]
young = 1000.0
poisson = 0.3
thickness = 0.1
[geometry]
outline = { rectangle = [-1.0, -1.0, 1.0, 1.0] }
cracks = [[[-0.3, 0.0], [0.3, 0.0]]]
[discretization]
spacing = 0.1
[[support]]
kind = "clamped"
edges = ["left"]
[[load]]
kind = "pressure"
value = 1.0
[analysis]
kind = "static"
)";

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// The folder in which the inputs lie, with what they may name.
const fs::path& folder() {
  static const post::ScratchFolder scratch("pdplate_inputs");
  static const bool filled = [] {
    write(scratch.path() / "case.toml", small_case);
    write(scratch.path() / "case.resolved.toml", small_case);
    for (const char* name : {"case", "table"}) fs::create_directory(scratch.path() / name);
    write(scratch.path() / "table/triangles.csv", "x,y,pressure\n-1,-1,0\n1,-1,1\n-1,1,2\n1,1,3\n0.2,0.1,1.5\n");
    write(scratch.path() / "reference.csv", "t,w\n0,0\n1,2\n");
    write(scratch.path() / "probes.csv", "time,probe,x,y,w,theta_x,theta_y\n0,tip,0,0,0,0,0\n1,tip,0,0,2,0,0\n");
    return true;
  }();
  (void)filled;
  return scratch.path();
}

fs::path file_of(const std::string& name, const std::string& bytes) {
  write(folder() / name, bytes);
  return folder() / name;
}

/// Are the points few enough to be made thousands of times?
bool small(const cases::Case& c) {
  constexpr double points = 900, refinement = 8, ratio = 7;
  const auto& d = c.discretization;
  return geometry::area(c.outline) < points * d.spacing * d.spacing && d.horizon_ratio < ratio &&
         std::min(d.spacing_at_tips(), d.hole_spacing.value_or(d.spacing)) * refinement > d.spacing &&
         c.cracks.size() < 20 && c.output.probes.size() < 100 && !(c.srif && c.srif->accuracy);
}

/// The case as if it stood beside the folder of the table that it may name.
cases::CaseFile case_of(const std::string& bytes) {
  return cases::read_case_text(bytes, (folder() / "case/case.toml").string(), {});
}

/// A case that is read says the same when it is written and read again; a small one is discretised.
void read_a_case(const std::string& bytes) {
  try {
    auto file = case_of(bytes);
    const auto text = cases::resolved_toml(file.content);
    if (cases::resolved_toml(case_of(text).content) != text) std::abort();
    if (small(file.content)) const cases::Prepared prepared(std::move(file));
  } catch (const cases::CaseError&) {
  } catch (const plate::NumericalError&) {
  }
}

/// Shortens what would take long.
void curb(cases::Case& c) {
  c.analysis.max_iterations = std::min<std::size_t>(c.analysis.max_iterations, 1000);
  c.analysis.modes = std::min<std::size_t>(c.analysis.modes, 5);
  if (c.growth) c.growth->max_advances = std::min<std::size_t>(c.growth->max_advances, 2);
  if (c.growth) c.growth->unstable = fracture::Growth::Unstable::jump;
  if (c.srif) c.srif->second_formulation = false;
}

/// A small case runs, and ends as runs may: whatever else is thrown is a fault.
void run_a_case(const std::string& bytes) {
  try {
    auto file = case_of(bytes);
    if (!small(file.content)) return;
    curb(file.content);
    constexpr std::size_t steps = 200, rows = 50;
    if (file.content.analysis.kind == plate::Analysis::Kind::dynamic) {
      const cases::Prepared prepared(file);
      const auto& grid = prepared.steps->grid;
      if (grid.steps > steps || grid.steps > rows * grid.steps_per_row) return;
    }
    post::ResultsInMemory in_memory;
    cases::run(file, {folder() / "results", true, &in_memory});
  } catch (const cases::CaseError&) {
  } catch (const plate::NumericalError&) {
  }
}

void read_a_table(const std::string& bytes) {
  const auto found = plate::PressureTable::parsed(bytes, "pressure.csv");
  const auto* table = std::get_if<plate::PressureTable>(&found);
  if (!table) return;
  for (const auto& x : {geometry::Point(0, 0), geometry::Point(0.3, 0.7), geometry::Point(1e9, -1e9)})
    if (!std::isfinite((*table)(x)) && table->reaches(x)) std::abort();
}

void read_a_study(const std::string& bytes) {
  try {
    cases::read_study(file_of("study.toml", bytes));
  } catch (const cases::CaseError&) {
  }
}

void read_extremes(const std::string& bytes) {
  try {
    cases::read_extremes(file_of("extremes.toml", bytes));
  } catch (const cases::CaseError&) {
  }
}

void read_a_reference(const std::string& bytes) {
  try {
    cases::to_json(cases::compare(folder(), file_of("reference.csv", bytes)), {});
  } catch (const std::logic_error&) {
  } catch (const std::runtime_error&) {
  }
}

void read_a_checkpoint(const std::string& bytes) {
  file_of("checkpoint", bytes);
  std::vector<std::string> refused;
  post::Checkpoints(plate::single_process(), folder(), "pdplate of a case").read(refused);
}

void read_a_state(const std::string& bytes) {
  try {
    post::read_run(file_of("state.h5", bytes));
  } catch (const std::runtime_error&) {
  }
}

struct Target {
  std::string_view name, inputs;  // inputs: the folder of its inputs
  void (*read)(const std::string& bytes);
  unsigned changed;  // of each input, which has lines "key = value", that are replayed beside it; 0: no such lines
};
constexpr std::array targets{
    Target{"case", "case", read_a_case, 5},
    Target{"run", "case", run_a_case, 1},
    Target{"table", "table", read_a_table, 0},
    Target{"study", "study", read_a_study, 5},
    Target{"extremes", "extremes", read_extremes, 5},
    Target{"reference", "reference", read_a_reference, 0},
    Target{"checkpoint", "checkpoint", read_a_checkpoint, 0},
    Target{"state", "state", read_a_state, 0},
};

}  // namespace

#ifdef PDPLATE_FUZZ

namespace {
const Target& chosen() {
  static const Target& target = [&]() -> const Target& {
    const char* name = std::getenv("PDPLATE_TARGET");
    const auto found = std::ranges::find(targets, std::string_view(name ? name : ""), &Target::name);
    if (found == targets.end()) {
      fmt::print(stderr, "PDPLATE_TARGET: one of case, run, table, study, extremes, reference, checkpoint, state\n");
      std::exit(2);
    }
    return *found;
  }();
  return target;
}
}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  if (chosen().changed == 0 || seed % 3 == 0) return LLVMFuzzerMutate(data, size, most);
  const auto text = mutated({reinterpret_cast<const char*>(data), size}, seed).substr(0, most);
  std::ranges::copy(text, data);
  return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen().read({reinterpret_cast<const char*>(data), size});
  return 0;
}

#else

int main(int count, char** arguments) {
  if (count != 2) return fmt::print(stderr, "inputs FOLDER: with a folder for each target\n"), 2;
  std::size_t replayed = 0, altered = 0;
  for (const auto& [name, inputs, read, changed] : targets) {
    std::size_t of_target = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(arguments[1]) / inputs)) {
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(stream), {});
      fmt::print(stderr, "{} {}\n", name, entry.path().string());  // the last one is what ended it
      read(bytes), ++of_target;
      for (unsigned seed = 0; seed < changed; ++seed, ++altered) read(mutated(bytes, seed));
    }
    if (of_target == 0) return fmt::print(stderr, "no inputs for {}\n", name), 1;
    replayed += of_target;
  }
  fmt::print("{} inputs and {} changed ones were read or refused\n", replayed, altered);
}

#endif
