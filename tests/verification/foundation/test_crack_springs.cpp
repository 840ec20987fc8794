// Springs between the faces of cracks: strips with closed forms at rest, energy release, dowels on soil, cracks through
// a part of the thickness.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/problems.hpp"
#include "cases/runs/run_plan.hpp"
#include "plate/model/part_through_crack.hpp"
#include "plate/model/section.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"

namespace {

constexpr double young = 1000, thickness = 0.05;

double stiffness(double poisson) {
  return young * std::pow(thickness, 3) / 12 / (1 - poisson * poisson);
}

post::Summary found(const std::string& text) {
  post::ResultsInMemory unused;
  return cases::run(cases::read_case_text(text, "plate", {}), {{}, true, &unused});
}

std::string section(double poisson) {
  return fmt::format("[section]\nyoung = {}\npoisson = {}\nthickness = {}\n", young, poisson, thickness);
}

std::string points(const std::string& formulation, double spacing) {
  return fmt::format(
      "[analysis]\nkind = \"static\"\n[discretization]\nspacing = {}\nformulation = \"{}\"\n[output]\nfields = []\n"
      "errors = false\n",
      spacing, formulation);
}

double value_of(const std::vector<post::ProbeValue>& values, const std::string& quantity) {
  const auto found = std::ranges::find(values, quantity, &post::ProbeValue::quantity);
  REQUIRE(found != values.end());
  return found->value;
}

/// 6 x 2 about the origin, whose edges y = +-1 turn against each other by 0.01 each; a crack from the left to the
/// middle.
std::string turned_strip(const std::string& formulation, double spacing, const std::string& spring) {
  return section(0.3) +
         "[geometry]\noutline = { rectangle = [-3.0, -1.0, 3.0, 1.0] }\ncracks = [[[-3.0, 0.0], [0.0, 0.0]]]\n"
         "[[support]]\nkind = \"clamped\"\nedges = [\"top\"]\n[[support]]\nkind = \"clamped\"\nedges = [\"bottom\"]\n"
         "[[support]]\nkind = \"symmetry\"\nedges = [\"left\", \"right\"]\n"
         "[[load]]\nkind = \"settlement\"\nsupport = 0\nvalue = 0\nrotation = -0.01\n"
         "[[load]]\nkind = \"settlement\"\nsupport = 1\nvalue = 0\nrotation = -0.01\n[srif]\n" +
         spring + points(formulation, spacing);
}

/// 2 x 0.4, simply supported left and right, pressed by 1 on its left half: a beam, as nothing contracts across it. The
/// crack cuts it in the middle.
std::string cut_beam(const std::string& formulation, const std::string& spring) {
  return section(0) +
         "[geometry]\noutline = { rectangle = [-1.0, -0.2, 1.0, 0.2] }\ncracks = [[[0.0, -0.2], [0.0, 0.2]]]\n"
         "[[support]]\nkind = \"simply_supported_hard\"\nedges = [\"left\", \"right\"]\n"
         "[[load]]\nkind = \"pressure\"\nvalue = 1.0\non = { polygon = [[-1, -0.2], [0, -0.2], [0, 0.2], [-1, 0.2]] "
         "}\n" +
         spring + points(formulation, 0.05) + "probes = { a = [-0.001, 0.0], b = [0.001, 0.0] }\n";
}

}  // namespace

TEST_CASE("springs on a crack: the energy released at its tip in a turned strip", "[crack springs]") {
  constexpr double turn = 0.01, H = 1;
  const double D = stiffness(0.3), whole = D * turn * turn / H;
  for (const std::string formulation : {"galerkin", "ordinary"})
    for (const double share : {0.3, 1.0, 3.0}) {
      const double k = share * D / H, M = 2 * turn / (2 * H / D + 1 / k);
      const auto summary =
          found(turned_strip(formulation, 0.1, fmt::format("[[spring]]\ncracks = [0]\nrotation_normal = {}\n", k)));
      CAPTURE(formulation, share, summary.srif.front().errors[0].value_or(0));
      REQUIRE(summary.srif.front().G);
      CHECK(*summary.srif.front().G == Catch::Approx(whole - turn * M).epsilon(0.02));
    }
}

TEST_CASE("springs on a crack: a beam cut in two turns and parts by what it carries", "[crack springs]") {
  constexpr double moment = 0.25, shear = -0.25;  // at the cut, per width: the right half is held by its support alone
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    const double D = stiffness(0), k = 0.5 * D, kw = 20;
    const auto joined = found(cut_beam(
        formulation, fmt::format("[[spring]]\ncracks = [0]\ndeflection = {}\nrotation_normal = {}\n"
                                 "rotation_tangential = {}\n",
                                 kw, k, D)));
    CAPTURE(formulation);
    CHECK(std::abs(value_of(joined.lines, "moment")) == Catch::Approx(0.4 * moment).epsilon(2e-3));
    CHECK(std::abs(value_of(joined.lines, "shear")) == Catch::Approx(0.4 * std::abs(shear)).epsilon(2e-3));
  }
}
