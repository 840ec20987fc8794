#include "plate/model/space.hpp"

#include <cstdint>
#include <unordered_set>

#include "plate/model/state.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

template <typename Number>
constexpr bool round_trips() {
  for (Number point = 0; point < 7; ++point)
    for (int c = 0; c < unknowns_per_point; ++c) {
      const Dof one = dof(point, c);
      if (Number(one.point) != point || one.component != std::uint32_t(c)) return false;
      if (is_deflection(one) != (c == 0) || dofs_of(point)[std::size_t(c)] != one) return false;
      if (dof_at(index_in_state(one, 7), 7) != one || dof_by_points(index_by_points(point, c)) != one) return false;
    }
  return true;
}

static_assert(round_trips<int>() && round_trips<std::uint32_t>() && round_trips<std::size_t>() &&
              round_trips<std::ptrdiff_t>());
static_assert(index_by_points(4, 2) == 14 && index_in_state(dof(4, 2), 10) == 24);
static_assert(dof(4, 2) < dof(5, 0) && dof(4, 1) < dof(4, 2));  // by point first
static_assert(entries_per_block == 9);

}  // namespace

TEST_CASE("degrees of freedom find the values of a state", "[space]") {
  constexpr std::size_t points = 5;
  State state(unknowns_per_point, Eigen::Index(points));
  for (Eigen::Index i = 0; i < state.size(); ++i) state.data()[i] = double(i);
  const StateByPoints by_points = state;
  for (std::size_t point = 0; point < points; ++point)
    for (std::size_t c = 0; c < unknowns_per_point; ++c) {
      CHECK(at_dof(state, dof(point, c)) == state(Eigen::Index(c), Eigen::Index(point)));
      CHECK(at_dof(state, dof(point, c)) == state.data()[index_in_state(dof(point, c), points)]);
      CHECK(at_dof(state, dof(point, c)) == by_points.data()[index_by_points(point, c)]);
    }
  at_dof(state, dof(3, 1)) = -1;
  CHECK(state(1, 3) == -1);
}

TEST_CASE("sets of degrees of freedom tell points and components apart", "[space]") {
  const std::unordered_set<Dof> few{dof(0, 1), dof(1, 0), dof(1, 0)};
  CHECK(few.size() == 2);
  CHECK(!few.contains(dof(1, 1)));
}

TEST_CASE("states of zeros and of nothing have a row for every unknown", "[space]") {
  const State zero = zero_state(std::size_t(5));
  CHECK((zero.rows() == unknowns_per_point && zero.cols() == 5));
  CHECK((zero.array() == 0).all());
  CHECK(zero_forces(Eigen::Index(5)) == zero);
  CHECK(zero_like(zero) == zero);
  CHECK((no_state().rows() == unknowns_per_point && no_state().cols() == 0));
}
