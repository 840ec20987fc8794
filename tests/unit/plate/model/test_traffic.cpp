#include "plate/model/halo_exchange.hpp"

#include <mutex>

#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

TEST_CASE("traffic: messages, bytes and sums are counted, and the values stay what they are") {
  thread_ranks::run(3, [](const Communicator& all) {
    const CountedCommunicator counted(all);
    const int left = (all.rank() + 2) % 3, right = (all.rank() + 1) % 3;
    // of three points two are copies of the others' first
    const auto exchange = counted.halo_exchange(3, {{1, left, 0}, {2, right, 0}});
    std::vector<double> one{double(all.rank()), -1, -1};
    exchange->fetch(std::span(one));
    std::vector<float> three(9, -1);
    for (std::size_t c = 0; c < 3; ++c) three[3 * c] = float(10 * all.rank()) + float(c);
    exchange->fetch(std::span(three));
    std::array<std::int64_t, 2> sums{1, all.rank()};
    counted.sum(sums);
    double largest = all.rank();
    counted.largest({&largest, 1});
    const auto texts = counted.exchanged({"a", "b", "c"});

    static std::mutex one_by_one;
    const std::lock_guard guard(one_by_one);
    CHECK(one == std::vector<double>{double(all.rank()), double(left), double(right)});
    CHECK(three[4] == float(10 * left) + 1);
    CHECK(sums == std::array<std::int64_t, 2>{3, 3});
    CHECK(largest == 2);
    CHECK(texts == std::vector<std::string>(3, std::string(1, char('a' + all.rank()))));
    REQUIRE(counted.traffic());
    const auto traffic = *counted.traffic();
    CHECK(traffic.messages == 4);  // two neighbours, twice
    CHECK(traffic.bytes == 2 * 1 * 8 + 2 * 3 * 4);
    CHECK(traffic.sums == 2);
    CHECK(traffic.seconds > 0);
    CHECK((traffic - traffic).bytes == 0);
    Traffic twice = traffic;
    CHECK((twice += traffic).messages == 8);
  });
}

TEST_CASE("traffic: an exchange in two halves sends what there was when it began, and is counted once") {
  thread_ranks::run(2, [](const Communicator& all) {
    const CountedCommunicator counted(all);
    const auto exchange = counted.halo_exchange(2, {{1, 1 - all.rank(), 0}});
    std::vector<double> values{double(all.rank()), -1};
    exchange->start(std::span(values));
    const auto begun = *counted.traffic();
    values[0] = 7;
    exchange->progress();
    exchange->finish();
    const auto ended = *counted.traffic();

    static std::mutex one_by_one;
    const std::lock_guard guard(one_by_one);
    CHECK(values == std::vector<double>{7, double(1 - all.rank())});
    CHECK(begun.messages == 1);
    CHECK(begun.bytes == 8);
    CHECK(ended.messages == 1);
    CHECK(ended.bytes == 8);
    CHECK(ended.seconds > begun.seconds);
  });
}
