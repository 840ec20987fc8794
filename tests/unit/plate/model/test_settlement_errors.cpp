#include "plate/model/support_validation.hpp"

#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

Load moved(std::size_t support, double value, const geometry::Point& slope = {0, 0}, double rotation = 0) {
  return {Settlement{.support = support, .value = value, .slope = slope, .rotation = rotation}};
}

std::string error(const std::vector<Support>& supports, const std::vector<Load>& loads) {
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 1, 1);
  problem.supports = supports, problem.loads = loads;
  const auto found = errors_in_settlements(problem);
  return found.empty() ? "" : found.front().what;
}

}  // namespace

TEST_CASE("settlements move what a support holds") {
  using Catch::Contains;
  using enum SupportKind;
  const Support left{clamped, {"left"}, {}}, right{simply_supported, {"right"}, {}}, mirror{symmetry, {"left"}, {}};
  CHECK(error({left}, {moved(0, 1, {1, 2}, 3)}).empty());
  CHECK_THAT(error({}, {moved(0, 1)}), Contains("there is no `support`"));
  CHECK_THAT(error({left, right}, {moved(2, 1)}), Contains("2 given, there are the supports 0 to 1"));
  CHECK_THAT(error({right}, {moved(0, 1, {0, 0}, 1)}), Contains("a rotation of them does nothing"));
  CHECK_THAT(error({mirror}, {moved(0, 1)}), Contains("mirror plane"));
  CHECK(error({mirror}, {moved(0, 0, {0, 0}, 1)}).empty());
  CHECK_THAT(error({{free, {"left"}, {}}}, {moved(0, 1)}), Contains("holds nothing"));
  CHECK_THAT(error({{clamped, {}, {{0.5, 0.5}}}}, {moved(0, 1, {0, 0}, 1)}), Contains("give a slope"));
}

TEST_CASE("settlements do not tear the plate where two supports meet") {
  using Catch::Contains;
  using enum SupportKind;
  const Support left{clamped, {"left"}, {}}, bottom{simply_supported, {"bottom"}, {}};
  CHECK_THAT(error({left, bottom}, {moved(0, 1)}), Contains("[0, 0], which would be torn"));
  CHECK(error({left, bottom}, {moved(0, 1), moved(1, 1)}).empty());
  CHECK(error({left, bottom}, {moved(1, 0, {1, 0})}).empty());  // it turns about the corner
  CHECK_THAT(error({left, bottom}, {moved(1, 0, {1, 0}), moved(0, 0, {0, 1})}), !Contains("torn"));
  CHECK_THAT(error({left, {clamped, {"bottom"}, {}}}, {moved(1, 0, {1, 0})}), Contains("torn"));
  CHECK_THAT(error({{clamped, {"left", "bottom"}, {}}}, {moved(0, 0, {0, 0}, 1)}), Contains("another edge of it"));
  CHECK(error({{clamped, {"left", "bottom"}, {}}}, {moved(0, 1, {2, 3})}).empty());
  CHECK_THAT(error({left, {pinned, {}, {}, {{0, 0.5}, {0.7, 0.5}}}}, {moved(1, 1)}), Contains("[0, 0.5]"));
  auto late = moved(1, 1);
  late.history.kind = History::Kind::ramp, late.history.rise_time = 1;
  CHECK_THAT(error({left, bottom}, {moved(0, 1), late}), Contains("torn"));
}

TEST_CASE("settlements do not tear the plate where lines and parts cross, nor at a round hole") {
  using Catch::Contains;
  using enum SupportKind;
  Support across{pinned, {}, {}}, down{pinned, {}, {}}, part{clamped, {}, {}}, pin{pinned, {}, {{0.7, 0.5}}};
  across.along = {{0.1, 0.4}, {0.9, 0.4}}, down.along = {{0.3, 0.1}, {0.3, 0.9}};
  part.patch = geometry::Circle{{0.5, 0.4}, 0.1, ""};
  CHECK_THAT(error({across, down}, {moved(0, 1)}),
             Contains("`support 0` and `support 1` hold the plate at [0.3, 0.4]"));
  CHECK(error({across, down}, {moved(0, 1), moved(1, 1)}).empty());
  CHECK_THAT(error({across, part}, {moved(0, 1)}), Contains("torn"));
  CHECK(error({across, part}, {moved(0, 1), moved(1, 1)}).empty());
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 1, 1);
  problem.outline.holes = {geometry::Circle{{0.5, 0.5}, 0.2, "hole0"}};
  problem.supports = {{simply_supported, {"hole0"}, {}}, pin}, problem.loads = {moved(0, 1)};
  CHECK(errors_in_settlements(problem).size() == 1);
  problem.loads.push_back(moved(1, 1));
  CHECK(errors_in_settlements(problem).empty());
}

TEST_CASE("settlements that tear are found whatever their size") {
  using enum SupportKind;
  const Support left{clamped, {"left"}, {}}, bottom{clamped, {"bottom"}, {}};
  for (const double size : {1e-12, 1.0, 1e9}) {
    CHECK_FALSE(error({left, bottom}, {moved(0, 0, {size, 0})}).empty());
    CHECK_FALSE(error({left, bottom}, {moved(0, size)}).empty());
    CHECK(error({left, bottom}, {moved(0, size, {size, 2 * size}), moved(1, size, {size, 2 * size})}).empty());
  }
}
