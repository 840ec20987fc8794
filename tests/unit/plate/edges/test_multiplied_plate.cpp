#include "plate/edges/multiplied_plate.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;
using geometry::Point;

namespace {

const Section multiplied_section{200, 0.25, 0.3};

SurfacePlate small_plate(double width = 2, double height = 1.5) {
  Discretization d;
  d.spacing = 0.25;
  return surface_plate(multiplied_section, d, {0, 0}, {width, height});
}

/// w = 1; w = x, theta_y = -1; w = y, theta_x = 1: of real nodes, then of surface nodes.
Eigen::MatrixXd rigid(const SurfacePlate& p) {
  Eigen::MatrixXd result(p.unknowns(), 3);
  for (int k = 0; k < p.unknowns() / 3; ++k) {
    const Point at = k < p.body.real ? p.at(k) : p.at_surface(k - p.body.real);
    result.middleRows<3>(3 * k) << 1, at.x(), at.y(), 0, 0, 1, 0, -1, 0;
  }
  return result;
}

Eigen::Vector3d pressure(const Point&) {
  return {1, 0, 0};
}

EdgeCondition clamped(const Point&, const Point&) {
  return edge_condition(SupportKind::clamped);
}

}  // namespace

TEST_CASE("multiplied plate: rigid motions cause no force and no flux, and values at edges are theirs") {
  const auto p = small_plate(2.05, 1.5);
  const Eigen::Index real = 3 * p.body.real, surface = p.unknowns() - real;
  for (const bool holds : {false, true}) {
    const auto made = multiplied_plate(p, std::vector<char>(std::size_t(surface), holds));
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(real + 2 * surface, 3);
    motions.topRows(real + surface) = rigid(p);
    const double force = (made.stiffness * motions).cwiseAbs().maxCoeff();
    INFO(force);
    CHECK(force < 1e-11 * multiplied_section.young);  // measured: 1.4e-16
    CHECK(made.idle.size() == (holds ? 3 * 4 : 0));   // one of each pair at each corner
  }
}

TEST_CASE("multiplied plate: multipliers of fluxes have no resultant, those of values their own at the edge") {
  const auto p = small_plate(2.05, 1.5);
  const Eigen::Index real = 3 * p.body.real, surface = p.unknowns() - real;
  const Eigen::MatrixXd motions = rigid(p);
  for (const bool holds : {false, true}) {
    const auto made = multiplied_plate(p, std::vector<char>(std::size_t(surface), holds));
    const Eigen::MatrixXd added = made.stiffness.block(0, real + surface, real, surface);
    Eigen::MatrixXd resultants = added.transpose() * motions.topRows(real);
    for (Eigen::Index i = 0; holds && i < surface; ++i)
      if (std::ranges::find(made.idle, int(real + surface + i)) == made.idle.end())
        resultants.row(i) -= motions.row(real + i);
    const double most = resultants.cwiseAbs().maxCoeff();
    INFO(most);
    CHECK(most < 1e-11 * (holds ? 1 : multiplied_section.young));  // measured: 1.4e-16, 4.4e-16
  }
}

TEST_CASE("multiplied plate: what holds a clamped plate is its load, and points at the edges follow") {
  const auto p = small_plate();
  const Eigen::Index real = 3 * p.body.real, surface = p.unknowns() - real;
  auto [right, held] = edge_problem(p, clamped, pressure);
  const auto made = multiplied_plate(p, std::vector<char>(std::size_t(surface), true));
  const std::size_t of_edges = held.size();
  for (const int one : made.idle) held.push_back({one, 0});
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(real + 2 * surface);
  loads.head(right.size()) = right;
  const auto found = constrained_solution(made.stiffness, loads, held);
  double sum = 0;
  for (std::size_t i = 0; i < of_edges; ++i)
    if (held[i].unknown % 3 == 0) sum += found.reactions[Eigen::Index(i)];
  CHECK(sum == Approx(-3).epsilon(1e-9));
  CHECK(added_forces(made.stiffness, p, found.values, 1) > 1e-3);
  const auto again = multiplied_solution(p, clamped, pressure);
  CHECK((again - found.values.head(real)).norm() < 1e-12 * again.norm());
  CHECK(again[3 * (p.body.real / 2 + 4)] > 0);
}

TEST_CASE("multiplied plate: too few points for an order, orders without meaning, and loose plates are refused") {
  auto p = small_plate(0.5, 1.5);
  const auto none = [&] { return std::vector<char>(std::size_t(p.unknowns() - 3 * p.body.real), false); };
  CHECK_THROWS_AS(multiplied_plate(p, none()), Refused);
  p = small_plate();
  p.orders = {1, 1};
  CHECK_THROWS_AS(multiplied_plate(p, none()), std::invalid_argument);
  const auto free = [](const Point&, const Point&) { return edge_condition(SupportKind::free); };
  CHECK_THROWS_AS(multiplied_solution(small_plate(), free, pressure), Refused);
}
