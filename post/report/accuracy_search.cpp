#include "post/report/accuracy_search.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/process.hpp"
#include "plate/model/space.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/factors/tip_section.hpp"
#include "post/report/terminal.hpp"

namespace post {
namespace {

/// Distance from any tip to what disturbs its field; the side of the plate without tips.
double exact_clear_distance(const plate::Problem& problem, double side) {
  plate::Problem fine = problem;  // bends count, however slight
  fine.discretization.spacing = side, fine.discretization.tip_spacing = 1e-6 * side;
  const auto paths = plate::crack_paths(fine);
  return std::min(side, least_clear_distance(fine, paths, geometry::tips(paths)));
}

/// Radius of the smallest hole or supported part of the plate [length]; none without them.
std::optional<double> least_radius(const plate::Problem& problem) {
  std::optional<double> result;
  auto shapes = problem.outline.holes;
  for (const auto& support : problem.supports)
    if (support.patch) shapes.push_back(*support.patch);
  const auto take = [&](double radius) { result = std::min(result.value_or(radius), radius); };
  for (const auto& hole : shapes) {
    if (const auto* circle = std::get_if<geometry::Circle>(&hole)) {
      take(circle->radius);
      continue;
    }
    const auto [low, high] = geometry::bounding_box(std::get<geometry::Polygon>(hole).vertices);
    take((high - low).minCoeff() / 2);
  }
  return result;
}

}  // namespace

plate::Discretization discretization_of(const plate::Problem& problem, bool moves, double size) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const geometry::Point sides = high - low;
  const double layer = problem.section.layer();
  plate::Discretization result = problem.discretization;
  result.spacing = size * sides.minCoeff() / (moves ? 28 : 10);
  result.tip_spacing = std::min(
      size * size * std::min(exact_clear_distance(problem, sides.maxCoeff()) / 20, 0.63 * layer), result.spacing);
  result.hole_spacing.reset();
  if (const auto radius = least_radius(problem)) result.hole_spacing = std::min(size * *radius / 4, result.spacing);
  result.spacing_growth = 0.28 * size;
  return result;
}

plate::Discretization discretization_for_results(const plate::Problem& problem, double size) {
  auto result = discretization_of(problem, false, size);
  if (problem.discretization.formulation->offers(plate::Feature::graded_points)) return result;
  result.tip_spacing.reset(), result.hole_spacing.reset();
  result.spacing_growth = problem.discretization.spacing_growth;
  return result;
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr double doubles_the_points = std::numbers::sqrt2;  // of the size
constexpr double least_size = 0.0715;                       // of spacing_growth 0.02, the least that a case may ask for

/// Bytes that a run takes: measured 17 kB per point at 8,000 and 39,000 points, 18 at 85,000, most of them of the
/// factor; in motion `vectors` of Lanczos beside, with their forces and the modes.
double bytes_of(std::size_t points, std::size_t vectors) {
  return (18e3 + 3 * plate::unknowns_per_point * 8 * double(vectors)) * double(points);
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

AccuracyStep step_of(double size, AccuracyTrial trial, double seconds) {
  const auto& problem = trial.plate->problem();
  const auto& d = problem.discretization;
  const double clear = least_clear_distance(problem, trial.plate->paths(), trial.plate->tips());
  const double faces = std::min(d.spacing, *d.tip_spacing + d.spacing_growth * clear) / problem.section.layer();
  return {size,
          trial.plate->cloud().plate_points,
          d.spacing,
          *d.tip_spacing,
          d.hole_spacing,
          d.spacing_growth,
          faces,
          seconds,
          std::move(trial.rows),
          std::move(trial.truncated),
          std::nullopt,
          std::move(trial.rows_in_plane)};
}

/// K1 of a crack that releases the whole energy of the plate over its smaller side; N1 by the law of the membrane.
double nominal_factor(const plate::Problem& problem, double strain_energy, plate::PlateLaw law) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  auto section = problem.section;
  section.law = law;
  return std::sqrt(strain_energy / (high - low).minCoeff() / TipSection(section).unit_release()[0]);
}

/// True where a plate of a smaller size would take more than half of the memory that is free.
bool beyond_memory(double size, const SizeOfStep& last, std::size_t vectors) {
  const double free = plate::free_memory(), ratio = std::pow(last.size / size, 2);
  return free > 0 && bytes_of(std::size_t(ratio * double(last.points)), vectors) > free / 2;
}

/// True where a plate of a smaller size is expected to end the search later than after `most` seconds.
bool beyond_time(double size, const SizeOfStep& last, double spent, double most) {
  constexpr double order = 1.3;  // of the time, in the number of points: measured 1.1 to 1.4
  return spent + last.seconds * std::pow(last.size / size, 2 * order) > most;
}

/// Reason that forbids a smaller size; empty where there is none.
std::string end_before(double size, const std::vector<AccuracyStep>& path, std::size_t vectors, double seconds,
                       const SrifOptions& options) {
  if (size < least_size) return "the finest discretisation of this program";
  const SizeOfStep last{path.back().size, path.back().points, path.back().seconds};
  if (beyond_memory(size, last, vectors)) return "memory";
  if (beyond_time(size, last, seconds, options.accuracy_seconds)) return "`accuracy_seconds`";
  return "";
}

/// The size after the last one, or what ends the search.
struct Next {
  double size;
  std::string end;
};

/// Chooses the next size: one step that doubles the number of points, or two steps at once where one is far from
/// sufficient and two are feasible.
Next next_size(const std::vector<AccuracyStep>& path, std::size_t vectors, double seconds, const SrifOptions& options) {
  constexpr double enough = 3.5;
  const auto& last = path.back();
  if (last.error && *last.error > enough * *options.accuracy)
    if (const double size = last.size / 2; end_before(size, path, vectors, seconds, options).empty()) return {size, ""};
  const double size = last.size / doubles_the_points;
  return {size, end_before(size, path, vectors, seconds, options)};
}

/// Adds what Lanczos vectors leave out to the errors of tips without refined factors, in which it is.
void add_truncation(const std::vector<double>& truncated, const std::vector<std::vector<Srif>>& refined,
                    std::vector<std::vector<Srif>>& rows, double thickness) {
  std::vector<double> largest(truncated.size(), 0);
  for (const auto& row : rows)
    for (const auto& srif : row)
      if (!of_opening(srif.method)) largest[srif.tip] = std::max(largest[srif.tip], largest_factor(srif, thickness));
  for (auto& row : rows)
    for (auto& srif : row)
      if (refined.empty() || std::ranges::find(refined.front(), srif.tip, &Srif::tip) == refined.front().end())
        widen(srif, truncated[srif.tip] * largest[srif.tip], thickness);
}

/// Puts the refined factors of every tip before those of the finest discretisation, whose errors they tell.
void put_first(std::vector<std::vector<Srif>> refined, std::vector<std::vector<Srif>>& rows, const SrifOptions& options,
               double thickness) {
  for (std::size_t i = 0; i < refined.size(); ++i)
    for (auto& best : refined[i]) {
      normalize(best, options, thickness);
      for (auto& srif : rows[i])
        if (srif.tip == best.tip) refer_to(best, srif, thickness);
      rows[i].insert(std::ranges::find(rows[i], best.tip, &Srif::tip), std::move(best));
    }
}

/// Factors of one kind on the way: those of bending, or those in the plane.
struct FactorGroup {
  RowsOfStep rows;
  double at_faces;                                           // force per length at the faces of the plate, per factor
  double nominal = 0;                                        // nominal_factor()
  std::vector<std::vector<std::vector<Srif>>> refined = {};  // after every discretisation
};

class Search {
public:
  Search(const SrifOptions& options, const Solve& solve, Progress& progress)
      : options_(options), solve_(solve), progress_(progress) {
    found_.asked = *options.accuracy;
  }

  AccuracyFound run() {
    constexpr double first_sizes = 0.2;
    constexpr int most = 3;  // that fail one after the other
    int failed = 0;
    for (double size = 1; found_.ended_by.empty();) {
      const auto why = step(size);
      failed = why.empty() ? 0 : failed + 1;
      if (found_.path.empty() && size < first_sizes) return {};
      if (!why.empty()) {
        size /= doubles_the_points;
        if (found_.path.empty()) continue;
        found_.ended_by =
            failed == most ? why : end_before(size, found_.path, vectors_, seconds_since(start_), options_);
        continue;
      }
      try_between();
      if (found_.path.back().error && *found_.path.back().error <= found_.asked) break;
      const auto next = next_size(found_.path, vectors_, seconds_since(start_), options_);
      size = next.size, found_.ended_by = next.end;
    }
    AccuracyFound result;
    found_.reached = 0;
    for (const auto& kind : kinds_) {
      const double nominal = nominal_of(kind);
      auto best = best_of(kind.refined, tips_, thickness_, nominal);
      judge(best.rows, thickness_, nominal);
      found_.reached = larger(found_.reached, best.error);
      (&kind == &kinds_.front() ? result.refined : result.refined_in_plane) = std::move(best.rows);
    }
    result.summary = std::move(found_);
    return result;
  }

private:
  using Error = std::optional<double>;
  static Error larger(Error one, Error other) { return one && other ? std::max(one, other) : std::nullopt; }

  /// Factor of a kind of which a hundredth is the least that errors count against: its own nominal one, or what the
  /// factors of the other kind are at the faces.
  double nominal_of(const FactorGroup& kind) const {
    double result = 0;
    for (const auto& other : kinds_) {
      double most = other.nominal;
      if (&other != &kind)
        for (const auto& row : other.refined.back()) most = std::max(most, largest_of_tips(row, thickness_));
      result = std::max(result, most * (other.at_faces / kind.at_faces));
    }
    return result;
  }

  /// Where the last discretisation is two steps finer than the one before it and its error is larger, replaces it by
  /// the one between, if that can be had.
  void try_between() {
    auto& path = found_.path;
    if (path.size() < 2) return;
    const auto &last = path.back(), &before = path[path.size() - 2];
    const double size = before.size / doubles_the_points;
    if (last.size > 0.9 * size || !last.error || !before.error || *last.error <= *before.error) return;
    auto finest = std::move(path.back());
    path.pop_back();
    if (!end_before(size, path, vectors_, seconds_since(start_), options_).empty() || !step(size).empty())
      path.push_back(std::move(finest));
  }

  /// Adds a discretisation to the path; else why there is none.
  std::string step(double size) {
    const auto begin = Clock::now();
    std::variant<AccuracyTrial, Infeasible> next;
    try {
      next = solve_(size);
    } catch (const plate::NumericalError& error) {
      if (found_.path.empty()) throw;
      return error.what();
    }
    if (const auto* unfit = std::get_if<Infeasible>(&next))
      return fmt::format("what forbids the next discretisation: {}", unfit->why);
    auto& trial = std::get<AccuracyTrial>(next);
    const auto& problem = trial.plate->problem();
    tips_ = trial.plate->tips().size(), vectors_ = trial.vectors, thickness_ = problem.section.thickness;
    if (kinds_.empty()) kinds_.push_back({&AccuracyStep::rows, 6 / thickness_});
    if (kinds_.size() < 2 && !trial.rows_in_plane.empty()) kinds_.push_back({&AccuracyStep::rows_in_plane, 1});
    const std::array energies{trial.strain_energy, trial.energy_in_plane};
    constexpr std::array laws{plate::PlateLaw::bending, plate::PlateLaw::membrane};
    for (std::size_t i = 0; i < kinds_.size(); ++i) kinds_[i].nominal = nominal_factor(problem, energies[i], laws[i]);
    found_.path.push_back(step_of(size, std::move(trial), seconds_since(begin)));
    for (auto& kind : kinds_) kind.refined.push_back(post::refined(found_.path, thickness_, kind.rows));
    Error error = 0;
    for (const auto& kind : kinds_)
      error = larger(error, largest_error(kind.refined.back(), tips_, thickness_, nominal_of(kind)));
    found_.path.back().error = error;
    progress_.update(std::min(0.99, error ? found_.asked / *error : 0),
                     fmt::format("{} points, {}", found_.path.back().points,
                                 error ? fmt::format("estimated error {:.2g} %", 100 * *error) : "no estimate yet"));
    return "";
  }

  const SrifOptions& options_;
  const Solve& solve_;
  Progress& progress_;
  Clock::time_point start_ = Clock::now();
  AccuracySummary found_;
  std::vector<FactorGroup> kinds_;
  std::size_t tips_ = 0, vectors_ = 0;
  double thickness_ = 0;
};

}  // namespace

std::string end_of_search(const plate::Problem& problem, double size, const SizeOfStep& last, double spent,
                          double most) {
  if (size < least_size && problem.discretization.formulation->offers(plate::Feature::graded_points))
    return "the finest discretisation of this program";
  if (beyond_memory(size, last, 0)) return "memory";
  if (beyond_time(size, last, spent, most)) return "`seconds`";
  return "";
}

AccuracyFound refine(const SrifOptions& options, const Solve& solve, Progress& progress) {
  return Search(options, solve, progress).run();
}

FactorsFound rows_of(AccuracyFound found, const std::optional<std::vector<double>>& truncated,
                     const SrifOptions& options, double thickness) {
  auto& finest = found.summary.path.back();
  FactorsFound result{std::move(finest.rows), std::move(finest.rows_in_plane)};
  if (truncated) add_truncation(*truncated, found.refined, result.rows, thickness);
  put_first(std::move(found.refined), result.rows, options, thickness);
  put_first(std::move(found.refined_in_plane), result.in_plane, options, thickness);
  return result;
}

std::vector<std::string> warnings_about(const AccuracySummary& found) {
  if (found.ended_by.empty()) return {};
  return {fmt::format("`accuracy` = {:g} not reached, estimated error {}: ended by {}; set `accuracy` larger",
                      found.asked, found.reached ? fmt::format("{:.2g}", *found.reached) : "unknown", found.ended_by)};
}

}  // namespace post
