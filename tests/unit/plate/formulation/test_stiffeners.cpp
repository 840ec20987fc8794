#include "plate/formulation/springs_and_stiffeners.hpp"

#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;
using geometry::Point;

namespace {

ElasticSupport support_of(const Stiffener& beam, const geometry::Tessellation& cells) {
  ElasticSupportSum sum(cells.positions.size());
  add_stiffener(beam, PlateLaw::bending, cells, sum);
  return std::move(sum).taken("stiffener0", std::nullopt, false);
}

}  // namespace

TEST_CASE("stiffeners: one element is the beam of Bernoulli, whatever its slopes and ends") {
  const auto cells = gp::cells(geometry::rectangle(0, 0, 4, 4), 1);
  Stiffener beam;
  beam.bending = 7, beam.along = {{1, 1}, {2, 1}};
  const auto part = support_of(beam, cells);
  const auto node = [&](double x) {
    return std::ranges::min_element(cells.positions, {}, [&](const Point& p) { return (p - Point(x, 1)).norm(); }) -
           cells.positions.begin();
  };
  // Hermite: EI / 2 times the integral of w,xx^2 of the cubic line with these ends and slopes, l = 1
  for (const auto& [w0, s0, w1, s1] : {std::tuple{0.3, 1.0, -0.2, 0.5}, {0.0, 0.0, 1.0, 0.0}, {0.0, 1.0, 0.0, 0.0}}) {
    State u = State::Zero(3, Eigen::Index(cells.positions.size()));
    u.col(node(1)) << w0, 0, -s0;
    u.col(node(2)) << w1, 0, -s1;
    const double d = w1 - w0;
    const double energy = 7.0 / 2 * (12 * d * d - 12 * d * (s0 + s1) + 4 * (s0 * s0 + s0 * s1 + s1 * s1));
    CHECK(part.energy(u) == Approx(energy).epsilon(1e-12));
  }
}

TEST_CASE("stiffeners: mass is shared out among the points, all of it") {
  Problem problem;
  CHECK(stiffener_masses(problem, gp::scenes().front()).empty());
  Stiffener beam;
  beam.bending = 1, beam.mass = 3, beam.along = {{0.13, 0.2}, {0.5, 0.61}, {0.8, 0.3}};
  problem.stiffeners = {beam};
  const auto masses = stiffener_masses(problem, gp::cells(geometry::rectangle(0, 0, 1, 1), 0.1));
  double sum = 0;
  for (const double m : masses) sum += m;
  CHECK(sum == Approx(3 * (std::hypot(0.37, 0.41) + std::hypot(0.3, 0.31))).epsilon(1e-12));
}
