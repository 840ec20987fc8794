#include "plate/formulation/crack_springs.hpp"

#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace plate;

namespace {

std::unique_ptr<Formulation> with_springs(const std::string& formulation, const std::string& keys) {
  return discretise(case_text::read(case_text::plain,
                                    {"discretization.formulation=" + formulation, "discretization.spacing=0.1",
                                     "geometry.cracks=[[[-0.4, 0.1], [0.4, 0.1]], [[-0.3, -0.5], [0.3, -0.5]]]",
                                     "spring=[{ cracks = [1], " + keys + " }]"})
                        .content)
      .plate;
}

}  // namespace

TEST_CASE("springs on cracks: on their crack alone, no force under rigid motions, what they carry is their energy") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    INFO(formulation);
    const auto plate = with_springs(formulation, "deflection = 3, rotation_normal = 2, rotation_tangential = 0.5");
    const auto springs = crack_springs(plate->problem(), 0, plate->face_pairs());
    REQUIRE(!springs.empty());
    State state = zero_state(plate->points()), rigid = state;
    for (Eigen::Index k = 0; k < state.cols(); ++k) {
      const auto& x = plate->cloud().positions[std::size_t(k)];
      state.col(k) << std::sin(3 * x.x() + double(k)), std::cos(5 * x.y() - double(k)), std::sin(double(k));
      rigid.col(k) << 1, 0, 0;
    }
    double energy = 0;
    for (const auto& one : springs) {
      CHECK(std::abs(one.pair.position.y() + 0.5) < 1e-9);
      CHECK((one.pair.normal - geometry::Point(0, 1)).norm() < 1e-9);  // to the left of the way along x
      const auto carried = one.carried(state, no_state());
      const double sliding = carried.twist / 0.5;
      energy += one.pair.length / 2 *
                (carried.shear * carried.deflection + carried.moment * carried.rotation + carried.twist * sliding);
    }
    const auto& supports = plate->boundary().elastic_supports;
    CHECK(supports.energy(state) == Approx(energy));
    CHECK(supports.energy(rigid) == Approx(0).margin(1e-12));
    CHECK(supports.holding().empty());
  }
}

TEST_CASE("springs on cracks: a depth makes them of the crack's line spring and couples the plate to its plane") {
  const auto plate = with_springs("galerkin", "depth = 0.04");
  CHECK(plate->problem().coupled());
  for (const auto& one : crack_springs(plate->problem(), 0, plate->face_pairs())) {
    REQUIRE(one.part);
    CHECK(one.opening == one.part->stiffness());
    CHECK(part_through_at(plate->problem(), one.pair.position));
  }
  CHECK(!part_through_at(plate->problem(), {0, 0.1}));
}
