#include "plate/formulation/hubs.hpp"

#include <random>

#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"
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

TEST_CASE("hubs: of bonds they have points about their circle, but none beyond a crack") {
  const auto cloud = geometry::lattice(geometry::rectangle(0, 0, 2, 2), 0.1);
  Support hub{SupportKind::hub, {}, {}};
  hub.patch = geometry::Circle{{1, 1}, 0.4, ""};
  const auto members = [&](double horizon, double crack_at) {
    const std::vector<geometry::CrackPath> paths{
        {{{crack_at, 0.5}, {crack_at, 1.5}}, geometry::End::tip, geometry::End::tip}};
    return hubs_of({hub}, cloud, horizon, paths).front().points;
  };
  const auto nearer = [&](double radius, double x) {
    std::size_t count = 0;
    for (const auto& at : cloud.positions) count += (at - geometry::Point(1, 1)).norm() < radius && at.x() < x;
    return count;
  };
  CHECK(members(0, 1.9).size() == nearer(0.4, 2));
  CHECK(members(0.3, 1.9).size() == nearer(0.4645, 2));
  CHECK(nearer(0.4645, 1.42) < nearer(0.4645, 2));
  CHECK(members(0.3, 1.42).size() == nearer(0.4645, 1.42));
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
