#include "cases/programs/command_line.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include "cases/driver/cost_samples.hpp"
#include "cases/driver/fatigue.hpp"
#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/compatibility.hpp"
#include "cases/input/keys.hpp"
#include "cases/input/manual.hpp"
#include "cases/papers/papers.hpp"
#include "cases/studies/comparison.hpp"
#include "cases/studies/extremes.hpp"
#include "cases/studies/study.hpp"
#include "cases/studies/study_files.hpp"
#include "cases/templates/new_case.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/process.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/printed.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

constexpr auto description =
    "Intensity factors, fields, frequencies and growth of cracks in Mindlin plates, by peridynamics\n"
    "\n"
    "PDPlate reads a case (one TOML file: plate, cracks, supports, loads), computes the moment and shear\n"
    "intensity factors K1, K2, K3 of every crack tip with their estimated errors, and writes tables, fields\n"
    "for ParaView and a report. To begin with:\n"
    "  pdplate new first; pdplate run first.toml; xdg-open results/first/report.html\n";

enum ExitCode { done, beyond_tolerance, wrong_case, failed_numbers, failed_machine, interrupted };  // 0 to 5

struct Arguments {
  std::string file, folder, key, only, reference, plot, json, part;
  std::vector<std::string> settings, removed, methods, tolerances;
  std::optional<double> within;  // tolerance of all measures
  ParisLaw law;
  double load = 1, ratio = 0;
  int threads = 0, processes = 0;
  const plate::Communicator* communicator = &plate::single_process();
  bool quiet = false, energy = false, schema = false, pairs = false, again = false, merge = false, resume = false;
};

void add_threads(CLI::App& command, Arguments& a) {
  command.add_option("--threads", a.threads, "number of threads (default: all)")->check(CLI::Range(1, 1024));
}

void add_case(CLI::App& command, Arguments& a) {
  command.add_option("case", a.file, "case file (TOML)")->required();
  command.add_option("--set", a.settings, "override a key: section.thickness=0.05")->allow_extra_args(false);
  command.add_option("--unset", a.removed, "take a key or a table out: srif.normalize")->allow_extra_args(false);
  add_threads(command, a);
}

/// Keys are taken out before others are set.
std::vector<std::string> overrides(const Arguments& a) {
  std::vector<std::string> all;
  for (const auto& key : a.removed) all.push_back("-" + key);
  all.insert(all.end(), a.settings.begin(), a.settings.end());
  return all;
}

std::filesystem::path folder_of(const Arguments& a) {
  return a.folder.empty() ? "results" / std::filesystem::path(a.file).stem() : std::filesystem::path(a.folder);
}

int run_study(const Arguments& a) {
  const auto study = read_study(a.file);
  const auto outcome = cases::run_study(
      study, {.folder = folder_of(a), .quiet = a.quiet, .again = a.again, .part = part_of(a.part), .merge = a.merge});
  if (!a.quiet && a.part.empty()) fmt::print("{}", printed_study(outcome.table, study.title, folder_of(a)));
  if (outcome.missing > 0) return interrupted;
  if (outcome.killed > 0) return failed_machine;
  if (outcome.failed_numbers > 0) return failed_numbers;
  return outcome.wrong_cases > 0 ? wrong_case : done;
}

int run_extremes(const Arguments& a) {
  const auto extremes = read_extremes(a.file);
  const auto folder = folder_of(a);
  const auto verdicts = cases::run_extremes(extremes, {folder, a.settings, a.only, a.quiet});
  if (verdicts.empty()) throw CaseError({{a.file, "--only", fmt::format("no row contains \"{}\"", a.only)}});
  const auto missed = std::ranges::count(verdicts, false, &Verdict::holds);
  if (!a.quiet || missed > 0)
    fmt::print("{}\n{}{} of {} oracles hold; {}", extremes.title, to_text(verdicts),
               verdicts.size() - std::size_t(missed), verdicts.size(), post::results_in(folder));
  return missed > 0 ? failed_numbers : done;
}

int run_papers(const Arguments& a) {
  const std::filesystem::path folder = a.folder.empty() ? "results/papers" : a.folder;
  const auto runs = cases::run_papers({.name = a.key, .folder = folder, .quiet = a.quiet});
  if (!a.quiet) fmt::print("{}{}", to_text(runs), post::results_in(folder));
  return done;
}

int compare(const Arguments& a) {
  ComparedRun compared;
  try {
    compared = cases::compared(a.folder, a.reference, tolerances(a.tolerances, a.within));
  } catch (const std::exception& error) {  // it reads and compares what the arguments name, and does nothing else
    throw CaseError({{a.reference, "compare", error.what()}});
  }
  fmt::print("{}", to_text(compared));
  write(compared, a.plot, a.json);
  return compared.above.empty() ? done : beyond_tolerance;
}

/// A command, or the program without one, as the library of its arguments knows it.
Program::Command described(const CLI::App& app) {
  Program::Command result{app.get_name(), app.get_description(), {}, {}};
  for (const auto* option : app.get_options()) {
    if (option->get_positional()) {
      result.arguments.push_back({option->get_name(), option->get_description(), option->get_required()});
      continue;
    }
    std::vector<std::string> names;
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    const std::string value = option->get_expected_max() > 0 ? option->get_type_name() : "";
    result.options.push_back({names, value.substr(0, value.find(':')), option->get_description()});
  }
  return result;
}

std::string own_pages(const CLI::App& app, const Arguments& a) {
  const auto all = described(app);
  Program program{"pdplate", PDPLATE_VERSION, all.about.substr(0, all.about.find('\n')), all.options, {}};
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
    program.commands.push_back(described(*command));
  if (app.got_subcommand("manual")) return man_page(program, keys());
  const auto found = completion(a.key, program, keys(), template_names());
  if (!found)
    throw CaseError({{"completion", a.key, fmt::format("\"{}\" given, must be one of \"bash\", \"fish\"", a.key)}});
  return *found;
}

/// Ranks share the plate of a run; all other commands are of the first rank alone.
int execute(const CLI::App& app, Arguments& a) {
  if (a.communicator->rank() > 0 && !app.got_subcommand("run")) return done;
  omp_set_num_threads(plate::sensible_threads(a.threads > 0 ? a.threads : omp_get_max_threads()));
  if (app.got_subcommand("run")) {
    const auto file = read_case(a.file, overrides(a), a.communicator->distributed());
    const auto folder = folder_of(a);
    const auto summary =
        run(file, {.folder = folder, .quiet = a.quiet, .resume = a.resume, .communicator = a.communicator});
    if (!a.quiet)
      fmt::print("{}", post::printed(summary, file.content.units == "SI", file.content.section.thickness, folder));
  } else if (app.got_subcommand("check")) {
    fmt::print("{}", cost(read_case(a.file, overrides(a), a.processes > 0), a.processes));
  } else if (app.got_subcommand("new")) {
    fmt::print("{}", a.key.empty() ? template_menu() : new_case(a.key, a.file));
  } else if (app.got_subcommand("manual") || app.got_subcommand("completion")) {
    fmt::print("{}", own_pages(app, a));
  } else if (app.got_subcommand("keys") && a.pairs) {
    fmt::print("{}", exclusion_list());
  } else if (app.got_subcommand("keys") && a.schema) {
    fmt::print("{}", schema("A case of PDPlate", keys()));
  } else if (app.got_subcommand("keys")) {
    const auto lines = key_lines(keys(), a.key);
    if (lines.empty()) throw CaseError({{"keys", a.key, "no key contains this; see pdplate keys"}});
    fmt::print("{}", lines);
  } else if (app.got_subcommand("srif")) {
    const auto again = std::filesystem::path(a.folder) / "case.resolved.toml";
    fmt::print("{}", post::csv_text(a.energy ? energy_check(read_case(again, {})) : srif_again(a.folder, a.methods)));
  } else if (app.got_subcommand("report")) {
    report_again(a.folder);
  } else if (app.got_subcommand("compare")) {
    return compare(a);
  } else if (app.got_subcommand("fatigue")) {
    fmt::print("{}", post::csv_text(fatigue(a.folder, a.law, a.load, a.ratio)));
  } else if (app.got_subcommand("study")) {
    return run_study(a);
  } else if (app.got_subcommand("extremes")) {
    return run_extremes(a);
  } else if (app.got_subcommand("papers")) {
    return run_papers(a);
  }
  return done;
}

void add_compare(CLI::App& app, Arguments& a) {
  auto* compare = app.add_subcommand("compare", "error norms against a reference curve");
  compare->add_option("folder", a.folder, "folder of the results")->required();
  compare->add_option("reference", a.reference, "reference curve (CSV)")->required();
  compare->add_option("--plot", a.plot, "file for a plot of the curves (SVG), or a page (.html)");
  compare->add_option("--json", a.json, "file for all numbers (JSON)");
  compare->add_option("--tolerance", a.tolerances, "exit code 1 above: l2=0.01, max, peak, peak_time, shift (relative)")
      ->allow_extra_args(false);
  compare->add_option("--within", a.within, "the same tolerance for all of these")->check(CLI::NonNegativeNumber);
}

void add_fatigue(CLI::App& app, Arguments& a) {
  const CLI::Validator finite(
      [](const std::string& text) {
        return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : "must be a finite number";
      },
      "");
  auto* fatigue = app.add_subcommand("fatigue", "cycles against length of the cracks of a growth, by Paris' law");
  fatigue->add_option("folder", a.folder, "folder of the results of a case with [growth]")->required();
  fatigue->add_option("--coefficient", a.law.coefficient, "C of da/dN = C (range of K)^m")
      ->required()
      ->check(CLI::PositiveNumber & finite);
  fatigue->add_option("--exponent", a.law.exponent, "m")->required()->check(CLI::PositiveNumber & finite);
  fatigue->add_option("--threshold", a.law.threshold, "range of K that must be exceeded (default 0)")
      ->check(CLI::NonNegativeNumber & finite);
  fatigue->add_option("--load", a.load, "largest load, as a factor of those of the case (default 1)")
      ->check(CLI::PositiveNumber & finite);
  fatigue->add_option("--ratio", a.ratio, "least over largest load (default 0)")->check(CLI::Range(-10.0, 0.999));
}

void add_pages(CLI::App& app, Arguments& a) {
  auto* fresh = app.add_subcommand("new", "write a commented case or study to begin with; alone: what there is");
  fresh->add_option("template", a.key, "which");
  fresh->add_option("file", a.file, "file to write (default: TEMPLATE.toml)");
  auto* keys = app.add_subcommand("keys", "the keys of a case file");
  keys->add_option("key", a.key, "only keys that contain this");
  keys->add_flag("--schema", a.schema, "all keys as a JSON schema, for editors");
  keys->add_flag("--pairs", a.pairs, "the pairs of features that do not go together, and why");
  app.add_subcommand("manual", "this program's page for man, in roff");
  app.add_subcommand("completion", "completion of commands, options and keys in a shell")
      ->add_option("shell", a.key, "bash or fish")
      ->required();
}

void add_many(CLI::App& app, Arguments& a) {
  auto* study = app.add_subcommand("study", "error against run time over many runs of a case");
  study->add_option("study", a.file, "study file (TOML)")->required();
  study->add_option("--out", a.folder, "folder of the results (default: results/STUDY)");
  add_threads(*study, a);
  auto* again = study->add_flag("--again", a.again, "make runs anew that are done already");
  study->add_option("--part", a.part, "make this share of the runs alone, and no tables: 3/16, the third of sixteen")
      ->check(CLI::Validator(wrong_part, ""));
  study->add_flag("--merge", a.merge, "make no run: tables, plots and report of what parts have made")
      ->excludes("--part", again);
  study->add_flag("--quiet", a.quiet, "no lines on runs that succeed and no table");
  auto* extremes = app.add_subcommand("extremes", "cases at the edge of what can be computed, each against its oracle");
  extremes->add_option("table", a.file, "table of extremes (TOML)")->required();
  extremes->add_option("--out", a.folder, "folder of the results (default: results/TABLE)");
  extremes->add_option("--set", a.settings, "override a key of all rows that do not set it")->allow_extra_args(false);
  extremes->add_option("--only", a.only, "only rows whose group or title contains this");
  add_threads(*extremes, a);
  extremes->add_flag("--quiet", a.quiet, "no lines, and a table only where an oracle is missed");
  auto* papers = app.add_subcommand("papers", "examples of the papers: published, computed and reference values");
  papers->add_option("name", a.key, "of one paper, such as scabbia2021 (default: all)");
  papers->add_option("--out", a.folder, "folder of the results (default: results/papers)");
  add_threads(*papers, a);
  papers->add_flag("--quiet", a.quiet, "no lines and no table");
}

int said(const std::string& what, ExitCode code) {
  post::say(what + "\n");
  return code;
}

/// Returns the exit code of a command and prints its final message.
int ended(const CLI::App& app, Arguments& a) {
  try {
    const int code = execute(app, a);
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw std::system_error(errno, std::generic_category(), "output");
    return code;
  } catch (const CaseError& error) {
    return said(error.what(), wrong_case);
  } catch (const plate::NumericalError& error) {
    return said(fmt::format("the numbers failed: {}", error.what()), failed_numbers);
  } catch (const plate::Interrupted& asked) {
    return said(fmt::format("interrupted: {}", asked.what()), interrupted);
  } catch (const std::system_error& error) {  // whoever read what was printed may have had enough
    const bool of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error) != nullptr;
    if (!of_file && error.code() == std::errc::broken_pipe) return done;
    return said(fmt::format("failed: {}", error.what()), failed_machine);
  } catch (const std::bad_alloc&) {
    return said("failed: the memory does not suffice", failed_machine);
  } catch (const std::exception& error) {
    return said(fmt::format("failed: {}", error.what()), failed_machine);
  }
}

}  // namespace

int command_line(int argc, char** argv, const plate::Communicator& communicator) {
  CLI::App app(description);
  app.require_subcommand(1);
  app.set_version_flag("--version", "pdplate " PDPLATE_VERSION ", kernels " PDPLATE_KERNELS,
                       "print the version and exit");
  Arguments a;
  a.communicator = &communicator;
  auto* run = app.add_subcommand("run", "run a case");
  add_case(*run, a);
  run->add_option("--out", a.folder, "folder of the results (default: results/CASE)");
  run->add_flag("--quiet", a.quiet, "no progress and no table");
  run->add_flag("--resume", a.resume, "go on from the last checkpoint of a run that was ended");
  auto& check = *app.add_subcommand("check", "validate a case and say what it would cost");
  add_case(check, a);
  check.add_option("--processes", a.processes, "number of them that share the plate")->check(CLI::Range(1, 1 << 20));
  add_pages(app, a);
  auto* srif = app.add_subcommand("srif", "extract intensity factors again from a finished run");
  srif->add_option("folder", a.folder, "folder of the results")->required();
  srif->add_option("--method", a.methods, "method (default: those of the case)");
  srif->add_flag("--energy", a.energy,
                 "instead K from the energies of a longer and a shorter crack: two static runs per tip");
  app.add_subcommand("report", "write report.html of a finished run again")
      ->add_option("folder", a.folder, "folder of the results")
      ->required();
  add_compare(app, a);
  add_fatigue(app, a);
  add_many(app, a);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : wrong_case;
  }
  a.quiet = a.quiet || communicator.rank() > 0;
  return ended(app, a);
}

}  // namespace cases
