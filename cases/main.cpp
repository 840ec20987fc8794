#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <omp.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include "cases/driver/energy_check.hpp"
#include "cases/studies/extremes.hpp"
#include "cases/studies/study.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/files/table.hpp"
#include "post/files/whole_file.hpp"
#include "post/studies/compare.hpp"
#include "post/studies/fatigue.hpp"
#include "post/studies/orders.hpp"

namespace {

enum ExitCode { done = 0, wrong_case = 2, failed_numbers = 3, failed_machine = 4 };

void print_growth(const post::GrowthSummary& growth) {
  constexpr std::size_t most = 8;
  std::vector<std::string> lengths;
  for (std::size_t i = 0; i < std::min(most, growth.lengths.size()); ++i)
    lengths.push_back(fmt::format("{:.4g}", growth.lengths[i]));
  if (growth.lengths.size() > most) lengths.push_back(fmt::format("... ({} in all)", growth.lengths.size()));
  if (lengths.empty()) lengths.push_back("none");
  fmt::print("growth: {}; lengths of the cracks: {}", growth.outcome, fmt::join(lengths, ", "));
  if (growth.first_load_factor && *growth.first_load_factor > 0)
    fmt::print("; load factor {:.5g} at the first advance, {:.5g} at most", *growth.first_load_factor,
               *growth.largest_load_factor);
  if (growth.spent) fmt::print("; energy spent {:.3f} of the fracture energy", *growth.spent);
  if (growth.largest_speed) fmt::print("; largest speed {:.4g}", *growth.largest_speed);
  fmt::print("\n");
}

void print_factors(const std::vector<post::Srif>& srifs) {
  const bool normalized = srifs.front().F1.has_value();
  fmt::print("{:>4} {:>9} {:>9} {:<25} {:>13} {:>13} {:>13}{}  {:>8}\n", "tip", "x", "y", "method", "K1", "K2", "K3",
             normalized ? fmt::format(" {:>9} {:>9} {:>9}", "F1", "F2", "F3") : "", "error");
  for (const auto& s : srifs) {
    const auto number = [&s](std::size_t i, const std::string& text) { return s.resolved[i] ? text : "-"; };
    const double K[] = {s.K1, s.K2, s.K3};
    fmt::print("{:>4} {:>9.4g} {:>9.4g} {:<25}", s.tip, s.position.x(), s.position.y(), s.method);
    for (std::size_t i = 0; i < 3; ++i) fmt::print(" {:>13}", number(i, fmt::format("{:.6g}", K[i])));
    const std::optional<double> F[] = {s.F1, s.F2, s.F3};
    for (std::size_t i = 0; i < 3 && normalized; ++i)
      fmt::print(" {:>9}", number(i, fmt::format("{:.5f}", F[i].value_or(0))));
    fmt::print("  {:>8}\n", s.estimated_error ? fmt::format("{:.2g} %", 100 * *s.estimated_error) : "");
  }
}

void print_accuracy(const post::AccuracySummary& accuracy) {
  fmt::print("accuracy {:.2g} % asked: {}\n{:>8} {:>10} {:>11} {:>9} {:>16}\n", 100 * accuracy.asked, accuracy.outcome,
             "points", "spacing", "tip spacing", "seconds", "estimated error");
  for (const auto& step : accuracy.path)
    fmt::print("{:>8} {:>10.4g} {:>11.4g} {:>9.2f} {:>16}\n", step.points, step.spacing, step.tip_spacing, step.seconds,
               step.error ? fmt::format("{:.2g} %", 100 * *step.error) : "-");
}

void print_result(const post::Summary& summary, const std::filesystem::path& folder) {
  const auto& a = summary.analysis;
  fmt::print("{}: {} ({}), {} points, {} bonds, {} {} in {:.1f} s, {}\n", summary.title, summary.formulation,
             summary.formulation_reason, summary.points, summary.bonds,
             a.iterations ? *a.iterations : a.steps.value_or(0), a.iterations ? "iterations" : "steps",
             summary.seconds.back().second, a.stop_reason);
  if (summary.accuracy) print_accuracy(*summary.accuracy);
  if (!summary.srif.empty()) print_factors(summary.srif);
  for (const auto& s : summary.srif)
    if (s.second && (&s == &summary.srif.front() || (&s)[-1].tip != s.tip))
      fmt::print("tip {}: {} by {} gives K1 {:.6g}, K2 {:.6g}, K3 {:.6g}: {:.2f} % apart\n", s.tip,
                 s.second->formulation, s.second->method, s.second->K1, s.second->K2, s.second->K3,
                 100 * s.second->difference);
  if (!summary.frequencies.empty()) fmt::print("{:>4} {:>13} {:>13} {:>9}\n", "mode", "frequency", "omega", "residual");
  for (const auto& f : summary.frequencies)
    fmt::print("{:>4} {:>13.6f} {:>13.5f} {:>9.1e}\n", f.mode, f.frequency, f.omega, f.residual);
  if (summary.growth) print_growth(*summary.growth);
  for (const auto& warning : summary.warnings) fmt::print("warning: {}\n", warning);
  fmt::print("results in {}\n", folder.string());
}

void print_keys(const std::string& wanted) {
  std::size_t shown = 0;
  for (const auto& key : cases::keys()) {
    if (!wanted.empty() && key.name.find(wanted) == std::string::npos) continue;
    fmt::print("{:<36} {:<16} {}; {}\n{:36}   {}\n", key.name, "[" + key.unit + "]", key.allowed, key.standard, "",
               key.help);
    ++shown;
  }
  if (shown == 0) throw cases::CaseError({{"keys", wanted, "no key contains this; see pdplate keys"}});
}

void print_table(const post::Table& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) fmt::print("{}{}", i ? "," : "", table.columns[i]);
  fmt::print("\n");
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      fmt::print("{}", i ? "," : "");
      if (const auto* number = std::get_if<double>(&row[i])) fmt::print("{}", *number);
      if (const auto* word = std::get_if<std::string>(&row[i])) fmt::print("{}", *word);
    }
    fmt::print("\n");
  }
}

struct Arguments {
  std::string file, folder, key, reference, plot, only;
  std::vector<std::string> settings, methods;
  post::ParisLaw law;
  double load = 1, ratio = 0;
  int threads = 0;
  bool quiet = false, energy = false;
};

void add_case(CLI::App& command, Arguments& a) {
  command.add_option("case", a.file, "case file (TOML)")->required();
  command.add_option("--set", a.settings, "override a key: section.thickness=0.05")->allow_extra_args(false);
  command.add_option("--threads", a.threads, "number of threads (default: all)")->check(CLI::PositiveNumber);
}

int run_study(const Arguments& a) {
  const auto study = cases::read_study(a.file);
  const auto folder =
      a.folder.empty() ? "results" / std::filesystem::path(a.file).stem() : std::filesystem::path(a.folder);
  const auto outcome = cases::run_study(study, {folder, a.quiet});
  if (!a.quiet) {
    fmt::print("{}\n{}", study.title, post::to_text(outcome.table));
    if (!post::orders(outcome.table).empty()) fmt::print("\nfitted orders\n{}", post::orders_text(outcome.table));
    fmt::print("results in {}\n", folder.string());
  }
  if (outcome.failed_numbers > 0) return failed_numbers;
  return outcome.wrong_cases > 0 ? wrong_case : done;
}

int run_extremes(const Arguments& a) {
  const auto extremes = cases::read_extremes(a.file);
  const auto folder =
      a.folder.empty() ? "results" / std::filesystem::path(a.file).stem() : std::filesystem::path(a.folder);
  const auto verdicts = cases::run_extremes(extremes, {folder, a.settings, a.only, a.quiet});
  if (verdicts.empty()) throw cases::CaseError({{a.file, "--only", fmt::format("no row contains \"{}\"", a.only)}});
  const auto missed = std::ranges::count(verdicts, false, &cases::Verdict::holds);
  if (!a.quiet || missed > 0)
    fmt::print("{}\n{}{} of {} oracles hold; results in {}\n", extremes.title, cases::to_text(verdicts),
               verdicts.size() - std::size_t(missed), verdicts.size(), folder.string());
  return missed > 0 ? failed_numbers : done;
}

void require_finite(const Arguments& a) {
  std::vector<cases::Problem> problems;
  for (const auto& [name, value] : {std::pair{"--coefficient", a.law.coefficient},
                                    {"--exponent", a.law.exponent},
                                    {"--threshold", a.law.threshold},
                                    {"--load", a.load},
                                    {"--ratio", a.ratio}})
    if (!std::isfinite(value))
      problems.push_back({"fatigue", name, fmt::format("{:g} given, must be a finite number", value)});
  if (!problems.empty()) throw cases::CaseError(problems);
}

int execute(const CLI::App& app, Arguments& a) {
  if (a.threads > 0) omp_set_num_threads(a.threads);
  if (app.got_subcommand("run")) {
    const auto file = cases::read_case(a.file, a.settings);
    const std::filesystem::path folder = a.folder.empty()
                                             ? std::filesystem::path("results") / std::filesystem::path(a.file).stem()
                                             : std::filesystem::path(a.folder);
    const auto summary = cases::run(file, {folder, a.quiet});
    if (!a.quiet) print_result(summary, folder);
  } else if (app.got_subcommand("check")) {
    fmt::print("{}", cases::cost(cases::read_case(a.file, a.settings)));
  } else if (app.got_subcommand("keys")) {
    print_keys(a.key);
  } else if (app.got_subcommand("srif")) {
    if (a.energy)
      print_table(cases::energy_check(cases::read_case(std::filesystem::path(a.folder) / "case.resolved.toml", {})));
    else
      print_table(cases::srif_again(a.folder, a.methods));
  } else if (app.got_subcommand("compare")) {
    const auto rows = post::compare(a.folder, a.reference);
    fmt::print("{}", post::to_text(rows));
    if (!a.plot.empty()) post::write_whole(a.plot, post::to_svg(post::plot(rows, post::title_of(a.folder))));
  } else if (app.got_subcommand("fatigue")) {
    require_finite(a);
    const std::filesystem::path folder(a.folder);
    const auto file = cases::read_case(folder / "case.resolved.toml", {});
    const auto& c = file.content;
    if (!c.growth || c.analysis.kind != cases::Analysis::Kind::static_ || c.growth->by_bonds())
      throw cases::CaseError(
          {{file.place("growth"), "growth",
            "cycles are counted along tips that grow quasi-statically: a static case with [growth] and criterion = "
            "\"energy_release\""}});
    print_table(post::fatigue(post::read_csv(folder / "growth.csv"), post::read_csv(folder / "tips.csv"), c.section,
                              a.law, a.load, a.ratio));
  } else if (app.got_subcommand("study")) {
    return run_study(a);
  } else if (app.got_subcommand("extremes")) {
    return run_extremes(a);
  }
  return done;
}

/// Threads that wait must sleep, not spin: with one of two cores busy a static run took 5.1 s spinning and 3.7 s
/// sleeping; one force evaluation alone took the same. The OpenMP library reads its setting before main.
bool set_waiting() {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return false;
  return setenv("OMP_WAIT_POLICY", "passive", 1) == 0;
}

#ifdef PDPLATE_OWN_OPENMP
/// Before the constructors of the OpenMP library, which is part of the program.
[[gnu::constructor(101)]] void wait_without_spinning() {
  set_waiting();
}
void wait_without_spinning(char**) {}
#else
/// Starts again: the library has read its setting.
void wait_without_spinning(char** argv) {
  if (set_waiting()) execv("/proc/self/exe", argv);  // returns only where it fails; then threads spin
}
#endif

/// Memory that is given back is kept for the next array: the system clears every page that it hands out.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 28);
  mallopt(M_TRIM_THRESHOLD, 1 << 28);
}

void add_fatigue(CLI::App& app, Arguments& a) {
  auto* fatigue = app.add_subcommand("fatigue", "cycles against length of the cracks of a growth, by Paris' law");
  fatigue->add_option("folder", a.folder, "folder of the results of a case with [growth]")->required();
  fatigue->add_option("--coefficient", a.law.coefficient, "C of da/dN = C (range of K)^m")
      ->required()
      ->check(CLI::PositiveNumber);
  fatigue->add_option("--exponent", a.law.exponent, "m")->required()->check(CLI::PositiveNumber);
  fatigue->add_option("--threshold", a.law.threshold, "range of K that must be exceeded (default 0)")
      ->check(CLI::NonNegativeNumber);
  fatigue->add_option("--load", a.load, "largest load, as a factor of those of the case (default 1)")
      ->check(CLI::PositiveNumber);
  fatigue->add_option("--ratio", a.ratio, "least over largest load (default 0)")->check(CLI::Range(-10.0, 0.999));
}

}  // namespace

int main(int argc, char** argv) {
  wait_without_spinning(argv);
  keep_memory();
  CLI::App app("Cracked Mindlin plates in ordinary state-based peridynamics");
  app.require_subcommand(1);
  app.set_version_flag("--version", "pdplate " PDPLATE_VERSION, "print the version and exit");
  Arguments a;
  auto* run = app.add_subcommand("run", "run a case");
  add_case(*run, a);
  run->add_option("--out", a.folder, "folder of the results (default: results/CASE)");
  run->add_flag("--quiet", a.quiet, "no progress and no table");
  add_case(*app.add_subcommand("check", "validate a case and say what it would cost"), a);
  app.add_subcommand("keys", "the keys of a case file")->add_option("key", a.key, "only keys that contain this");
  auto* srif = app.add_subcommand("srif", "extract intensity factors again from a finished run");
  srif->add_option("folder", a.folder, "folder of the results")->required();
  srif->add_option("--method", a.methods, "method (default: those of the case)");
  srif->add_flag("--energy", a.energy,
                 "instead K from the energies of a longer and a shorter crack: two static runs per tip");
  auto* compare = app.add_subcommand("compare", "error norms against a reference curve");
  compare->add_option("folder", a.folder, "folder of the results")->required();
  compare->add_option("reference", a.reference, "reference curve (CSV)")->required();
  compare->add_option("--plot", a.plot, "file for a plot of the curves (SVG)");
  add_fatigue(app, a);
  auto* study = app.add_subcommand("study", "error against run time over many runs of a case");
  study->add_option("study", a.file, "study file (TOML)")->required();
  study->add_option("--out", a.folder, "folder of the results (default: results/STUDY)");
  study->add_option("--threads", a.threads, "number of threads (default: all)")->check(CLI::PositiveNumber);
  study->add_flag("--quiet", a.quiet, "no lines on runs that succeed and no table");
  auto* extremes = app.add_subcommand("extremes", "cases at the edge of what can be computed, each against its oracle");
  extremes->add_option("table", a.file, "table of extremes (TOML)")->required();
  extremes->add_option("--out", a.folder, "folder of the results (default: results/TABLE)");
  extremes->add_option("--set", a.settings, "override a key of all rows that do not set it")->allow_extra_args(false);
  extremes->add_option("--only", a.only, "only rows whose group or title contains this");
  extremes->add_option("--threads", a.threads, "number of threads (default: all)")->check(CLI::PositiveNumber);
  extremes->add_flag("--quiet", a.quiet, "no lines, and a table only where an oracle is missed");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : wrong_case;
  }
  try {
    return execute(app, a);
  } catch (const cases::CaseError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return wrong_case;
  } catch (const plate::NumericalError& error) {
    fmt::print(stderr, "the numbers failed: {}\n", error.what());
    return failed_numbers;
  } catch (const std::exception& error) {
    fmt::print(stderr, "failed: {}\n", error.what());
    return failed_machine;
  }
}
