// Amplitudes and phases of a response over frequencies.
#include "post/report/response.hpp"

#include "post/files/recorder.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

Srif of(std::size_t tip, double K1, double K2, double K3, SrifMethod method = SrifMethod::domain_integral) {
  Srif srif;
  srif.tip = tip, srif.K1 = K1, srif.K2 = K2, srif.K3 = K3, srif.method = method;
  srif.errors = {0.3, 0.4, 0.1};
  return srif;
}

}  // namespace

TEST_CASE("responses: amplitudes and errors of the recommended method of each tip") {
  const std::vector<Srif> real{of(0, 3, -1, 0), of(0, 99, 99, 99, SrifMethod::series_fit), of(1, 0, 8, 2)},
      imaginary{of(0, -4, 0.2, 0), of(0, 99, 99, 99, SrifMethod::series_fit), of(1, 5, -6, 0)};
  const auto all = responses_of(7, real, imaginary);
  REQUIRE(all.size() == 6);
  CHECK(all[0].place == "tip 0");
  CHECK(all[0].quantity == "K1");
  CHECK(std::abs(all[0].value) == 5);
  CHECK(*all[0].error == Approx(0.3 * std::sqrt(2.0)));
  CHECK(all[0].resolved);
  CHECK_FALSE(all[2].resolved);  // K3 is zero
  CHECK(all[4].place == "tip 1");
  CHECK(std::abs(all[4].value) == 10);
}

TEST_CASE("responses: what is not resolved counts as error, and hides an amplitude that is no larger") {
  auto real = of(0, 3, 1, 0.2), imaginary = of(0, 4, 0.5, 0.3);
  imaginary.resolved = {false, true, true};
  auto all = responses_of(1, {real}, {imaginary});
  CHECK(all[0].value == std::complex(3.0, 4.0));
  CHECK(*all[0].error == Approx(std::hypot(0.3, 4.0)));
  CHECK(all[0].resolved);
  imaginary.errors[0] = 6;
  CHECK_FALSE(responses_of(1, {real}, {imaginary})[0].resolved);
  real.errors[1].reset();
  all = responses_of(1, {real}, {imaginary});
  CHECK_FALSE(all[1].error);
  CHECK(all[1].resolved);
}

TEST_CASE("responses: a table of amplitudes and phases ahead of the load, and the largest of every quantity") {
  Probe probe{"top", {0, 0}, {{2, 0.25}, {3, 0.75}}};
  plate::State a = plate::State::Zero(3, 4), b = a;
  a(0, 2) = 4, a(0, 3) = 4, b(0, 2) = -4, b(0, 3) = -4, a(1, 3) = -2;
  auto all = responses_of(2, probe, a, b, 0, 0.1);
  REQUIRE(all.size() == 3);
  CHECK(all[0].value == std::complex(4.0, -4.0));
  CHECK(all[1].value == std::complex(-1.5, 0.0));
  CHECK_FALSE(responses_of(2, probe, a, b, 0.01, 0.1)[0].error);
  CHECK(responses_of(2, probe, a, b, 0.01, 0.1)[0].resolved);
  CHECK_FALSE(responses_of(2, probe, a, b, 0.01, 0.1)[2].resolved);
  const auto rows = functionals(probe, 4, 0.1);
  const Eigen::Vector3d seen = rows * Eigen::Map<const Eigen::VectorXd>(a.data(), a.size());
  CHECK((seen - Eigen::Vector3d(4, -0.15, 0)).norm() < 1e-15);
  for (auto& one : responses_of(3, probe, 2 * a, b, 0, 0.1)) all.push_back(one);
  auto lost = all[0];
  lost.frequency = 4, lost.value *= 100, lost.resolved = false;
  all.push_back(lost);
  const auto table = response_table(all);
  CHECK(table.columns ==
        std::vector<std::string>{"frequency", "place", "quantity", "amplitude", "phase", "estimated_error"});
  REQUIRE(table.rows.size() == 7);
  CHECK(std::get<double>(table.rows[0][3]) == Approx(4 * std::sqrt(2.0)));
  CHECK(std::get<double>(table.rows[0][4]) == Approx(-45));
  CHECK(std::get<double>(table.rows[1][4]) == Approx(180));
  CHECK(std::holds_alternative<std::monostate>(table.rows[6][3]));
  const auto peaks = largest_responses(all, 0.1);
  REQUIRE(peaks.size() == 2);  // theta_y does not move
  CHECK(peaks[0].quantity == "w");
  CHECK(peaks[0].frequency == 3);
  CHECK(peaks[0].amplitude == Approx(std::hypot(8, 4)));
  CHECK(peaks[1].quantity == "theta_x");
  CHECK_THAT(printed_responses(peaks, true), Catch::Contains("top w") && Catch::Contains(" m at the frequency 3"));
  CHECK(printed_responses({}, true).empty());
}
