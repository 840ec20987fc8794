#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/problems.hpp"
#include "fracture/growth/growth.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"

/// The application: case files in, results out.
namespace cases {

using plate::Analysis;

/// Output of a run beside its tables, and its intervals.
struct Output {
  bool vtk = true, hdf5 = true;
  bool errors = true;           // of results at rest and of frequencies, from a second run with other points
  std::optional<bool> report;   // absent: where fields are written
  std::optional<double> every;  // dynamic: time between frames; absent: first and last only
  std::optional<double>
      history_every;             // dynamic: time between rows of history, probes and SRIFs; absent: duration / 400
  double checkpoint_every = 60;  // [s] of the clock; 0: never
  std::map<std::string, geometry::Point> probes;
  std::map<std::string, std::array<geometry::Point, 2>> lines;  // from one point to the other, at rest
  std::size_t edge_reactions = 0;         // pieces of every edge along which reactions are recorded, at rest
  std::optional<double> stress_distance;  // from singular places, of stress [length]; absent: the thickness

  bool reports() const { return report.value_or(vtk || hdf5); }
};

/// Shares of results to which these are to be known, by a discretisation that the program finds.
struct AccuracyTargets {
  std::optional<double> deflection, stress, reactions, frequencies;
  double seconds = 600;  // of the clock, for the search
};

/// Case of a simulation, as plain data: a plate, and what is done with it.
struct Case : plate::Problem {
  std::string title, source, units = "none";
  std::string project, author, date;                    // for the head of the report; empty: not given
  std::string recipe;                                   // whose keys hold where the file gives none; empty: none
  std::string recipe_keys;                              // these keys with their values, in words
  std::string formulation_reason = "as the case says";  // why discretization.formulation is what it is
  Analysis analysis;
  std::optional<fracture::Growth> growth;
  std::optional<post::SrifOptions> srif;    // where intensity factors are wanted
  std::optional<AccuracyTargets> accuracy;  // of results other than factors
  Output output;

  /// True where the program finds the discretisation.
  bool finds_spacing() const { return accuracy || (srif && srif->accuracy); }
  bool grows_at_rest() const { return growth && analysis.kind == Analysis::Kind::static_; }
  bool moves() const { return analysis.kind == Analysis::Kind::dynamic; }
  /// True where the middle plane is solved for a given deflection: at rest, or at the begin of a motion.
  bool stretches_at_first() const { return stretches && (!moves() || (initial && initial->deflection.given())); }
  bool si() const { return units == "SI"; }
  /// True of results whose errors are estimated from another run.
  bool wants_errors() const {
    return output.errors && !growth && analysis.control != plate::LoadControl::arc_length &&
           (analysis.kind == Analysis::Kind::static_ || analysis.kind == Analysis::Kind::frequencies);
  }
};

/// A case together with the file that it is from.
struct CaseFile {
  Case content;
  Source source;

  std::string place(const std::string& key) const { return source.place(key); }
};

/// Reads a case file and applies the overrides in turn: "key=value" (value as TOML; a bare word is a string), or
/// "-key", which takes the key out. Checks syntax, unknown and unused keys, types, bounds, geometry, edge names. Throws
/// CaseError. `distributed`: several ranks are to run it, which decides about methods that the file leaves open.
CaseFile read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                   bool distributed = false);

/// Reads a case from text, as read_case() does from a file; `name` stands for the file in messages.
CaseFile read_case_text(const std::string& text, const std::string& name, const std::vector<std::string>& overrides);

/// The whole case with all defaults as TOML: reading it gives the same case.
std::string resolved_toml(const Case& content);

/// The key of a load of a problem with the loads of all its load cases: "load[2]", "case[0].load[1]".
std::string key_of_load(const plate::Problem& problem, std::size_t load);

/// The key that a refusal is about.
std::string key_of(const plate::Refusal& refusal, const plate::Problem& problem);

/// Converts the refusals of a plate to problems of the case.
std::vector<Problem> problems_of(const CaseFile& file, const std::vector<plate::Refusal>& refusals);

/// Returns the result of `make`. Throws CaseError where a plate refuses it.
template <class Make>
auto unless_refused(const CaseFile& file, const Make& make) {
  try {
    return make();
  } catch (const plate::Refused& error) {
    throw CaseError(problems_of(file, error.reasons()));
  }
}

}  // namespace cases
