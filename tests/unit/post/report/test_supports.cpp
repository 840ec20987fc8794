#include "post/report/reactions.hpp"

#include <fmt/format.h>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/statics.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::vector<std::string> at_rest{
    "support=[{kind=\"clamped\",edges=[\"left\"]},{kind=\"pinned\",points=[[0.9,0.1]]}]", "analysis.method=direct",
    "discretization.spacing=0.1"};

}  // namespace

TEST_CASE("supports: elastic forces as functionals of the state are what the balance has of them") {
  for (const std::string formulation : {"ordinary", "galerkin"}) {
    CAPTURE(formulation);
    auto settings = at_rest;
    settings.push_back("discretization.formulation=" + formulation);
    const auto content = read(plain, settings).content;
    const auto plate = plate::discretise(content).plate;
    const auto state = plate::static_solution(*plate, content.analysis, {1e-10, 1000, {}}).solution.state;
    plate::Forces internal;
    plate->internal_force(state, internal);
    const post::Supports supports(plate->boundary());
    const auto balance = supports.balance(plate->constraints().on_held(internal), supports.nothing(), nullptr, state);
    const Eigen::VectorXd found = supports.elastic_forces(*plate) * state.reshaped<Eigen::RowMajor>();
    REQUIRE(found.size() == 2);
    for (Eigen::Index i = 0; i < found.size(); ++i)
      CHECK(found[i] == Approx(-balance.supports[std::size_t(i)].force).epsilon(1e-9));
    CHECK(std::abs(found[1]) > 0.1);  // of a load of 4
  }
}

TEST_CASE("supports: more than sixteen are taken together") {
  std::string pins = "[0,-0.65]";
  for (int i = 0; i < 17; ++i) pins += fmt::format(",[{},0.35]", -0.8 + 0.1 * i);
  const auto content =
      read(plain, {"support=[{kind=\"pinned\",points=[" + pins + "]}]", "discretization.spacing=0.1"}).content;
  const auto plate = plate::discretise(content).plate;
  const post::Supports supports(plate->boundary());
  const Eigen::MatrixXd together = supports.elastic_forces(*plate);
  CHECK(together.rows() == 1);
  plate::State rigid = plate::State::Zero(3, Eigen::Index(plate->points()));
  rigid.row(0).setOnes();
  CHECK(std::abs((together * rigid.reshaped<Eigen::RowMajor>()).value()) < 1e-9 * together.norm());
}
