#include "plate/bonds/results.hpp"
#include "post/files/frame.hpp"
#include "tests/catch.hpp"
#include "tests/unit/fracture/breakage/damaged_plate.hpp"

using namespace fracture;
namespace vp = verified_plate;

TEST_CASE(
    "severed frame: damage is the share of weight that broke, pieces that move apart as rigid bodies bear nothing") {
  broken_plate::Plate plate({});
  plate.break_across(0.4);
  const auto apart = vp::field(*plate.whole, [](const geometry::Point& x) {
    return x.x() < 0.4 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(3 - 2 * x.x() + x.y(), 1, 2);
  });
  post::Frame frame;
  const auto mesh = plate.damaged.draw(frame, apart, *plate.whole, plate.whole->paths());
  const auto points = plate.whole->cloud().plate_points;
  REQUIRE(frame.damage.size() == points);
  CHECK(mesh.positions.size() == points);
  CHECK(frame.resultants.moments.cwiseAbs().maxCoeff() < 1e-11);  // measured: 1e-14
  CHECK(frame.resultants.shear.cwiseAbs().maxCoeff() < 1e-9);
  const auto& d = plate.content.discretization;
  for (std::uint32_t k = 0; k < points; ++k) {
    const auto& x = plate.whole->cloud().positions[k];
    double whole = 0, broken = 0;
    for (const auto& bond : plate.whole->families()[k]) {
      const auto& y = plate.whole->cloud().positions[bond.neighbour];
      const double weight = plate.whole->breaking()->shapes()[bond.vector_id].weight;
      whole += weight;
      if ((x.x() < 0.4) != (y.x() < 0.4)) broken += weight;
    }
    CHECK(frame.damage[k] == Approx(broken / whole).margin(1e-14));
    CHECK((frame.damage[k] > 0) == (std::abs(x.x() - 0.4) < d.horizon()));
  }
  CHECK_FALSE(frame.cracks);  // those are the growth's
}
