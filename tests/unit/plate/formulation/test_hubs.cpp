#include "plate/formulation/hubs.hpp"

#include <random>

#include "cases/input/case_file.hpp"
#include "plate/bonds/family_operator.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace plate;

namespace {

std::unique_ptr<Formulation> with_hub(const std::string& formulation, const std::string& spring) {
  return discretise(case_text::read(case_text::plain, {"discretization.formulation=" + formulation,
                                                       "discretization.spacing=0.1", "geometry.cracks=[]",
                                                       "support=[{ kind = 'clamped', edges = ['left'] }, { kind = "
                                                       "'hub', on = { circle = [0.3, 0.2, 0.25] }" +
                                                           spring + " }]"})
                        .content)
      .plate;
}

}  // namespace

TEST_CASE("hubs: their points move as one rigid disc whose centre is held") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    INFO(formulation);
    const auto plate = with_hub(formulation, ", k_phi = 0");
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    State state = zero_state(plate->points());
    for (auto& one : state.reshaped()) one = normal(generator);
    plate->constraints().impose(state);
    const geometry::Point centre(0.3, 0.2);
    std::optional<Eigen::Vector2d> turn;
    std::size_t members = 0;
    for (std::size_t k = 0; k < plate->cloud().plate_points; ++k) {
      const geometry::Point arm = plate->cloud().positions[k] - centre;
      if (arm.norm() > 0.249) continue;
      const auto i = Eigen::Index(k);
      const Eigen::Vector2d theta = state.col(i).tail<2>();
      if (!turn) turn = theta;
      CHECK((theta - *turn).norm() < 1e-12);
      CHECK(state(0, i) == Approx(arm.y() * theta[0] - arm.x() * theta[1]).margin(1e-12));
      ++members;
    }
    CHECK(members > 6);
    CHECK(turn->norm() > 0.1);
  }
}

TEST_CASE("bodies: bonds end at rims, and what moves as one body has no strain") {
  // the hub moves and turns against nearly no resistance: a rigid motion of all points stores no energy
  const auto plate = discretise(case_text::read(case_text::plain,
                                                {"discretization.formulation=ordinary", "discretization.spacing=0.05",
                                                 "geometry.cracks=[]",
                                                 "support=[{ kind = 'clamped', on = { polygon = [[-0.4, -0.3], [-0.1, "
                                                 "-0.3], [-0.1, 0.2], [-0.4, 0.1]] } }, { kind = 'hub', on = { circle "
                                                 "= [0.23, 0.11, 0.2] }, k_w = 1e-9, k_phi = 1e-9 }]"})
                                    .content)
                         .plate;
  const auto& boundary = plate->boundary();
  const auto& families = *plate->breaking();
  std::size_t within = 0, beyond = 0, held = 0, moved = 0;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) {
    const bool disc = (boundary.cloud.positions[k] - geometry::Point(0.23, 0.11)).norm() < 0.2;
    CHECK((boundary.body_of(k) == 1) == disc);
    held += boundary.body_of(k) == 0, moved += disc;
    for (const auto& bond : families.families()[k]) {
      const bool inside = boundary.is_plate(bond.neighbour);
      ++(inside ? within : beyond);
      CHECK(boundary.body_of(k) == (inside ? boundary.body_of(bond.neighbour) : -1));
    }
  }
  CHECK(held > 40);
  CHECK(moved > 40);
  CHECK(within > 5000);
  CHECK(beyond > 500);
  State state = zero_state(plate->points());
  const auto rigid = [](const geometry::Point& x) -> PointValues {
    return {0.1 + 0.3 * x.x() - 0.2 * x.y(), -0.2, -0.3};
  };
  for (std::size_t k = 0; k < plate->points(); ++k) state.col(Eigen::Index(k)) = rigid(boundary.cloud.positions[k]);
  const State before = state;
  plate->constraints().impose(state);
  std::size_t of_hub = 0;
  for (std::size_t i = 0; i < boundary.fictitious.size(); ++i) {
    if (boundary.sides[std::size_t(boundary.fictitious[i].sides[0])].support != 1) continue;
    const auto k = Eigen::Index(boundary.cloud.plate_points + i);
    CHECK((state.col(k) - before.col(k)).norm() < 1e-12);
    ++of_hub;
  }
  CHECK(of_hub > 40);
}

TEST_CASE("hubs: without a stiffness they do not move, and do so with one") {
  const auto hubs = [](std::optional<double> k_w, std::optional<double> k_phi) {
    Support hub{SupportKind::hub, {}, {}};
    hub.k_w = k_w, hub.k_phi = k_phi;
    return std::vector{hub};
  };
  CHECK_FALSE(hubs_move(hubs({}, {}), PlateLaw::bending));
  CHECK(hubs_move(hubs(1.0, {}), PlateLaw::bending));
  CHECK(hubs_move(hubs({}, 0.0), PlateLaw::bending));
  CHECK(hubs_move(hubs({}, {}), PlateLaw::membrane));
}

TEST_CASE("hubs: those that are free in the plane hold nothing there") {
  for (const bool fixed : {false, true}) {
    const auto content =
        case_text::read(case_text::plain,
                        {"discretization.formulation=galerkin", "discretization.spacing=0.1", "geometry.cracks=[]",
                         "support=[{ kind = 'hub', on = { circle = [0.3, 0.2, 0.25] }" +
                             std::string(fixed ? ", in_plane = 'fixed'" : "") + " }]",
                         "load=[{ kind = 'body_force', vector = [1, 0] }]"})
            .content;
    const auto membrane = discretise(content).membrane;
    CHECK(membrane->pieces().size() == (fixed ? 2 : 1));  // a disc that is held is no part of the plate
    for (const auto& piece : membrane->pieces()) CHECK(piece.free_modes == (fixed ? 0 : 3));
  }
}
