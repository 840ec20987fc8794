#include "plate/solve/crack_contact.hpp"

#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/large_deflections.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace plate;

namespace {

/// Plates with cracks that end inside, at an edge, at each other, that bend, and that cross.
Discretised cracked(const std::string& cracks, const std::string& formulation = "galerkin") {
  std::vector<std::string> settings{"geometry.cracks=" + cracks, "cracks.contact=true", "discretization.spacing=0.1",
                                    "discretization.formulation=" + formulation};
  if (formulation == "galerkin") settings.emplace_back("discretization.refine_tips=false");
  return discretise(case_text::read(case_text::plain, settings).content);
}

/// Free displacements that open and close cracks somehow.
State waves(const Formulation& plate, double phase) {
  State result = zero_state(plate.points());
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const auto& x = plate.cloud().positions[std::size_t(k)];
    result.col(k) << 0, std::sin(9 * x.x() + phase + double(k)), std::cos(7 * x.y() + phase - double(k));
  }
  return result;
}

}  // namespace

TEST_CASE("contact of crack faces: openings and forces are complementary, and forces balance the change") {
  const auto cracks =
      GENERATE(as<std::string>(), "[[[-0.31,0.02],[0.33,0.1]]]", "[[[-1.0,0.1],[0.2,0.15]]]",
               "[[[-0.4,-0.3],[0.0,0.05],[0.4,0.3]]]", "[[[-0.5,0.0],[0.5,0.0]],[[0.0,-0.5],[0.0,0.5]]]",
               "[[[-0.5,0.0],[0.5,0.0]],[[0.0,0.0],[0.2,0.5]]]");
  const std::string formulation = GENERATE("galerkin", "ordinary");
  INFO(cracks << ", " << formulation);
  const auto plates = cracked(cracks, formulation);
  const auto &plate = *plates.plate, &membrane = *plates.membrane;
  const State bending = waves(plate, 0.3), plane = waves(membrane, 1.1);
  const auto pairs = plate.face_pairs();
  REQUIRE(pairs.size() > 2);
  const auto found = touching_faces(plate, membrane, {bending, plane});
  REQUIRE(found.faces.size() == pairs.size());
  const State bent = bending + found.bending, flat = plane + found.membrane;
  const double arm = plate.section().thickness / 2;
  Forces on_bending, on_plane;
  plate.internal_force(found.bending, on_bending), membrane.internal_force(found.membrane, on_plane);
  std::size_t pressed = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& face = found.faces[i];
    CHECK(face.opening_top == Approx(pairs[i].opening(flat) + arm * pairs[i].opening(bent)).margin(1e-9));
    CHECK(face.opening_bottom == Approx(pairs[i].opening(flat) - arm * pairs[i].opening(bent)).margin(1e-9));
    for (const auto& [opening, force] :
         {std::pair(face.opening_top, face.force_top), std::pair(face.opening_bottom, face.force_bottom)}) {
      CHECK(opening >= -1e-9);
      CHECK(force >= 0);
      CHECK(opening * force == 0);
      pressed += force > 0;
    }
  }
  CHECK(pressed > 0);
  CHECK(pressed < 2 * pairs.size());
  // the forces of the change are those of contact, on the faces alone
  double length = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& pair = pairs[i];
    const auto& face = found.faces[i];
    pair.press((face.force_top + face.force_bottom) * pair.length, on_plane);
    pair.press((face.force_top - face.force_bottom) * arm * pair.length, on_bending);
    length += pair.length;
  }
  const double largest = found.largest_force() * 0.1;
  pinned(membrane).fold(on_plane), plate.constraints().fold(on_bending);
  CHECK(on_plane.cwiseAbs().maxCoeff() < 1e-9 * largest);
  CHECK(on_bending.cwiseAbs().maxCoeff() < 1e-9 * largest * arm);
  double cracks_length = 0;  // without half a spacing at every tip
  for (const auto& path : plate.paths()) cracks_length += geometry::length(path.vertices);
  CHECK(length < cracks_length + 1e-9);
  CHECK(length > cracks_length - 0.5 * 0.12 * double(plate.tips().size()) - 1e-9);
}

TEST_CASE("contact of crack faces: nothing is pressed where all is open, or where there is no crack") {
  const auto plates = cracked("[[[-0.31,0.02],[0.33,0.1]]]");
  State open = zero_state(plates.plate->points());
  for (const auto& pair : plates.plate->face_pairs()) {
    const auto left = pair.left.front().point, right = pair.right.front().point;
    open(2, left) = pair.normal.x(), open(1, left) = -pair.normal.y();
    open(2, right) = -pair.normal.x(), open(1, right) = pair.normal.y();
  }
  const auto found = touching_faces(*plates.plate, *plates.membrane, {zero_like(open), open});
  CHECK(found.largest_force() == 0);
  CHECK(found.closed_share() == 0);
  CHECK(found.least_opening() == Approx(2));
  CHECK(found.bending.norm() == 0);
}

TEST_CASE("contact of crack faces: with large deflections the state itself is complementary and in balance") {
  const auto cracks =
      GENERATE(as<std::string>(), "[[[-0.31,0.02],[0.33,0.1]]]", "[[[-0.5,0.0],[0.5,0.0]],[[0.0,0.0],[0.2,0.5]]]");
  const double traction = GENERATE(0.0, -0.02);
  INFO(cracks << ", traction " << traction);
  const auto plates =
      discretise(case_text::read(case_text::plain,
                                 {"geometry.cracks=" + cracks, "cracks.contact=true", "discretization.spacing=0.1",
                                  "discretization.refine_tips=false", "discretization.formulation=galerkin"})
                     .content);
  const auto &plate = *plates.plate, &membrane = *plates.membrane;
  PlateLoads loads{plate.total_load(), zero_forces(plate.points())};
  const double size = 0.05 * plate.section().thickness /
                      AssembledPlate(plate, plate.constraints(), plate.stiffness())
                          .solve({loads.across})
                          .front()
                          .row(0)
                          .cwiseAbs()
                          .maxCoeff();
  loads.across *= size;
  for (Eigen::Index k = 0; k < loads.in_plane.cols(); ++k) {  // pressed together along y, in balance
    const double y = plate.cloud().positions[std::size_t(k)].y();
    loads.in_plane(1, k) = -traction * size * y;
  }
  const auto found = StretchedPlate(plate, membrane).equilibrium(loads, {1e-9, {}});
  REQUIRE(found.converged);
  const auto pairs = plate.face_pairs();
  REQUIRE(found.touching.faces.size() == pairs.size());
  const double arm = plate.section().thickness / 2, motion = found.membrane.cwiseAbs().maxCoeff();
  Forces on_plane;
  membrane.internal_force(found.membrane, on_plane);
  on_plane += found.stretch.forces + loads.in_plane;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& face = found.touching.faces[i];
    const double middle = pairs[i].opening(found.membrane), slope = arm * pairs[i].opening(found.bending);
    CHECK(std::abs(face.opening_top - middle - slope) < 1e-7 * motion);
    CHECK(std::abs(face.opening_bottom - middle + slope) < 1e-7 * motion);
    CHECK(std::min(face.opening_top, face.opening_bottom) > -1e-7 * motion);
    CHECK(std::min(face.force_top, face.force_bottom) >= 0);
    CHECK(face.opening_top * face.force_top == 0);
    CHECK(face.opening_bottom * face.force_bottom == 0);
    pairs[i].press((face.force_top + face.force_bottom) * pairs[i].length, on_plane);
  }
  CHECK(found.touching.largest_force() > 0);
  pinned(membrane).fold(on_plane);
  CHECK(on_plane.cwiseAbs().maxCoeff() < 1e-8 * found.touching.largest_force() * 0.1);
}
