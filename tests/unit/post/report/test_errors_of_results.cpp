#include "post/report/errors_of_results.hpp"

#include "tests/catch.hpp"

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
