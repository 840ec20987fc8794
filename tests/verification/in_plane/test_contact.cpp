// Cracks whose faces touch. References: infinite plates by an own dual integral equation, the openings in Chebyshev
// polynomials (6 digits; without contact it gives the published factors of infinite plates); squares by own finite
// elements; fields that are the same everywhere; symmetry.
#include <fmt/format.h>
#include <Eigen/Geometry>
#include <numbers>

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "post/files/sinks.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"

using geometry::Point;

namespace {

/// A square plate with a crack, under an edge moment and an edge traction on its lower and upper sides.
struct Cracked {
  double thickness = 0.1, side = 1, length = 0.5, spacing = 1.0 / 20;
  double moment = 1, traction = 0;
  double angle = 0, turn = 0;  // of the crack from the lower side; of the whole plate [degrees]
  Point middle{0, 0};          // of the crack
  bool contact = true;
  double pressure = 0;         // with hard simple supports all round
  bool held_in_plane = false;  // by these
  std::string section = "young = 1.0\npoisson = 0.3";

  std::string toml() const {
    const Eigen::Rotation2Dd whole(turn * std::numbers::pi / 180), own(angle * std::numbers::pi / 180);
    const auto at = [&](const Point& x) {
      const Point y = whole * x;
      return fmt::format("[{:.17g}, {:.17g}]", y.x(), y.y());
    };
    const double a = side / 2;
    const Point half = own * Point(length / 2, 0);
    std::string text = fmt::format(
        "[section]\n{}\nthickness = {}\n[geometry]\noutline = {{ polygon = [{}, {}, {}, {}], edges = [\"bottom\", "
        "\"right\", \"top\", \"left\"] }}\ncracks = [[{}, {}]]\n[cracks]\ncontact = {}\n[discretization]\nspacing = "
        "{}\nformulation = \"galerkin\"\n",
        section, thickness, at({-a, -a}), at({a, -a}), at({a, a}), at({-a, a}), at(middle - half), at(middle + half),
        contact, spacing);
    text += pressure != 0 ? fmt::format(
                                "[[support]]\nkind = \"simply_supported_hard\"\nin_plane = \"{}\"\nedges = "
                                "[\"left\", \"right\", \"bottom\", \"top\"]\n[[load]]\nkind = "
                                "\"pressure\"\nvalue = {}\n",
                                held_in_plane ? "fixed" : "free", pressure)
                          : fmt::format("[[support]]\nkind = \"pinned\"\npoints = [{}, {}, {}]\n", at({-a, -a}),
                                        at({a, -a}), at({a, a}));
    if (moment != 0)
      text += fmt::format("[[load]]\nkind = \"edge_moment\"\nedges = [\"bottom\", \"top\"]\nvalue = {}\n", moment);
    if (traction != 0)
      text += fmt::format(
          "[[support]]\nkind = \"in_plane\"\npoints = [{}, {}]\n[[load]]\nkind = \"edge_traction\"\nedges = "
          "[\"bottom\", \"top\"]\nvalue = {}\n",
          at({0, -a}), at({spacing, -a}), traction);
    return text + "[analysis]\nkind = \"static\"\n[srif]\n";
  }
};

struct Run {
  post::ResultsInMemory results;
  post::Summary summary;

  explicit Run(const Cracked& plate) {
    const auto file = cases::read_case_text(plate.toml(), "contact", {});
    summary = cases::run(file, {.folder = {}, .quiet = true, .in_memory = &results});
  }
  /// Recommended factors of a tip.
  const post::Srif& tip(std::size_t which) const { return *post::recommended(summary.srif).at(which); }
  std::vector<double> column(const std::string& name) const {
    const auto found = std::ranges::find(results.tables, "contact", &std::pair<std::string, post::Table>::first);
    REQUIRE(found != results.tables.end());
    std::vector<double> values;
    for (const auto& row : found->second.rows) values.push_back(std::get<double>(row[found->second.column(name)]));
    return values;
  }
};

double largest(const std::vector<double>& values) {
  return *std::ranges::max_element(values);
}

/// Checks of any state: nothing overlaps or is pulled, and what is open is not pressed.
void check_complementarity(const Run& run) {
  for (const std::string face : {"above", "below"}) {
    const auto opening = run.column("opening_" + face), pressure = run.column("pressure_" + face);
    for (std::size_t i = 0; i < opening.size(); ++i) {
      CHECK(opening[i] >= -1e-9 * largest(run.column("opening_above")));
      CHECK(pressure[i] >= 0);
      CHECK(opening[i] * pressure[i] == 0);
    }
  }
}

}  // namespace

TEST_CASE("contact: factors of a crack in an infinite plate, at any angle and place", "[in_plane]") {
  struct Reference {
    double over_half_length, K1;  // the thickness; K1 over M sqrt(a), nu = 0.3
  };
  static const std::vector<Reference> references{{0.4, 0.2210837}, {1, 0.2286582}, {4, 0.2430584}};
  const auto& reference = GENERATE(from_range(references));
  const double angle = GENERATE(0.0, 30.0, 45.0), shift = GENERATE(0.0, 0.31);
  const double a = 0.05;
  Cracked plate{.thickness = reference.over_half_length * a,
                .side = 4,
                .length = 2 * a,
                .spacing = 0.1,
                .angle = angle,
                .middle = shift * Point(0.1, 0.07)};
  const Run run(plate);
  check_complementarity(run);
  const double across = std::pow(std::cos(angle * std::numbers::pi / 180), 2);
  const double K1 = reference.K1 * std::sqrt(a) * across;
  for (const std::size_t which : {0, 1}) {
    const auto& tip = run.tip(which);
    INFO("thickness " << plate.thickness << ", angle " << angle << ", shift " << shift << ", K1 " << tip.K1 / K1 - 1);
    CHECK(std::abs(tip.K1 - K1) < 0.003 * K1);
    CHECK(std::abs(tip.K1 - K1) < *tip.errors[0]);
    REQUIRE(tip.membrane);
    CHECK(tip.membrane->N[0] == Approx(6 * tip.K1 / plate.thickness));
  }
  CHECK(run.summary.contact->closed_share == Approx(1));
}

TEST_CASE("contact: squares against finite elements", "[in_plane]") {
  struct Square {
    double thickness, length, moment, pressure;
    bool held_in_plane;
    double K1;
  };
  // own finite elements of degree 5, graded to the tips, contact at their points: 4 digits
  static const std::vector<Square> squares{{0.02, 0.5, 1, 0, false, 0.13343},   {0.1, 0.5, 1, 0, false, 0.13986},
                                           {0.1, 0.2, 1, 0, false, 0.075639},   {0.1, 0.3, 1, 0, false, 0.095735},
                                           {0.05, 0.4, 0, 1, false, 0.0047268}, {0.05, 0.4, 0, 1, true, 0.0037068}};
  const auto& one = GENERATE(from_range(squares));
  const Run run(Cracked{.thickness = one.thickness,
                        .length = one.length,
                        .spacing = 1.0 / 40,
                        .moment = one.moment,
                        .pressure = one.pressure,
                        .held_in_plane = one.held_in_plane});
  check_complementarity(run);
  const auto& tip = run.tip(1);
  INFO("thickness " << one.thickness << ", 2a/W " << one.length << ", K1 " << tip.K1 / one.K1 - 1);
  CHECK(std::abs(tip.K1 - one.K1) < 0.005 * one.K1);  // 0.38 % of the thinnest, else 0.1 %
  CHECK(std::abs(tip.K1 - one.K1) < *tip.errors[0]);
  CHECK(std::abs(tip.membrane->N[0] - 6 * one.K1 / one.thickness) < *tip.membrane->errors[0]);
}

TEST_CASE("contact: even pressure leaves no factor of opening", "[in_plane]") {
  const double turn = GENERATE(0.0, 17.0, 45.0);
  // N h / 2 = -M: the face z < 0 is pressed by N, the face z > 0 just closed; then both by the same
  const auto [moment, traction] = GENERATE(std::pair(1.0, -20.0), std::pair(0.0, -1.0));
  const Run run(Cracked{.length = 0.3, .moment = moment, .traction = traction, .turn = turn});
  check_complementarity(run);
  for (const std::size_t which : {0, 1}) {
    const auto& tip = run.tip(which);
    CHECK(std::abs(tip.K1) < 1e-5 * 0.1 * std::abs(traction));
    CHECK(std::abs(tip.membrane->N[0]) < 1e-4 * std::abs(traction));
  }
  const auto below = run.column("pressure_below"), above = run.column("pressure_above");
  for (std::size_t i = 0; i < below.size(); ++i) CHECK(above[i] + below[i] == Approx(-traction).epsilon(1e-3));
  for (const auto& warning : run.summary.warnings) CHECK_THAT(warning, !Catch::Contains("unresolved"));
}

TEST_CASE("contact: a moment of the other sign closes the other face", "[in_plane]") {
  const Run run(Cracked{.angle = 30}), mirrored(Cracked{.moment = -1, .angle = 30});
  for (const std::size_t which : {0, 1}) {
    const auto &tip = run.tip(which), &other = mirrored.tip(which);
    CHECK(other.K1 == Approx(-tip.K1));
    CHECK(other.K2 == Approx(-tip.K2));
    CHECK(other.K3 == Approx(-tip.K3));
    CHECK(other.membrane->N[0] == Approx(tip.membrane->N[0]));
  }
  CHECK(largest(run.column("pressure_below")) == Approx(largest(mirrored.column("pressure_above"))));
  CHECK(largest(run.column("pressure_above")) == 0);
}

TEST_CASE("contact: factors of cracks that stay closed add up, enough tension opens them", "[in_plane]") {
  const auto with = [](double traction, bool contact = true) {
    return Run(Cracked{.length = 0.3, .traction = traction, .contact = contact});
  };
  const Run none = with(0), some = with(10), more = with(20), open = with(60);
  CHECK(more.tip(0).K1 - some.tip(0).K1 == Approx(some.tip(0).K1 - none.tip(0).K1).epsilon(1e-3));
  CHECK(open.summary.contact->closed_share == 0);
  CHECK(open.summary.contact->least_opening > 0);
  const Run apart = with(60, false);
  CHECK(open.tip(0).K1 == Approx(apart.tip(0).K1).epsilon(5e-3));  // the tips have other points
  CHECK(open.tip(0).membrane->N[0] == Approx(apart.tip(0).membrane->N[0]).epsilon(5e-3));
}

TEST_CASE("contact: the plate goes with its axes", "[in_plane]") {
  const Run straight(Cracked{.angle = 30});
  const Run turned(Cracked{.angle = 30, .turn = GENERATE(17.0, 45.0, 90.0)});
  for (const std::size_t which : {0, 1}) {
    CHECK(turned.tip(which).K1 == Approx(straight.tip(which).K1).epsilon(2e-3));
    CHECK(turned.tip(which).K2 == Approx(straight.tip(which).K2).epsilon(2e-3));
    CHECK(turned.tip(which).membrane->N[0] == Approx(straight.tip(which).membrane->N[0]).epsilon(2e-3));
  }
}

TEST_CASE("contact: a uniform moment that closes nothing is carried as by the plate without a crack", "[in_plane]") {
  // the crack lies along the moment: Myy = 0 on it
  const Run run(Cracked{.angle = 90});
  CHECK(run.summary.contact->largest_pressure < 1e-9);
}
