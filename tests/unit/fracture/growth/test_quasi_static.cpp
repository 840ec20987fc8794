// The loop over equilibria, with a model that is a list of answers.
#include "fracture/growth/quasi_static_growth.hpp"

#include <csignal>

#include "plate/formulation/constraints.hpp"
#include "plate/solve/interruption.hpp"
#include "tests/catch.hpp"

using namespace fracture;

namespace {

class Script : public QuasiStaticModel {
public:
  explicit Script(std::vector<Loaded> answers) : answers_(std::move(answers)) {}

  Loaded solve() override { return answers_.at(advances_); }
  void choose(const Equilibrium& state) override { chosen.push_back(state); }
  void advance(double factor) override { ++advances_, spent_ += factor; }
  std::size_t advances() const override { return advances_; }
  double fracture_energy() const override { return spent_; }
  bool longest() const override { return advances_ >= longest_; }

  const plate::Formulation& plate() const override { throw std::logic_error("a script has no points"); }
  const plate::Constraints& constraints() const override { return constraints_; }
  const plate::State& state() const override { throw std::logic_error("a script has no state"); }
  const plate::StaticSolution& solution() const override { throw std::logic_error("a script is not solved"); }
  std::optional<std::vector<post::Srif>> factors(double) override { return std::nullopt; }
  plate::Mesh draw(post::Frame&, const plate::State&) const override { return {}; }
  std::vector<double> lengths() const override { return {}; }
  void save(plate::OutArchive&) const override {}
  void restore(plate::InArchive&) override {}

  std::vector<Equilibrium> chosen;
  std::size_t longest_ = 100;

private:
  std::vector<Loaded> answers_;
  std::size_t advances_ = 0;
  double spent_ = 0;
  plate::Constraints constraints_;
};

const std::vector<Loaded> stable{{"", 1, 0.1}, {"", 1, 0.2}, {"", 1, 0.3}, {"", 1, 2}};

Ended ended(Script script, const Growth& growth = {}) {
  std::size_t seen = 0;
  const auto result = grow_quasi_statically(growth, script, [&](const Equilibrium&) { ++seen; });
  CHECK(seen == script.chosen.size());
  for (std::size_t i = 0; i < seen; ++i) {
    CHECK(script.chosen[i].advance == i);
    CHECK(script.chosen[i].ends == (i + 1 == seen && result.ended.how != End::split));
  }
  return result.ended;
}

}  // namespace

TEST_CASE("quasi-static loop: every end by its cause, and only the last state ends") {
  CHECK(ended(Script(stable)).how == End::arrested);
  CHECK(ended(Script({{"", 1, 2}})).how == End::no_growth);
  CHECK(ended(Script({{"", 1, INFINITY, End::cannot_grow}})).how == End::cannot_grow);
  const auto split = ended(Script({{"", 1, 0.1}, {"a piece", 0, 0}}));
  CHECK(split.how == End::split);
  CHECK(split.detail == "a piece");
  Growth few;
  few.max_advances = 2;
  CHECK(ended(Script(stable), few).how == End::most_advances);
  Script some(stable);
  some.longest_ = 1;
  CHECK(ended(some).how == End::longest);
}

TEST_CASE("quasi-static loop: an advance that is not stable jumps, or ends where it must not") {
  const std::vector<Loaded> falls{{"", 1, 0.5}, {"", 2, 0.3}, {"", 3, 2}};
  Growth growth;
  CHECK(ended(Script(falls), growth).how == End::arrested);
  for (const auto unstable : {Growth::Unstable::stop, Growth::Unstable::move}) {
    growth.unstable = unstable;
    CHECK(ended(Script(falls), growth).how == End::unstable);
    CHECK(ended(Script(stable), growth).how == End::arrested);
  }
}

TEST_CASE("quasi-static loop: one that goes on ends as one that was never ended") {
  Script whole(stable);
  std::optional<QuasiStaticLoad> at_second;
  const auto all = grow_quasi_statically({}, whole, [](const auto&) {}, {nullptr, [&](const QuasiStaticLoad& load) {
                                                                           if (whole.advances() == 1) at_second = load;
                                                                         }});
  REQUIRE(at_second);
  Script later(stable);
  later.advance(0.1);  // as it was then
  const auto rest = grow_quasi_statically({}, later, [](const auto&) {}, {&*at_second, {}});
  CHECK(rest.ended.how == all.ended.how);
  CHECK(rest.ledger.external_work == all.ledger.external_work);
  CHECK(rest.ledger.fracture == all.ledger.fracture);
  REQUIRE(later.chosen.size() == 2);
  CHECK(later.chosen[0].advance == 2);
  CHECK(later.chosen[1].factor == whole.chosen[3].factor);
}

TEST_CASE("quasi-static loop: a signal ends it after the state in hand") {
  const plate::StopOnSignals guard;
  Script script(stable);
  CHECK_THROWS_AS(grow_quasi_statically({}, script,
                                        [](const Equilibrium& state) {
                                          if (state.advance == 1) std::raise(SIGTERM);
                                        }),
                  plate::Interrupted);
  CHECK(script.chosen.size() == 2);
}
