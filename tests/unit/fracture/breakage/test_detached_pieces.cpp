#include "fracture/breakage/detached_pieces.hpp"

#include "plate/bonds/rows/lattice_operator.hpp"
#include "tests/catch.hpp"
#include "tests/unit/fracture/breakage/damaged_plate.hpp"

using namespace fracture;
namespace vp = verified_plate;

namespace {

/// Counts how often it is asked.
struct Nothing : plate::Changes {
  void before_force(const plate::Step&) override { ++before; }
  void after_force(const plate::Step&, const plate::Forces&) override { ++after; }
  int before = 0, after = 0;
};

}  // namespace

TEST_CASE("fallen pieces: what is cut off stays from the step after it was seen, the rest moves on") {
  broken_plate::Plate plate({vp::held(plate::SupportKind::clamped, {"left"})});
  plate.break_across(0.4);
  Nothing nothing;
  const plate::Forces mass = plate.whole->mass();
  DetachedPieces pieces(nothing, plate.damaged, plate.whole->boundary(), mass);
  std::vector<plate::State> states, velocities;
  for (const std::size_t step : {49, 50, 51, 52}) {
    auto state = vp::random_state(*plate.whole, unsigned(step)),
         velocity = vp::random_state(*plate.whole, unsigned(100 + step));
    states.push_back(state), velocities.push_back(velocity);
    pieces.before_force({step, 0.1 * double(step), 0.1, state, velocity});
    pieces.after_force({step, 0.1 * double(step), 0.1, state, velocity}, mass);
    for (std::uint32_t k = 0; k < plate.whole->cloud().plate_points; ++k) {
      const bool frozen = step > 50 && plate.whole->cloud().positions[k].x() > 0.4;
      CAPTURE(step, k);
      CHECK(state.col(k) == (frozen ? states[1].col(k) : states.back().col(k)));
      CHECK(velocity.col(k) == (frozen ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(velocities.back().col(k))));
    }
    if (step < 51) CHECK(pieces.energy() == 0);
  }
  double energy = 0;  // of the velocities before and after the step from which on it stays
  for (std::uint32_t k = 0; k < plate.whole->cloud().plate_points; ++k)
    if (plate.whole->cloud().positions[k].x() > 0.4)
      for (int c = 0; c < 3; ++c) energy += mass(c, k) * velocities[1](c, k) * velocities[2](c, k) / 2;
  CHECK(pieces.energy() == Approx(energy));
  CHECK(nothing.before == 4);
  CHECK(nothing.after == 4);
}

TEST_CASE("fallen pieces: a plate that is whole, or only cracked, moves") {
  broken_plate::Plate plate({vp::held(plate::SupportKind::clamped, {"left"})});
  plate.break_across(0.4, 0.5);  // up to y = 0.5
  Nothing nothing;
  DetachedPieces pieces(nothing, plate.damaged, plate.whole->boundary(), plate.whole->mass());
  for (const std::size_t step : {0, 50, 51}) {
    auto state = vp::random_state(*plate.whole, 1), velocity = vp::random_state(*plate.whole, 2);
    const auto before = state;
    pieces.before_force({step, 0, 0.1, state, velocity});
    CHECK(state == before);
  }
  CHECK(pieces.energy() == 0);
}
