// A cracked plate that swings for ever: its slowest swing is its equilibrium, its swing in motion the same after long.
#include <fmt/format.h>

#include <complex>
#include <numbers>

#include "cases/driver/run.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::string wanted = "[srif]\n[output]\nprobes = { a = [0.5, 0.7] }\n";

struct Run {
  post::ResultsInMemory in_memory;
  post::Summary summary;

  const post::Table& table(const std::string& name) const {
    for (const auto& [own, table] : in_memory.tables)
      if (own == name) return table;
    throw std::out_of_range(name);
  }
};

Run run_text(const std::string& text, std::vector<std::string> settings) {
  Run result;
  settings.insert(settings.begin(), {"section.density=3", "discretization.formulation=galerkin"});
  result.in_memory.wants_fields = true;
  result.summary = cases::run(read(text, settings), {{}, true, &result.in_memory});
  return result;
}

Run run(const std::vector<std::string>& settings) {
  return run_text(plain + wanted, settings);
}

Run unresisted_motions(double from, double to, const std::string& damping, std::size_t count = 2) {
  return run({"analysis.kind=harmonic", "analysis.damping=" + damping,
              fmt::format("analysis.sweep={{ from = {}, to = {}, count = {} }}", from, to, count)});
}

double number_in(const post::Cell& cell) {
  return std::get<double>(cell);
}

/// Amplitude with its sign or phase of a quantity in the first row that has it.
std::complex<double> response(const Run& run, const std::string& place, const std::string& quantity, double frequency) {
  for (const auto& row : run.table("response").rows)
    if (number_in(row[0]) == frequency && std::get<std::string>(row[1]) == place &&
        std::get<std::string>(row[2]) == quantity)
      return std::polar(number_in(row[3]), number_in(row[4]) * std::numbers::pi / 180);
  throw std::out_of_range(quantity);
}

}  // namespace

TEST_CASE("a response at a low frequency is the equilibrium, and its factors are those at rest") {
  const auto at_rest = run({"analysis.tolerance=1e-10"});
  const auto slow = unresisted_motions(1e-6, 2e-6, "{ mass = 1e-3 }");
  REQUIRE(!at_rest.summary.srif.empty());
  const auto& tip = at_rest.summary.srif.front();
  const auto K1 = response(slow, fmt::format("tip {}", tip.tip), "K1", 1e-6);
  CHECK(K1.real() == Approx(tip.K1).epsilon(1e-6));
  CHECK(std::abs(K1.imag()) < 1e-6 * std::abs(tip.K1));
  const auto& probes = at_rest.table("probes").rows;
  CHECK(response(slow, "a", "w", 1e-6).real() == Approx(number_in(probes.at(0)[4])).epsilon(1e-7));
  for (const auto& row : at_rest.table("reactions").rows) {
    const auto name = std::get<std::string>(row[1]);
    if (name == "loads") continue;
    const auto force = response(slow, "support " + name, "force", 1e-6);
    CHECK(force.real() == Approx(number_in(row[4])).epsilon(1e-6));
    CHECK(std::abs(force.imag()) < 1e-6 * std::abs(force));
    CHECK(response(slow, "support " + name, "moment_x", 1e-6).real() ==
          Approx(number_in(row[5])).epsilon(1e-5).margin(1e-6));
  }
  CHECK(slow.summary.outcome == "done");
  CHECK(slow.summary.resonances.empty());
  CHECK(slow.in_memory.frames.size() == 8);
  REQUIRE(!slow.summary.response.empty());
  CHECK(slow.summary.response.back().place == "plate");
}

TEST_CASE("a response is what a motion under a sine does after long") {
  auto unloaded = plain;
  unloaded.erase(unloaded.find("[[load]]"), unloaded.find("[analysis]") - unloaded.find("[[load]]"));
  const auto modes = run_text(unloaded, {"analysis.kind=frequencies", "analysis.modes=1"});
  const double lowest = modes.summary.frequencies.front().frequency;
  const double omega = 2 * std::numbers::pi * lowest;
  const std::string damping = fmt::format("{{ mass = {}, stiffness = {} }}", 0.1 * omega, 0.1 / omega);  // a tenth
  const auto swings = unresisted_motions(0.7 * lowest, 1.3 * lowest, damping, 3);
  REQUIRE(swings.summary.resonances.size() == 1);
  CHECK(swings.summary.resonances.front() == Approx(lowest).epsilon(1e-3));  // lumped masses there
  for (const double frequency : {0.7 * lowest, 1.3 * lowest}) {
    // exp(-0.1 omega t) after 16 periods of the lowest: 4e-5
    const double period = 1 / frequency, duration = std::ceil(16 * frequency / lowest) * period;
    const auto motion = run({"analysis.kind=dynamic", "analysis.method=lanczos", "analysis.tolerance=1e-5",
                             fmt::format("analysis.duration={:.17g}", duration), "analysis.damping=" + damping,
                             "load[0].history=sine", fmt::format("load[0].frequency={:.17g}", frequency),
                             fmt::format("output.history_every={:.17g}", period / 40)});
    const auto& rows = motion.table("probes").rows;
    const auto at = [&](std::size_t back) { return number_in(rows.at(rows.size() - 1 - back)[4]); };
    // of sin at a whole number of periods: w = Re(-i (A + i B)) = B, a quarter before: -A
    const auto w = response(swings, "a", "w", frequency);
    CHECK(at(0) == Approx(w.imag()).margin(1e-3 * std::abs(w)));
    CHECK(at(10) == Approx(-w.real()).margin(1e-3 * std::abs(w)));
    const auto reaction = [&](const std::string& support, double time) {
      for (const auto& row : motion.table("reactions").rows)
        if (std::abs(number_in(row[0]) - time) < 1e-6 * period && std::get<std::string>(row[1]) == support)
          return number_in(row[4]);
      throw std::out_of_range(support);
    };
    for (const auto& support : motion.summary.reactions->supports) {  // measured: 1.8e-4
      const auto force = response(swings, "support " + support.name, "force", frequency);
      CHECK(reaction(support.name, duration) == Approx(force.imag()).margin(1e-3 * std::abs(force)));
      CHECK(reaction(support.name, duration - period / 4) == Approx(-force.real()).margin(1e-3 * std::abs(force)));
    }
  }
}

TEST_CASE("harmonic analyses are refused with what they lack") {
  const std::vector<std::string> swing{"section.density=3", "analysis.kind=harmonic"};
  const auto refused = [&](std::vector<std::string> more, const std::string& what) {
    more.insert(more.begin(), swing.begin(), swing.end());
    const auto found = case_text::problems(plain + wanted, more);
    INFO(what);
    const bool said =
        std::ranges::any_of(found, [&](const auto& one) { return one.what.find(what) != std::string::npos; });
    CHECK(said);
  };
  const std::string sweep = "analysis.sweep={ from = 1, to = 2 }", damping = "analysis.damping={ mass = 1 }";
  refused({sweep}, "without it nothing limits a resonance");
  refused({damping}, "'sweep' is missing");
  refused({damping, "analysis.sweep={ from = 2, to = 1 }"}, "must be above 'from'");
  refused({damping, sweep, "discretization.formulation=ordinary"}, "Lanczos vectors");
  refused({damping, sweep, "load[0].history=sine", "load[0].frequency=1"}, "is used in dynamics only");
  refused({damping, sweep, "srif.accuracy=0.01"}, "is used in statics and dynamics only");
  CHECK(case_text::problems(plain + wanted, {swing[0], swing[1], sweep, damping, "discretization.formulation=galerkin"})
            .empty());
}
