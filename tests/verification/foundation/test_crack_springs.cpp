// Springs between the faces of cracks: energy release of a strip in closed form, a beam cut in two, cracks through a
// part of the thickness against the line spring equations of Rice and Levy (1972).
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/problems.hpp"
#include "cases/runs/run_plan.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
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
  for (const double share : {0.3, 1.0, 3.0, 10.0}) {
    const double k = share * D / H, released = whole - turn * 2 * turn / (2 * H / D + 1 / k);
    const auto summary =
        found(turned_strip("galerkin", 0.1, fmt::format("[[spring]]\ncracks = [0]\nrotation_normal = {}\n", k)));
    CAPTURE(share);
    for (const auto& srif : summary.srif)  // measured: 0.53 % and 0.075 %
      if (srif.G)
        CHECK(*srif.G == Approx(released).epsilon(srif.method == post::SrifMethod::domain_integral ? 8e-3 : 1e-3));
  }
}

TEST_CASE("springs on a crack: a beam cut in two turns and parts by what it carries", "[crack springs]") {
  // at the cut, per width: what the support of the right half carries, and its moment
  constexpr double carried = 0.25, width = 0.4, kw = 20;
  const double D = stiffness(0), k = 0.5 * D;
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    CAPTURE(formulation);
    post::ResultsInMemory tables;
    const auto spring = fmt::format(
        "[[spring]]\ncracks = [0]\ndeflection = {}\nrotation_normal = {}\n"
        "rotation_tangential = {}\n",
        kw, k, D);
    const auto joined =
        cases::run(cases::read_case_text(cut_beam(formulation, spring), "plate", {}), {{}, true, &tables});
    CHECK(value_of(joined.lines, "moment") == Approx(width * carried).epsilon(1e-6));
    CHECK(value_of(joined.lines, "shear") == Approx(width * carried).epsilon(1e-4));
    const auto& rows =
        std::ranges::find(tables.tables, "crack_springs", &std::pair<std::string, post::Table>::first)->second;
    const auto number = [&](const std::string& column) {
      return std::get<double>(rows.rows[rows.rows.size() / 2][rows.column(column)]);
    };
    CHECK(number("rotation") == Approx(carried / k).epsilon(1e-3));
    // small beside deflections, which bonds carry to the faces by linear fields: measured 0.4 and 9 %
    CHECK(number("deflection") == Approx(carried / kw).epsilon(formulation == "galerkin" ? 0.01 : 0.12));
  }
}

TEST_CASE("springs on a crack: a dowelled joint beside a wheel, the same when the plate or the joint is turned round",
          "[crack springs]") {
  // the wheel's point moves the numbers of the points from face to face along the joint
  const auto joint = [](const std::string& crack, double wheel) {
    post::ResultsInMemory tables;
    const auto text = section(0.2) + "[geometry]\noutline = { rectangle = [0.0, 0.0, 2.0, 1.0] }\ncracks = [" + crack +
                      "]\n[[foundation]]\nmodulus = 3.0\n[[spring]]\ncracks = [0]\ndeflection = 20.0\n[[load]]\nkind = "
                      "\"point_force\"\nvalue = -1.0\nposition = [" +
                      fmt::format("{}, 0.5]\n", wheel) + points("galerkin", 0.05);
    const auto summary = cases::run(cases::read_case_text(text, "plate", {}), {{}, true, &tables});
    const auto& rows =
        std::ranges::find(tables.tables, "crack_springs", &std::pair<std::string, post::Table>::first)->second;
    double least = INFINITY, most = -INFINITY;
    for (const auto& row : rows.rows) {
      const double shear = std::get<double>(row[rows.column("shear")]);
      if (const double y = std::get<double>(row[rows.column("y")]); y > 0.3 && y < 0.7)
        least = std::min(least, shear), most = std::max(most, shear);
    }
    CHECK(least * most > 0);  // one sign beside the wheel
    return value_of(summary.lines, "shear");
  };
  const double up = joint("[[1.0, 0.0], [1.0, 1.0]]", 0.9), down = joint("[[1.0, 1.0], [1.0, 0.0]]", 0.9);
  CHECK(std::abs(up) > 0.05);
  CHECK(down == Approx(-up).epsilon(1e-9));
  CHECK(joint("[[1.0, 0.0], [1.0, 1.0]]", 1.1) == Approx(-up).epsilon(1e-3));
}

TEST_CASE("springs on a crack: stiff ones leave an uncut plate, all resist the motion of the beam", "[crack springs]") {
  const std::string stiff =
      "[[spring]]\ncracks = [0]\ndeflection = 1e5\nrotation_normal = 1e4\nrotation_tangential = 1e4\n";
  auto whole = cut_beam("galerkin", "");
  whole.erase(whole.find("cracks ="), whole.find("[[support]]") - whole.find("cracks ="));
  const auto joined = found(cut_beam("galerkin", stiff)), uncut = found(whole);
  for (std::size_t i = 0; i < joined.probes.size(); ++i)
    if (joined.probes[i].quantity == "w") CHECK(joined.probes[i].value == Approx(uncut.probes[i].value).epsilon(1e-4));
  const auto strain = [](const post::Summary& summary) {
    return std::ranges::find(summary.energy, "strain", &std::pair<std::string, double>::first)->second;
  };
  CHECK(strain(joined) == Approx(strain(uncut)).epsilon(1e-4));
}

TEST_CASE("a crack through a part of the thickness: Rice and Levy's equations of a thin plate", "[crack springs]") {
  // semi-elliptic, half length 0.05, half of the thickness deep: K at its middle over sqrt(depth), by a series of 61
  // terms for the classical plate; thicknesses of 1/25 of the half length
  constexpr double half = 0.05, depth = 0.001, h = 0.002;
  for (const auto& [load, expected] :
       {std::pair{fmt::format("kind = \"edge_traction\"\nvalue = {}\n", h), 2.48365},
        std::pair{fmt::format("kind = \"edge_moment\"\nvalue = {}\n", h * h / 6), 1.27722}}) {
    for (const bool below : {false, true}) {
      CAPTURE(load, below);
      auto text = fmt::format(
          "[section]\nyoung = 1000\npoisson = 0.3\nthickness = {}\n[geometry]\noutline = {{ rectangle = [-0.5, -0.5, "
          "0.5, 0.5] }}\ncracks = [[[-{}, 0.0], [{}, 0.0]]]\n[[support]]\nkind = \"pinned\"\npoints = [[-0.5, -0.5], "
          "[0.5, -0.5], [0.0, 0.5]]\n[[support]]\nkind = \"in_plane\"\nin_plane = \"fixed\"\npoints = [[-0.5, 0.0]]\n"
          "[[support]]\nkind = \"in_plane\"\nin_plane = \"y\"\npoints = [[0.5, 0.0]]\n[[spring]]\ncracks = [0]\n"
          "depth = \"{}*sqrt(1-min(1,(x/{})^2))\"\n{}[[load]]\n{}edges = [\"bottom\", \"top\"]\n",
          h, half, half, depth, half, below ? "from = \"below\"\n" : "", load);
      if (below && load.find("moment") != load.npos) text.replace(text.find("value = "), 8, "value = -");
      auto graded = points("galerkin", 1.0 / 30);
      graded.insert(graded.find("[output]"), "tip_spacing = 0.005\nspacing_growth = 0.15\n");
      const auto summary = found(text + graded);
      const auto front = std::ranges::find(summary.lines, "K_front", &post::ProbeValue::quantity);
      REQUIRE(front != summary.lines.end());
      CHECK(front->value / std::sqrt(depth) == Approx(expected).epsilon(0.008));
      CHECK(summary.warnings.empty());
      CHECK(std::abs(front->position.x()) < 0.15 * half);  // the place next to the middle: they are 0.011 apart
    }
  }
}

TEST_CASE("a crack through a part of the thickness that is pressed is told", "[crack springs]") {
  const auto summary = found(cut_beam("galerkin", "[[spring]]\ncracks = [0]\ndepth = 0.02\nfrom = \"below\"\n"));
  const auto other = found(cut_beam("galerkin", "[[spring]]\ncracks = [0]\ndepth = 0.02\n"));
  const auto told = [](const post::Summary& one) {
    return std::ranges::count_if(one.warnings,
                                 [](const auto& text) { return text.find("faces overlap") != text.npos; });
  };
  CHECK(told(summary) + told(other) == 1);
  CHECK(value_of(summary.lines, "moment") == Approx(value_of(other.lines, "moment")).epsilon(1e-6));
}

TEST_CASE("springs on a crack: what they cannot be", "[crack springs]") {
  const auto refused = [](const std::string& spring) {
    try {
      found(cut_beam("galerkin", "[[spring]]\n" + spring));
    } catch (const cases::CaseError& error) {
      return error.problems().front().key + ": " + error.problems().front().what;
    }
    return std::string("accepted");
  };
  CHECK(refused("cracks = [1]\ndeflection = 1\n").starts_with("spring[0].cracks: 1 given, must be from 0 to 0"));
  CHECK(refused("cracks = [0.5]\ndeflection = 1\n").find("must be a number of a crack") != std::string::npos);
  CHECK(refused("cracks = [0]\n").find("resists nothing") != std::string::npos);
  CHECK(refused("cracks = [0]\ndepth = 0.01\nopening = 1\n").find("remove the others") != std::string::npos);
  CHECK(refused("cracks = [0]\ndepth = 0.049\n").starts_with("spring[0].depth: 0.049 at"));
  CHECK(refused("edges = [\"top\"]\nopening = 1\n").find("are of springs on cracks") != std::string::npos);
}
