#include "plate/model/communicator.hpp"

#include <random>

#include "plate/model/point_map.hpp"
#include "plate/model/reduction.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

/// The sum of the values as shared out by turns among so many processes.
double shared(const std::vector<double>& values, int processes) {
  std::vector<double> sums(std::size_t(processes), 0);
  thread_ranks::run(processes, [&](const Communicator& all) {
    std::vector<double> own;
    for (std::size_t i = std::size_t(all.rank()); i < values.size(); i += std::size_t(processes))
      own.push_back(values[i]);
    sums[std::size_t(all.rank())] =
        ordered_sum<1>(all, own.size(), [&](std::size_t i) { return std::array<double, 1>{own[i]}; })[0];
  });
  for (const double sum : sums) CHECK(((sum == sums.front()) || (std::isnan(sum) && std::isnan(sums.front()))));
  return sums.front();
}

}  // namespace

TEST_CASE("exact sums: the same bits for any number of processes and any order") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) values.push_back(normal(random) * std::pow(10.0, i % 9));
  const double one = shared(values, 1);
  for (const int processes : {2, 3, 8}) CHECK(shared(values, processes) == one);
  std::shuffle(values.begin(), values.end(), random);
  CHECK(shared(values, 5) == one);
  long double reference = 0;
  for (const double value : values) reference += value;
  CHECK(one == Approx(double(reference)).epsilon(1e-13));  // measured: 2e-15
}

TEST_CASE("exact sums: single terms keep all their bits, nothing, tiny, huge and missing numbers") {
  for (const double value : {0.1, -3.7e-280, 1.234567890123456789e300, 0.0}) CHECK(shared({value, 0, 0}, 2) == value);
  CHECK(std::abs(shared({5e-324, 0}, 2)) < 1e-300);
  CHECK(shared({}, 3) == 0);
  CHECK(shared({1e300, -1e300, 1}, 3) == 0);  // 1 is below 2^-60 of the largest
  CHECK(std::isnan(shared({1, NAN, 2}, 2)));
  CHECK(std::isnan(shared({1, INFINITY}, 2)));
}

TEST_CASE("the largest and the sum of all processes, of a single process the number itself") {
  const Communicator& one = single_process();
  CHECK_FALSE(one.distributed());
  CHECK(one.rank() == 0);
  CHECK(one.size() == 1);
  CHECK(largest_of(one, -3) == -3);
  CHECK(sum_of_all(one, 0.3) == 0.3);
  CHECK(std::signbit(sum_of_all(one, -0.0)));
  CHECK(count_of_all(PointMap(), 3) == 3);
  CHECK(texts_of_all(PointMap(), "text") == std::vector<std::string>{"text"});
  std::array<bool, 3> right{};
  thread_ranks::run(3, [&](const Communicator& all) {
    const double largest = largest_of(all, -double(all.rank())), sum = sum_of_all(all, all.rank() == 1 ? 0.3 : 0);
    const PointMap map{&all};  // stands for its communicator
    const auto counts = counts_of_all(map, std::array<std::int64_t, 2>{all.rank(), 1});
    const auto items = [&](std::size_t, const auto& add) { add(0, 0.1); };
    wait_for_all(map);
    right[std::size_t(all.rank())] = largest == 0 && sum == 0.3 && all.distributed() && all.size() == 3 &&
                                     counts == std::array<std::int64_t, 2>{3, 3} && map.rank() == all.rank() &&
                                     gathered(map, std::vector<int>{all.rank()}) == std::vector<int>{0, 1, 2} &&
                                     sum_of_items<1>(map, 2, items)[0] == 6 * 0.1;
  });
  CHECK(right == std::array{true, true, true});
}

TEST_CASE("indices at owners: every ghost gets the index that its owner finds by the key, in ascending order") {
  std::array<bool, 3> right{};
  thread_ranks::run(3, [&](const Communicator& all) {
    const int self = all.rank();
    std::vector<std::vector<std::uint32_t>> ghosts(3);
    std::vector<std::vector<double>> keys(3);
    for (int owner = 0; owner < 3; ++owner)
      if (owner != self)
        ghosts[std::size_t(owner)] = {std::uint32_t(9 - owner)}, keys[std::size_t(owner)] = {0.5 + self};
    const auto found = indices_at_owners(
        all, ghosts, keys, [&](double key) { return std::uint32_t(100 * self) + std::uint32_t(2 * key); });
    bool as_expected = found.size() == 2 && found[0].point < found[1].point;
    for (const auto& [point, owner, of_owner] : found)
      as_expected =
          as_expected && point == std::uint32_t(9 - owner) && of_owner == unsigned(100 * owner + 2 * self + 1);
    right[std::size_t(self)] = as_expected;
  });
  CHECK(right == std::array{true, true, true});
}
