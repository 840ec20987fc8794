// Reactions of plates that are held in every way, with equilibrium as the oracle.
#include "post/report/reactions.hpp"

#include <fmt/format.h>

#include <numbers>

#include "cases/driver/prepared.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/statics.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

struct Solved {
  cases::CaseFile file;
  std::unique_ptr<const plate::Formulation> plate;
  plate::State state;
};

/// Solved to rounding.
Solved solved(std::vector<std::string> settings, const std::string& formulation) {
  settings.push_back("analysis.method=direct");
  settings.push_back("discretization.formulation=" + formulation);
  Solved result{read(plain, settings), {}, {}};
  result.plate = cases::discretised(result.file).plate;
  result.state = plate::static_solution(*result.plate, result.file.content.analysis, {1e-11, 1000, {}}).solution.state;
  return result;
}

post::ReactionRows rows_of(const Solved& one, std::size_t pieces) {
  post::ReactionRows rows;
  rows.along_edges(pieces);
  rows.add(0, *one.plate, *one.plate, one.state, 1);
  return rows;
}

post::ReactionSummary reactions_of(std::vector<std::string> settings, const std::string& formulation) {
  return rows_of(solved(std::move(settings), formulation), 0).summary().value();
}

const post::Wrench& by(const post::ReactionSummary& reactions, const std::string& name) {
  for (std::size_t i = 0; i < reactions.supports.size(); ++i)
    if (reactions.supports[i].name == name) return reactions.balance.supports[i];
  throw std::out_of_range(name);
}

std::string all_round(const std::string& kind) {
  return "support=[{kind=\"" + kind + "\",edges=[\"left\",\"right\",\"bottom\",\"top\"]}]";
}

const std::string oblique =
    "geometry.outline={polygon=[[-1,-1],[1.2,-0.8],[0.9,1],[-0.8,0.8]],edges=[\"bottom\",\"right\",\"top\",\"left\"]}";
const std::vector<std::string> shapes{"geometry.cracks=[]",
                                      "geometry.cracks=[[[-0.3,0],[0.3,0.2]],[[-1,0.4],[-0.6,0.4]]]",
                                      "geometry.holes=[{circle=[0,-0.5,0.2]}]", oblique};
const std::vector<std::string> loads{
    "load=[{kind=\"pressure\",value=2}]", "load=[{kind=\"point_force\",position=[0.32,0.57],value=3}]",
    "load=[{kind=\"edge_moment\",edges=[\"right\"],value=1,twist=0.4}]",
    "load=[{kind=\"edge_shear\",edges=[\"right\"],value=1},{kind=\"pressure\",value=-0.3}]"};

void check_balance(const std::vector<std::string>& settings, const std::string& formulation) {
  CAPTURE(settings, formulation);
  const auto found = reactions_of(settings, formulation);
  CHECK(found.balance.residual < 1e-8);
  const auto sum = found.balance.sum(), given = found.balance.loads;
  const double size = std::abs(given.force) + std::abs(given.moment_x) + std::abs(given.moment_y) + 1;
  CHECK(std::abs(sum.force + given.force) < 1e-7 * size);
  CHECK(std::abs(sum.moment_x + given.moment_x) < 1e-7 * size);
  CHECK(std::abs(sum.moment_y + given.moment_y) < 1e-7 * size);
}

}  // namespace

TEST_CASE("reactions: balance with every load, whatever holds the plate, with holes, cracks and oblique edges") {
  std::size_t number = 0;
  for (const std::string formulation : {"galerkin", "ordinary"})
    for (const std::string kind : {"clamped", "simply_supported", "simply_supported_hard"})
      for (const auto& shape : shapes)
        for (const auto& load : loads) {
          const bool held_by_right = load.find("right") == std::string::npos;
          if (formulation == "ordinary" && shape == oblique && kind != "clamped") continue;  // refused, or not needed
          if (number++ % 3 != 0) continue;  // each combination of two is still met
          check_balance({shape, load, "discretization.spacing=0.1",
                         held_by_right ? all_round(kind)
                                       : "support=[{kind=\"" + kind +
                                             "\",edges=[\"left\",\"bottom\"]},{kind=\"clamped\","
                                             "edges=[\"top\"]}]"},
                        formulation);
        }
  CHECK(number > 40);
  for (const std::string kind : {"clamped_layer", "simply_supported_layer", "simply_supported_hard_layer"})
    check_balance({shapes[1], loads[0], "discretization.spacing=0.1", all_round(kind)}, "ordinary");
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    check_balance({shapes[0], loads[3], "discretization.spacing=0.1",
                   "support=[{kind=\"symmetry\",edges=[\"left\",\"bottom\"]},{kind=\"clamped\",edges=[\"top\"]}]"},
                  formulation);
    check_balance({shapes[2], loads[0], "discretization.spacing=0.1",
                   "support=[{kind=\"clamped\",edges=[\"hole0\"]},{kind=\"pinned\",points=[[0.75,0.75]]}]"},
                  formulation);
  }
}

TEST_CASE("reactions: three pins share a force by its place between them") {
  const geometry::Point a(-0.65, -0.55), b(0.75, -0.45), c(0.05, 0.85);  // middles of cells
  for (const std::string formulation : {"galerkin", "ordinary"})
    for (const geometry::Point& at :
         {geometry::Point(0.1, 0.2), geometry::Point(-0.4, -0.33), geometry::Point(0.9, 0.9)}) {
      const auto found =
          reactions_of({"geometry.cracks=[]", "discretization.spacing=0.1",
                        "support=[{kind=\"pinned\",points=[[-0.65,-0.55],[0.75,-0.45],[0.05,0.85]]}]",
                        fmt::format("load=[{{kind=\"point_force\",position=[{},{}],value=5}}]", at.x(), at.y())},
                       formulation);
      const auto area = [](const geometry::Point& p, const geometry::Point& q, const geometry::Point& r) {
        return (q - p).x() * (r - p).y() - (q - p).y() * (r - p).x();
      };
      CAPTURE(formulation);
      CHECK(by(found, "pin0").force == Approx(-5 * area(at, b, c) / area(a, b, c)).epsilon(1e-6).margin(1e-6));
      CHECK(by(found, "pin1").force == Approx(-5 * area(a, at, c) / area(a, b, c)).epsilon(1e-6).margin(1e-6));
      CHECK(by(found, "pin2").force == Approx(-5 * area(a, b, at) / area(a, b, c)).epsilon(1e-6).margin(1e-6));
    }
}

TEST_CASE("reactions: symmetric plates have symmetric reactions, one edge alone takes all") {
  for (const std::string formulation : {"galerkin", "ordinary"})
    for (const std::string kind : {"clamped", "simply_supported", "simply_supported_hard"}) {
      CAPTURE(formulation, kind);
      const auto found = reactions_of({all_round(kind), "discretization.spacing=0.1"}, formulation);
      const auto &left = by(found, "left"), &right = by(found, "right"), &bottom = by(found, "bottom"),
                 &top = by(found, "top");
      CHECK(left.force == Approx(right.force).epsilon(1e-7));
      CHECK(bottom.force == Approx(top.force).epsilon(1e-7));
      CHECK(left.moment_y == Approx(-right.moment_y).epsilon(1e-7));
      CHECK(bottom.moment_x == Approx(-top.moment_x).epsilon(1e-7));
      CHECK(std::abs(left.moment_x) < 1e-7);
      CHECK(2 * left.force + 2 * bottom.force == Approx(-4).epsilon(1e-7));
      const auto square =
          reactions_of({all_round(kind), "geometry.cracks=[]", "discretization.spacing=0.1"}, formulation);
      CHECK(by(square, "left").force == Approx(-1).epsilon(1e-7));  // a quarter of p a^2
      const auto cantilever = reactions_of({"discretization.spacing=0.1"}, formulation);
      CHECK(by(cantilever, "left").force == Approx(-4).epsilon(1e-7));
      CHECK(std::abs(by(cantilever, "left").moment_y) < 1e-6);  // about the middle: - x F and the couple cancel
    }
}

TEST_CASE("reactions: a mirror plane takes moments alone, and what is left is half of the whole") {
  // measured 1e-5 and 5e-3 apart: where a mirror plane meets a clamped edge points have weights of their own
  for (const auto& [formulation, most] : {std::pair{std::string("galerkin"), 2e-5}, {"ordinary", 8e-3}}) {
    CAPTURE(formulation);
    const auto whole =
        reactions_of({all_round("clamped"), "discretization.spacing=0.1", "geometry.cracks=[]"}, formulation);
    const auto half = reactions_of(
        {"geometry.outline={rectangle=[-1,-1,0,1]}", "geometry.cracks=[]", "discretization.spacing=0.1",
         "support=[{kind=\"clamped\",edges=[\"left\",\"bottom\",\"top\"]},{kind=\"symmetry\",edges=[\"right\"]}]"},
        formulation);
    CHECK(by(half, "left").force == Approx(by(whole, "left").force).epsilon(most));
    CHECK(by(half, "left").moment_y == Approx(by(whole, "left").moment_y).epsilon(most));
    CHECK(by(half, "top").force == Approx(by(whole, "top").force / 2).epsilon(most));
    CHECK(std::abs(by(half, "right").force) < 1e-6);
    CHECK(std::abs(by(half, "right").moment_y) > 0.01);
  }
}

TEST_CASE("reactions: at a corner of two mirror planes each takes the moment across itself") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    const auto found = reactions_of(
        {"geometry.cracks=[]", "discretization.spacing=0.1", "load=[{kind=\"edge_moment\",edges=[\"right\"],value=3}]",
         "support=[{kind=\"symmetry\",edges=[\"left\",\"bottom\"]},{kind=\"pinned\",points=[[0.95,0.95]]}]"},
        formulation);
    CAPTURE(formulation);
    CHECK(std::abs(by(found, "left").moment_y) == Approx(6).epsilon(1e-6));
    CHECK(std::abs(by(found, "left").moment_x) < 1e-6);
    CHECK(std::abs(by(found, "bottom").moment_y) < 1e-6);
  }
}

TEST_CASE("reactions: the edges of a rectangle with hard supports share the pressure as Navier's series says") {
  const double a = 2, b = 1;
  double left = 0;  // the shear force Q_x of the series along x = 0
  for (int m = 1; m < 4000; m += 2)
    for (int n = 1; n < 400; n += 2) {
      const double pi = std::numbers::pi, alpha = m * pi / a, beta = n * pi / b;
      left -= 16 / (pi * pi * m * n) * alpha / (alpha * alpha + beta * beta) * 2 * b / (n * pi);
    }
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    CAPTURE(formulation);
    const auto found = reactions_of({"geometry.outline={rectangle=[0,0,2,1]}", "geometry.cracks=[]",
                                     "discretization.spacing=0.05", all_round("simply_supported_hard")},
                                    formulation);
    CHECK(by(found, "left").force == Approx(left).epsilon(0.02));
    CHECK(by(found, "left").force + by(found, "bottom").force == Approx(-1).epsilon(1e-7));
  }
}

namespace {

/// Outward normal of the side of a name next to a place.
geometry::Point normal_at(const plate::Boundary& boundary, const std::string& name, const geometry::Point& x) {
  const auto u = boundary.cloud.units.to_units(x);
  const plate::Side* nearest = nullptr;
  for (const auto& side : boundary.sides)
    if (side.name == name && (!nearest || std::abs(side.inside(u)) < std::abs(nearest->inside(u)))) nearest = &side;
  return nearest->outward(u);
}

/// Wrench of all pieces of an edge, and the sum of its Kirchhoff forces.
std::pair<post::Wrench, double> sum_along(const post::Table& rows, const std::string& edge,
                                          const plate::Boundary& boundary) {
  post::Wrench sum;
  double kirchhoff = 0;
  for (const auto& row : rows.rows) {
    if (std::get<std::string>(row[rows.column("support")]) != edge) continue;
    const auto number = [&](const char* column) { return std::get<double>(row[rows.column(column)]); };
    const geometry::Point x(number("x"), number("y")), n = normal_at(boundary, edge, x), s(-n.y(), n.x());
    const double length = number("piece_length");
    const geometry::Point about = length * (number("moment_per_length") * s - number("twist_per_length") * n);
    sum += post::wrench(x, 0, length * number("force_per_length"));
    sum += post::Wrench{0, about.x(), about.y()};
    kirchhoff += length * number("kirchhoff_force");
  }
  return {sum, kirchhoff};
}

/// Pieces add up to the row of every edge, Kirchhoff forces and corners to all of them.
void check_pieces(const std::vector<std::string>& settings, const std::string& formulation, std::size_t pieces) {
  CAPTURE(settings, formulation, pieces);
  const auto one = solved(settings, formulation);
  const auto rows = rows_of(one, pieces);
  const auto found = rows.summary().value();
  double all = 0, kirchhoff = 0, size = std::abs(found.balance.loads.force);
  for (const auto& support : found.balance.supports) size = std::max(size, std::abs(support.force));
  for (std::size_t i = 0; i < found.supports.size(); ++i) {
    if (one.plate->boundary().holders[i].place != plate::Holder::Place::edge) continue;
    const auto [sum, own] = sum_along(rows.edges(), found.supports[i].name, one.plate->boundary());
    const auto& expected = found.balance.supports[i];
    CHECK(std::abs(sum.force - expected.force) < 1e-10 * size);
    CHECK(std::abs(sum.moment_x - expected.moment_x) < 1e-10 * size);
    CHECK(std::abs(sum.moment_y - expected.moment_y) < 1e-10 * size);
    all += sum.force, kirchhoff += own;
  }
  for (const auto& corner : found.corners) kirchhoff += corner.force;
  CHECK(size > 0.1);
  CHECK(std::abs(kirchhoff - all) < 1e-10 * size);
  CHECK(found.corners.size() == rows.corners().rows.size());
}

}  // namespace

TEST_CASE("reactions along edges: pieces add up to what the support does, Kirchhoff forces and corners likewise") {
  const std::string load = "load=[{kind=\"pressure\",value=2},{kind=\"point_force\",position=[0.32,0.57],value=3}]";
  for (const std::string formulation : {"galerkin", "ordinary"})
    for (const std::string kind : {"clamped", "simply_supported", "simply_supported_hard"})
      for (const auto& shape : shapes) {
        if (formulation == "ordinary" && shape == oblique && kind != "clamped") continue;
        check_pieces({shape, load, "discretization.spacing=0.1", all_round(kind)}, formulation,
                     kind == "clamped" ? 7 : 40);
      }
  for (const std::string kind : {"clamped_layer", "simply_supported_layer", "simply_supported_hard_layer"})
    check_pieces({shapes[1], load, "discretization.spacing=0.1", all_round(kind)}, "ordinary", 20);
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    check_pieces({shapes[0], load, "discretization.spacing=0.1",
                  "support=[{kind=\"symmetry\",edges=[\"left\",\"bottom\"]},{kind=\"clamped\",edges=[\"top\"]}]"},
                 formulation, 10);
    check_pieces({shapes[2], load, "discretization.spacing=0.1",
                  "support=[{kind=\"clamped\",edges=[\"hole0\"]},{kind=\"pinned\",points=[[0.75,0.75]]}]"},
                 formulation, 16);
  }
}

TEST_CASE("reactions along edges: nothing is recorded that was not asked for") {
  const auto rows =
      rows_of(solved({all_round("clamped"), "discretization.spacing=0.2", "geometry.cracks=[]"}, "galerkin"), 0);
  CHECK(rows.edges().rows.empty());
  CHECK(rows.corners().rows.empty());
  CHECK(rows.summary().value().corners.empty());
}
