#include "post/report/conclusion.hpp"

#include <numbers>

#include "plate/model/section.hpp"
#include "tests/catch.hpp"

namespace {

post::Srif peak(std::size_t tip, post::SrifMethod method, double K1, double K2, bool resolves = true) {
  post::Srif srif;
  srif.tip = tip, srif.method = method, srif.K1 = K1, srif.K2 = K2, srif.resolved = {true, resolves, false};
  return srif;
}

}  // namespace

TEST_CASE("peaks: of each tip by its recommended method, with sign and time, what is not resolved left out") {
  const std::vector<std::vector<post::Srif>> rows{
      {peak(0, post::SrifMethod::domain_integral, 1, 0), peak(0, post::SrifMethod::series_fit, 99, 99),
       peak(1, post::SrifMethod::domain_integral, -1, 2)},
      {peak(0, post::SrifMethod::domain_integral, -3, 0), peak(0, post::SrifMethod::series_fit, 99, 99),
       peak(1, post::SrifMethod::domain_integral, 0.5, 2.5, false)},
      {peak(0, post::SrifMethod::domain_integral, 2, 0), peak(1, post::SrifMethod::domain_integral, 0.5, -3)},
  };
  const plate::Section section{1, 0.3, 0.5, 5.0 / 6, 0};
  const auto found = post::peaks({0, 0.5, 1}, rows, section, std::nullopt);
  const auto check = [&](std::size_t i, const std::string& name, std::optional<std::size_t> tip, double value,
                         double time) {
    CHECK(found.at(i).quantity == name);
    CHECK(found[i].tip == tip);
    CHECK(found[i].value == value);
    CHECK(found[i].time == time);
  };
  REQUIRE(found.size() == 4);
  check(0, "K1", 0, -3, 0.5);
  check(1, "K2", 0, 0, 0);
  check(2, "K1", 1, -1, 0);
  check(3, "K2", 1, -3, 1);
  const auto used = post::peaks({0, 0.5, 1}, rows, section, 10.0);
  REQUIRE(used.size() == 6);
  CHECK(used[2].quantity == "utilisation");
  CHECK(used[2].time == 0.5);
  CHECK(used[2].value == Approx(std::sqrt(std::numbers::pi) * 6 / 0.25 * 3 / 10));
  CHECK(used[5].time == 1);  // of K1 and K2 together
  CHECK(post::peaks({}, {}, section, 10.0).empty());
}

TEST_CASE("peaks: none of a factor that may be larger where it is not resolved") {
  const plate::Section section{1, 0.3, 0.5, 5.0 / 6, 0};
  auto lost = peak(0, post::SrifMethod::domain_integral, 0.5, 2, false);
  const auto names = [&](double error) {
    lost.errors[1] = error;
    std::vector<std::string> result;
    for (const auto& peak :
         post::peaks({0, 1}, {{peak(0, post::SrifMethod::domain_integral, 1, 3)}, {lost}}, section, std::nullopt))
      result.push_back(peak.quantity);
    return result;
  };
  CHECK(names(0.9) == std::vector<std::string>{"K1", "K2"});
  CHECK(names(1.1) == std::vector<std::string>{"K1"});
}
