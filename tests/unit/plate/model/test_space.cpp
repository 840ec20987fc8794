#include "plate/model/space.hpp"

#include <cstdint>
#include <type_traits>

#include "plate/model/state.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

template <typename Number>
constexpr bool round_trips() {
  for (Number point = 0; point < 7; ++point) {
    for (int c = 0; c < unknowns_per_point; ++c) {
      const Number number = dof(point, c);
      if (point_of(number) != point || component_of(number) != Number(c)) return false;
      if (is_deflection(number) != (c == 0) || dofs_of(point)[std::size_t(c)] != number) return false;
      if (dof_of_flat(flat(number, 7), 7) != std::size_t(number)) return false;
    }
  }
  return true;
}

static_assert(round_trips<int>() && round_trips<std::uint32_t>() && round_trips<std::size_t>() &&
              round_trips<std::ptrdiff_t>());
static_assert(dof(4, 2) == 14 && point_of(14) == 4 && component_of(14) == 2);
static_assert(flat(14, 10) == 24);
static_assert(entries_per_block == 9);

// The integer type of the point stays.
static_assert(std::is_same_v<decltype(dof(std::uint32_t(1), 2)), std::uint32_t>);
static_assert(std::is_same_v<decltype(dof(std::size_t(1), std::ptrdiff_t(2))), std::size_t>);
static_assert(std::is_same_v<decltype(dof(1, 2)), int>);
static_assert(std::is_same_v<decltype(point_of(std::uint32_t(1))), std::uint32_t>);
static_assert(std::is_same_v<decltype(component_of(std::ptrdiff_t(1))), std::ptrdiff_t>);

}  // namespace

TEST_CASE("degrees of freedom number the values of a state", "[space]") {
  constexpr std::size_t points = 5;
  State state(unknowns_per_point, Eigen::Index(points));
  for (Eigen::Index i = 0; i < state.size(); ++i) state.data()[i] = double(i);
  for (std::size_t point = 0; point < points; ++point)
    for (std::size_t c = 0; c < unknowns_per_point; ++c) {
      CHECK(at_dof(state, dof(point, c)) == state(Eigen::Index(c), Eigen::Index(point)));
      CHECK(at_dof(state, dof(point, c)) == state.data()[flat(dof(point, c), points)]);
    }
  at_dof(state, dof(3, 1)) = -1;
  CHECK(state(1, 3) == -1);
}

TEST_CASE("states of zeros and of nothing have a row for every unknown", "[space]") {
  const State zero = zero_state(std::size_t(5));
  CHECK((zero.rows() == unknowns_per_point && zero.cols() == 5));
  CHECK((zero.array() == 0).all());
  CHECK(zero_forces(Eigen::Index(5)) == zero);
  CHECK((no_state().rows() == unknowns_per_point && no_state().cols() == 0));
}

TEST_CASE("degrees of freedom count the memory of a state by points", "[space]") {
  constexpr std::size_t points = 5;
  const State state = State::Random(unknowns_per_point, Eigen::Index(points));
  const StateByPoints by_points = state;
  for (std::size_t i = 0; i < unknowns_per_point * points; ++i) CHECK(by_points.data()[i] == at_dof(state, i));
}
