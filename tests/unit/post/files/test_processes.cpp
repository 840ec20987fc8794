#include "post/files/processes.hpp"

#include <mutex>

#include "plate/model/halo_exchange.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace post;

namespace {

/// Processes that have been sent what the test says.
class WithTraffic : public plate::CountedCommunicator {
public:
  using CountedCommunicator::CountedCommunicator;
  const plate::Traffic* traffic() const override { return &now; }

  plate::Traffic now;
};

}  // namespace

TEST_CASE("processes: least, mean and largest of what each has, nothing where one has all") {
  CHECK_FALSE(ProcessesOfRun().summary(10, {}, 1, 1));
  CHECK(ProcessesOfRun().first());
  thread_ranks::run(4, [](const plate::Communicator& all) {
    const double rank = all.rank();
    WithTraffic ranks(all);
    ranks.now = {100, 10000, 7, 0.25};
    const ProcessesOfRun processes(ranks);
    ranks.now += {6, 600 + 60 * all.rank(), 30, 0.5};
    const auto found = processes.summary(std::size_t(100 * (all.rank() + 1)), {{"solve", 1 + rank}, {"total", 10}},
                                         1e9 * (5 - rank), 3);
    static std::mutex one_by_one;
    const std::lock_guard guard(one_by_one);
    REQUIRE(found);
    CHECK(processes.first() == (all.rank() == 0));
    CHECK(found->count == 4);
    CHECK(std::array{found->points.least, found->points.mean, found->points.largest} == std::array{100., 250., 400.});
    CHECK(std::array{found->memory.least, found->memory.mean, found->memory.largest} == std::array{2e9, 3.5e9, 5e9});
    CHECK(found->bytes.least == 200);
    CHECK(found->bytes.largest == 260);
    CHECK(found->messages.mean == 2);
    CHECK(found->sums.mean == 10);
    REQUIRE(found->seconds.size() == 2);
    CHECK(found->seconds[0].first == "solve");
    CHECK(found->seconds[0].second.mean == 2.5);
    const auto text = printed(*found);
    CHECK(text.find("4 processes of") != std::string::npos);
    CHECK(text.find("100 to 400 points and 2 to 5 GB of memory each, 14 GB in all") != std::string::npos);
    CHECK(text.find("2 to 2 messages of copies, 0.2 to 0.26 kB and 10 sums of all a step") != std::string::npos);
  });
}
