#include "post/report/errors_of_results.hpp"

#include "tests/unit/cases/case_text.hpp"

using post::OtherResults;
using post::Summary;

namespace {

Summary rests(double w, double theta, double force) {
  Summary result;
  result.energy = {{"strain", w}};
  result.extremes = {{"w", {}, -w, 0, {}, {}}, {"von_mises", {}, 100 * w, 0, {}, {}}};
  result.probes = {{"a", "w", {0, 0}, w / 2}, {"a", "theta_x", {0, 0}, theta}, {"a", "Mxx", {0, 0}, 3}};
  result.reactions.emplace();
  result.reactions->supports = {{"left", {}}, {"right", {}}};
  result.reactions->balance.supports = {{force, 0, 4}, {-force, 0, 0}};
  return result;
}

}  // namespace

TEST_CASE("errors of results: a share of the difference, of a group at least the relative one of its worst") {
  auto summary = rests(1, 0.2, 10);
  post::set_errors(summary, {rests(0.9, 0.2, 10.5), 0.5}, {2, 0.01});
  CHECK(summary.extremes[0].error.value() == Approx(0.05));  // of |w|
  CHECK(summary.extremes[1].error.value() == Approx(10));    // the largest stress: twice that
  CHECK(summary.energy_error.value() == Approx(0.05));
  CHECK(summary.probes[0].error.value() == Approx(0.05));  // its own difference is half of that
  CHECK(summary.probes[1].error.value() == Approx(0.01));  // they agree by chance: 5 %, as the others
  CHECK(summary.probes[2].error.value() == 0);             // moments are a group of their own
  REQUIRE(summary.reactions->errors.size() == 2);
  CHECK(summary.reactions->errors[0].force == Approx(0.25));
  CHECK(summary.reactions->errors[1].moment_y == Approx(0.5));  // the same over the size of the plate
}

TEST_CASE("errors of results: reactions have at least what soft edges leave out, and half the share of deflections") {
  const auto force = [](double w, double soft) {
    auto own = rests(1, 0.2, 10);
    post::set_errors(own, {rests(w, 0.2, 10), 1}, {2, 0.01, soft});
    return own.reactions->errors[0].force;
  };
  CHECK(force(1, 0) == 0);  // both agree in all
  CHECK(force(1, 0.03) == Approx(0.3));
  CHECK(force(0.9, 0) == Approx(0.5));  // deflections are 10 % apart
  CHECK(force(0.9, 0.03) == Approx(0.5));
}

TEST_CASE("errors of results: soft edges leave out the more, the farther points are apart, more so than thick") {
  auto content = case_text::read(case_text::plain, {"geometry.cracks=[]"}).content;
  const auto at = [&](double spacing, double thickness) {
    content.discretization.spacing = spacing, content.section.thickness = thickness;
    return post::error_of_soft_edges(content);
  };
  CHECK(at(0.1, 0.1) == 0);  // clamped
  content.supports[0].kind = plate::SupportKind::simply_supported;
  CHECK(at(0.1, 0.1) == Approx(0.015));
  CHECK(at(0.05, 0.1) == Approx(0.0075));
  CHECK(at(0.1, 0.05) == Approx(0.03));
  CHECK(at(0.1, 0.001) == Approx(0.045));
  content.discretization.tip_spacing = 0.001, content.discretization.spacing_growth = 0.05;
  CHECK(at(0.1, 0.1) < 0.005);  // closer points at the edges
  content.supports[0].kind = plate::SupportKind::simply_supported_hard;
  CHECK(at(0.1, 0.1) == 0);
}

TEST_CASE("errors of results: an angle turns by what both stresses may be off, by no more than a right angle") {
  const auto of = [](double s1, double s2, double angle) {
    Summary result;
    result.extremes = {{"w", {}, 1, 0, {}, {}}, {"von_mises", {}, 1, 0, {}, {}}};
    result.probes = {
        {"a", "sigma1_top", {0, 0}, s1}, {"a", "sigma2_top", {0, 0}, s2}, {"a", "angle_top", {0, 0}, angle}};
    return result;
  };
  const auto error = [&](const Summary& one, const Summary& other) {
    auto own = one;
    post::set_errors(own, {other, 1}, {1, 0.01});
    return *own.probes[2].error;
  };
  CHECK(error(of(10, 0, 20), of(10, 0, 20)) == 0);
  CHECK(error(of(10, 0, 89), of(10, 0, -88)) == Approx(3));  // the same axis but for 3 degrees
  CHECK(error(of(10, 0, 20), of(9, 0, 20)) == Approx(std::asin(0.13) / 2 * 57.29578).epsilon(1e-6));
  CHECK(error(of(10, 9, 20), of(8, 9, 70)) == Approx(90));  // nearly the same in all directions
}

TEST_CASE("errors of results: what is stated near a singular place follows the same place of the other run") {
  auto own = rests(1, 0.2, 10), other = own;
  own.stress_near = {{"tip 0", {0, 0}, 0.1, 50}, {"tip 1", {1, 0}, 0.1, 40}, {"corner", {2, 0}, 0.1, 7}};
  other.stress_near = {{"tip 1", {1, 0}, 0.1, 37}, {"tip 0", {0, 0}, 0.1, 52}};
  post::set_errors(own, {other, 0.5}, {2, 0.01});
  CHECK(own.stress_near[0].error.value() == Approx(2));  // twice half the difference, as of the largest stress
  CHECK(own.stress_near[1].error.value() == Approx(3));
  CHECK(!own.stress_near[2].error);
}

TEST_CASE("errors of results: corners have the relative error of the worst of them") {
  auto own = rests(1, 0.2, 10), other = own;
  own.stress_near = {{"corner", {0, 0}, 0.1, 50}, {"tip 0", {1, 0}, 0.1, 40}, {"corner", {2, 0}, 0.1, 10}};
  other.stress_near = {{"corner", {0, 0}, 0.1, 50}, {"tip 0", {1, 0}, 0.1, 40}, {"corner", {2, 0}, 0.1, 9}};
  post::set_errors(own, {other, 0.5}, {2, 0.01});
  CHECK(own.stress_near[0].error.value() == Approx(5));
  CHECK(own.stress_near[1].error.value() == 0);
  CHECK(own.stress_near[2].error.value() == Approx(1));
}

TEST_CASE("errors of results: a frequency has at least the relative error of the modes below, no mode has none") {
  Summary summary, other;
  summary.frequencies = {{1, 10, 0, 0}, {2, 20, 0, 0}, {3, 30, 0, 0}};
  other.frequencies = {{1, 9, 0, 0}, {2, 20, 0, 0}};
  post::set_errors(summary, {other, 1}, {1, 0.01});
  CHECK(summary.frequencies[0].error.value() == Approx(1));
  CHECK(summary.frequencies[1].error.value() == Approx(2));
  CHECK(!summary.frequencies[2].error);
}

TEST_CASE("errors of results: what the other run does not have stays without an error") {
  auto summary = rests(1, 0.2, 10);
  auto other = rests(1, 0.2, 10);
  other.reactions->supports[1].name = "top", other.extremes.pop_back(), other.probes.clear();
  post::set_errors(summary, {other, 1}, {2, 0.01});
  CHECK(summary.reactions->errors.empty());
  CHECK(!summary.extremes[1].error);
  CHECK(!summary.probes[0].error);
  CHECK(summary.extremes[0].error == 0);
}

TEST_CASE("errors of results: rounding at a probe that does not turn is no error of the plate") {
  auto summary = rests(1, 1e-17, 10);
  post::set_errors(summary, {rests(0.999, -3e-16, 10), 1}, {2, 0.01});
  CHECK(summary.extremes[0].error.value() == Approx(0.001));
  CHECK(summary.probes[1].error.value() < 1e-4);
}
