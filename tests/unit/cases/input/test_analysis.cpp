#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("mixed precision is for motions, and not for plates so thin that rounding would show") {
  const auto with = [](const char* thickness, const char* analysis) {
    return with_line(with_line(plain, 17, analysis), 4, std::string("density = 1\nthickness = ") + thickness);
  };
  const char* const motion = "kind = \"dynamic\"\nduration = 1\nprecision = \"mixed\"";
  CHECK(read(with("0.1", motion)).content.analysis.precision == cases::Analysis::Precision::mixed);
  expect(with("0.001", motion), ":20", "analysis.precision", "above 0.3; choose \"double\"");
  expect(with("0.1", "kind = \"static\"\nprecision = \"mixed\""), ":19", "analysis.precision", "dynamics only");
}

TEST_CASE("a frequency analysis needs a density and no load") {
  const std::string kind = with_line(plain, 17, "kind = \"frequencies\"");
  const std::string dense = with_line(kind, 4, "thickness = 0.1\ndensity = 1");
  expect(dense, ":15", "load[0].kind", "bends the plate: frequencies are those of a flat plate");
  const std::string frequencies = with_line(with_line(with_line(dense, 14, ""), 15, ""), 16, "");
  CHECK(problems(frequencies).empty());
  expect(with_line(frequencies, 5, ""), ":1", "section.density", "is missing");
  expect(frequencies, "--set analysis.method", "analysis.method", "must be \"lanczos\" in frequencies",
         {"analysis.method=cg"});
  expect(frequencies, "--set analysis.duration", "analysis.duration", "in dynamics only", {"analysis.duration=1"});
  expect(frequencies, "--set analysis.modes", "analysis.modes", "an integer in [1, 1000]", {"analysis.modes=0"});
  expect(frequencies, "--set output.every", "output.every", "in dynamics only", {"output.every=1"});
  expect(frequencies, "--set output.probes", "output.probes", "in statics and dynamics and harmonic analyses only",
         {"output.probes={a=[0, 0.5]}"});
  expect(frequencies, "--set srif.skip", "srif", "in statics and dynamics and harmonic analyses only", {"srif.skip=1"});
}

TEST_CASE("keys of the other kind of analysis are refused") {
  const auto analysis = [](const std::string& lines) { return with_line(plain, 17, lines); };
  expect(analysis("kind = \"static\"\nduration = 1"), ":18", "analysis.duration", "is used in dynamics only");
  expect(analysis("kind = \"static\"\nmethod = \"central_difference\""), ":18", "analysis.method",
         "must be \"cg\" or \"adr\" or \"direct\"");
  expect(with_line(plain, 15, "value = 1\nhistory = \"step\""), ":16", "load[0].history", "in dynamics only");
  expect(plain + "[output]\nevery = 1\n", ":19", "output.every", "in dynamics only");
  const std::string dynamic =
      with_line(analysis("kind = \"dynamic\"\nduration = 1"), 4, "thickness = 0.1\ndensity = 1");
  CHECK(problems(dynamic).empty());
  expect(dynamic, "--set analysis.tolerance", "analysis.tolerance", "is of method = \"lanczos\"",
         {"analysis.tolerance=1e-6"});
  expect(dynamic, "--set analysis.method", "analysis.method", "must be \"central_difference\"",
         {"analysis.method=adr"});
  expect(analysis("kind = \"dynamic\"\nduration = 1"), ":1", "section.density", "is missing");
  expect(analysis("kind = \"static\"\nmodes = 3"), ":18", "analysis.modes", "in frequencies and buckling only");
  expect(with_line(dynamic, 19, ""), ":17", "analysis.duration", "is missing");
  expect(dynamic, "--set load[0].rise_time", "load[0].rise_time", "with history = ramp only", {"load[0].rise_time=1"});
  expect(dynamic, ":14", "load[0].rise_time", "is missing", {"load[0].history=ramp"});
  expect(dynamic, "--set load[0].history", "load[0].history", "must ascend", {"load[0].history=[[0, 1], [0, 2]]"});
  expect(dynamic, "--set load[0].history", "load[0].history", "did you mean 'step'?", {"load[0].history=stop"});
  expect(dynamic, "--set analysis.time_step", "analysis.time_step", "\"auto\" or a number > 0",
         {"analysis.time_step=0"});
}
