// Places of plates that move as rigid bodies: what is read at a place, and what a mass that hits it gives to the plate.
#include <numbers>
#include <random>

#include "plate/formulation/interpolation.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

namespace {

using Random = std::mt19937;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A triangle with a corner of 12 to 75 degrees at the origin, turned, some with a hole, and two cracks: one from near
/// the corner along an edge, so that it leaves a wedge, one inside.
cases::Case acute(Random& random, const FormulationKind& kind) {
  const double angle = between(random, 12, 75) * std::numbers::pi / 180, turn = between(random, 0, 6.28);
  const auto at = [&](double r, double phi) { return Point(r * std::cos(turn + phi), r * std::sin(turn + phi)); };
  geometry::Outline outline{{{{0, 0}, at(1, 0), at(between(random, 0.7, 1), angle)}, {}}, {}};
  outline.outer.edge_names = {"a", "b", "c"};
  if (between(random, 0, 1) < 0.5) outline.holes.push_back(geometry::Circle{at(0.75, angle / 2), 0.06, "hole"});
  auto c = vp::free_plate(outline, between(random, 0.012, 0.03));
  c.discretization.formulation = &kind;
  c.cracks = {{at(0.2, angle * 0.1), at(between(random, 0.4, 0.6), angle * between(random, 0.2, 0.4))},
              {at(0.45, angle * 0.6), at(0.55, angle * 0.75)}};
  return c;
}

/// w = a + b . x with psi = b.
State rigid(const Formulation& plate, double a, const Point& b) {
  return vp::field(plate, [&](const Point& x) { return Eigen::Vector3d(a + b.dot(x), b.y(), -b.x()); });
}

struct Count {
  std::size_t places = 0, refused = 0;
  double furthest = 0;  // from the rigid motion
};

void look(const Formulation& plate, Random& random, Count& count) {
  constexpr std::size_t many = 250;
  const auto [low, high] = geometry::bounding_box(plate.problem().outline);
  const Eigen::Vector3d motion(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
  const State u = rigid(plate, motion[0], motion.tail<2>());
  for (std::size_t i = 0; i < many;) {
    const bool sharp = i % 2 == 0;  // half of the places within four spacings of the sharp corner
    const double reach = 4 * plate.discretization().spacing;
    const Point x = sharp ? Point(between(random, -reach, reach), between(random, -reach, reach))
                          : Point(between(random, low.x(), high.x()), between(random, low.y(), high.y()));
    if (!geometry::contains(plate.problem().outline, x)) continue;
    ++i, ++count.places;
    try {
      const auto found = value_at(plate.interpolation(x), u);
      const Eigen::Vector3d expected(motion[0] + motion.tail<2>().dot(x), motion[2], -motion[1]);
      count.furthest = std::max(count.furthest, (found - expected).cwiseAbs().maxCoeff());
    } catch (const Refused&) {
      ++count.refused;
    }
  }
}

}  // namespace

TEST_CASE("places: of a plate that moves as a rigid body, all do, or are refused, acute corners, wedges, holes") {
  for (const auto* kind : {&ordinary, &galerkin}) {
    Random random(41);
    Count count;
    for (int plates = 0; plates < 80 && count.places < 10000;) {
      const auto c = acute(random, *kind);
      try {
        const auto plate = vp::assembled(c);
        ++plates;
        look(*plate, random, count);
      } catch (const cases::CaseError&) {  // a corner without points: another one
      }
    }
    CAPTURE(kind->name, count.refused);
    CHECK(count.places == 10000);
    CHECK(count.furthest < 1e-13);  // measured: 9e-16 and 4e-16
    CHECK(count.refused < 50);      // measured: 23 of bonds, too far from any point or behind a crack; none of cells
  }
}

TEST_CASE("places: a mass that hits a free plate beside an acute corner loses what the plate gets") {
  for (const double degrees : {20.0, 45.0, 70.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    geometry::Outline outline{{{{0, 0}, {1, 0}, {std::cos(angle), std::sin(angle)}}, {}}, {}};
    outline.outer.edge_names = {"a", "b", "c"};
    auto c = vp::free_plate(outline, 0.04);
    c.section.density = 1, c.loads.clear();
    const double out = 0.05 / std::tan(angle / 2);  // far enough for a point to be near
    c.impact = Impact{{out, 0.01}, 0.01, -1.0, 5.0};
    const auto plate = vp::assembled(c);
    const auto begin = begin_of_motion(*plate, 1);
    Eigen::Vector3d given = Eigen::Vector3d::Zero();  // of a force of 1: its sum and moments
    for (const auto& [dof, factor] : begin.impact->terms)
      given += factor * Eigen::Vector3d(at_dof(rigid(*plate, 1, {0, 0}), dof), at_dof(rigid(*plate, 0, {1, 0}), dof),
                                        at_dof(rigid(*plate, 0, {0, 1}), dof));
    CAPTURE(degrees);
    CHECK((given - Eigen::Vector3d(1, out, 0.01)).norm() < 1e-13);  // measured: 2e-16

    const auto mass = plate->mass();
    const double step = 0.9 * stable_step(stable_time_step(*plate, 1), *plate, c.analysis, begin);
    DynamicOptions options{step, std::size_t(0.4 / step), std::size_t(0.4 / step)};
    options.impact = begin.impact, options.given = begin.given;
    double of_plate = 0, of_mass = 0;
    central_differences(*plate, plate->constraints(), mass, plate->loads(), options, [&](const Instant& now) {
      of_plate = mass.row(0).cwiseProduct(now.velocity().row(0)).sum(),
      of_mass = 0.01 * (now.contact_force->velocity + 1);
    });
    CHECK(of_mass > 1e-3);
    CHECK(of_plate == Approx(-of_mass).epsilon(1e-12));  // measured: 2e-15
  }
}
