#include "cases/driver/neighbouring_cracks.hpp"

#include "plate/formulation/discretised.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/table.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("neighbouring cracks: their energies give the factor that an integral gives") {
  const auto c = read(plain + "[srif]\nmethods = [\"domain_integral\"]\n", {"discretization.spacing=0.05"}).content;
  const auto table = cases::energy_check(c, c.analysis);
  const auto plate = plate::discretise(c).plate;
  const auto state = plate::static_solution(*plate, c.analysis, {1e-8, 10000, {}}).solution.state;
  const auto factors = post::srifs(*plate, *c.srif, post::tip_methods(*plate, *c.srif), state);
  REQUIRE(table.rows.size() == 2);
  for (std::size_t tip = 0; tip < 2; ++tip) {
    const double K = std::get<double>(table.rows[tip][table.column("K")]);
    CHECK(K == Approx(std::abs(factors[tip].K1)).epsilon(0.2));  // six spacings are half a crack
  }
}

TEST_CASE("neighbouring cracks: one that is too short to be shortened is refused") {
  const auto c = read(plain, {"geometry.cracks=[[[-0.05,0],[0.05,0]]]"}).content;
  CHECK_THROWS_AS(cases::energy_check(c, c.analysis), plate::Refused);
}

TEST_CASE("neighbouring cracks: their energies in the plane give N where loads act there") {
  const auto c =
      read(plain + "[srif]\nmethods = [\"domain_integral\"]\n",
           {"discretization.spacing=0.05", "support[0].in_plane=\"fixed\"", "geometry.cracks=[[[0.0,-0.3],[0.0,0.3]]]",
            "load=[{kind='edge_traction',edges=['right'],value=1}]"})
          .content;
  const auto table = cases::energy_check(c, c.analysis);
  const auto membrane = plate::discretise(c).membrane;
  const auto state = plate::static_solution(*membrane, c.analysis, {1e-8, 10000, {}}).solution.state;
  const auto factors = post::srifs(*membrane, *c.srif, post::tip_methods(*membrane, *c.srif), state);
  REQUIRE(table.rows.size() == 2);
  for (std::size_t tip = 0; tip < 2; ++tip) {
    CHECK(std::get<double>(table.rows[tip][table.column("K")]) == 0);
    const double N = std::get<double>(table.rows[tip][table.column("N")]);
    CHECK(N == Approx(std::hypot(factors[tip].K1, factors[tip].K2)).epsilon(0.2));
  }
}
