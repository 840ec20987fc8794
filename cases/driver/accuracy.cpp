#include "cases/driver/accuracy.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/driver/lanczos.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/driver/static_solution.hpp"
#include "cases/input/accuracy_path.hpp"
#include "cases/input/case_file.hpp"
#include "cases/report/progress.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "plate/model/free_memory.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/factors/tip_integrals.hpp"
#include "post/files/gate.hpp"

namespace cases {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double doubles_the_points = std::numbers::sqrt2;  // of the size
constexpr double least_size = 0.0715;                       // of spacing_growth 0.02, the least that a case may ask for

/// Bytes that a run takes: measured 17 kB per point at 8,000 and 39,000 points, 18 at 85,000, most of them of the
/// factor; in motion `vectors` of Lanczos beside, with their forces and the modes.
double bytes_of(std::size_t points, std::size_t vectors) {
  return (18e3 + 3 * 3 * 8 * double(vectors)) * double(points);
}

CaseFile with_size(const CaseFile& file, double size) {
  CaseFile result = file;
  Case& c = result.content;
  c.discretization = discretization_of(file.content, size);
  // static factors are to be known far better than by the default tolerance; in motion they are watched themselves
  if (c.analysis.kind == Analysis::Kind::static_) c.analysis.tolerance = std::min(c.analysis.tolerance, 1e-8);
  c.srif->first_ring_only = true;  // errors come from the path
  return result;
}

/// What one discretisation gives.
struct Found {
  std::vector<std::vector<post::Srif>> rows;
  std::vector<double> truncated;  // in motion
  double strain_energy;           // the largest
};

Found in_statics(Prepared& plate) {
  const Case& c = plate.file.content;
  plate.solution = static_solution(c, *plate.plate, {c.analysis.tolerance, c.analysis.max_iterations, {}});
  const auto& solution = plate.solution->solution;
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("on the way to srif.accuracy, {} points: {}, residual {:.2e}",
                                            plate.plate->points(), solution.stop_reason, solution.residual));
  plate.stopwatch.lap("solve");
  Found result{{post::srifs(*plate.plate, *c.srif, plate.tip_methods, solution.state)},
               {},
               plate.plate->strain_energy(solution.state)};
  plate.stopwatch.lap("srif");
  return result;
}

Found in_motion(Prepared& plate) {
  constexpr double of_truncation = 0.3;  // of the accuracy
  const Case& c = plate.file.content;
  plate.motion.emplace(lanczos_motion(c, *plate.plate, plate.tip_methods, of_truncation * *c.srif->accuracy, {}));
  Found result{{}, plate.motion->truncated(), 0};
  plate.motion->observe(plate.steps->grid.steps, [&](const plate::Instant& now) {
    plate.stopwatch.lap("solve");
    result.rows.push_back(post::srifs(*plate.plate, *c.srif, plate.tip_methods, now.state, false));
    result.strain_energy = std::max(result.strain_energy, now.strain_energy);
    plate.stopwatch.lap("srif");
  });
  return result;
}

Found solve(Prepared& plate) {
  const bool moves = plate.file.content.analysis.kind == Analysis::Kind::dynamic;
  Found result = moves ? in_motion(plate) : in_statics(plate);
  for (const auto& row : result.rows) post::require_finite(row, "on the way to srif.accuracy");
  return result;
}

post::AccuracyStep step_of(double size, const Prepared& plate, Found found, double seconds) {
  const auto& d = plate.file.content.discretization;
  const Case& c = plate.file.content;
  const double layer = c.section.layer();
  const double clear = post::least_clear_distance(c, plate.plate->paths(), plate.plate->tips());
  const double faces = std::min(d.spacing, *d.tip_spacing + d.spacing_growth * clear) / layer;
  return {size,
          plate.plate->cloud().plate_points,
          d.spacing,
          *d.tip_spacing,
          d.hole_spacing,
          d.spacing_growth,
          faces,
          seconds,
          std::move(found.rows),
          std::move(found.truncated),
          std::nullopt};
}

/// K1 of a crack that releases the whole energy of the plate over its smaller side.
double nominal_factor(const Case& c, double strain_energy) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  return std::sqrt(strain_energy / (high - low).minCoeff() / post::unit_release(c.section)[0]);
}

/// Where one step that doubles the number of points does not suffice by far, two at once.
double next_size(double size, const std::optional<double>& error, double asked) {
  constexpr double enough = 3.5;
  const bool far = error && *error > enough * asked;
  return size / (far ? 2 : doubles_the_points);
}

/// What forbids to go on to a smaller size; empty where nothing does.
std::string end_before(double size, const std::vector<post::AccuracyStep>& path, std::size_t vectors, double seconds,
                       const post::SrifOptions& options) {
  if (size < least_size) return "the finest discretisation of this program";
  const auto& last = path.back();
  const double ratio = std::pow(last.size / size, 2);
  const double free = plate::free_memory();
  if (free > 0 && bytes_of(std::size_t(ratio * double(last.points)), vectors) > free / 2) return "memory";
  constexpr double order = 1.3;  // of the time, in the number of points: measured 1.1 to 1.4
  if (seconds + last.seconds * std::pow(ratio, order) > options.accuracy_seconds) return "srif.accuracy_seconds";
  return "";
}

/// Adds what Lanczos vectors leave out to the errors of tips without refined factors, in which it is.
void add_truncation(const std::vector<double>& truncated, const std::vector<std::vector<post::Srif>>& refined,
                    std::vector<std::vector<post::Srif>>& rows, double thickness) {
  std::vector<double> largest(truncated.size(), 0);
  for (const auto& row : rows)
    for (const auto& srif : row)
      if (!post::of_opening(srif.method))
        largest[srif.tip] = std::max(largest[srif.tip], post::largest_factor(srif, thickness));
  for (auto& row : rows)
    for (auto& srif : row)
      if (refined.empty() || std::ranges::find(refined.front(), srif.tip, &post::Srif::tip) == refined.front().end())
        post::widen(srif, truncated[srif.tip] * largest[srif.tip], thickness);
}

/// Puts the refined factors of every tip before those of the finest discretisation, whose errors they tell.
void put_first(std::vector<post::Srif> refined, std::vector<post::Srif>& row, const post::SrifOptions& options,
               double thickness) {
  for (auto& best : refined) {
    post::normalize(best, options, thickness);
    for (auto& srif : row)
      if (srif.tip == best.tip) post::refer_to(best, srif, thickness);
    row.insert(std::ranges::find(row, best.tip, &post::Srif::tip), std::move(best));
  }
}

void warn_of_given_lengths(const CaseFile& file, std::vector<std::string>& warnings) {
  std::string given;
  for (const char* name : {"spacing", "tip_spacing", "hole_spacing", "spacing_growth"})
    for (const auto& [key, where] : file.places)
      if (key == fmt::format("discretization.{}", name)) given += (given.empty() ? "" : ", ") + std::string(name);
  if (!given.empty())
    warnings.push_back(
        fmt::format("srif.accuracy finds the lengths of the discretisation: {} of the case not used", given));
}

/// What is said of the search, and its rows. `refined`: judged.
void conclude(const CaseFile& file, std::vector<std::vector<post::Srif>> refined, Accurate& result) {
  const auto& options = *file.content.srif;
  const double h = file.content.section.thickness;
  auto& [plate, found, rows] = result;
  found.reached = found.path.back().error;
  auto& warnings = plate->warnings;
  if (found.outcome != "reached")
    warnings.push_back(fmt::format("srif.accuracy = {:g} not reached, estimated error {}: ended by {}", found.asked,
                                   found.reached ? fmt::format("{:.2g}", *found.reached) : "unknown", found.outcome));
  warn_of_given_lengths(file, warnings);
  rows = found.path.back().rows;
  if (plate->motion) add_truncation(plate->motion->truncated(), refined, rows, h);
  for (std::size_t row = 0; row < refined.size(); ++row) put_first(std::move(refined[row]), rows[row], options, h);
}

}  // namespace

Accurate to_accuracy(const CaseFile& file, bool quiet) {
  const auto& options = *file.content.srif;
  const double h = file.content.section.thickness;
  const auto start = Clock::now();
  Accurate result;
  auto& plate = result.plate;
  auto& found = result.found;
  found.asked = *options.accuracy;
  Progress progress(quiet, "srif.accuracy");
  plate::Stopwatch before;
  std::optional<CaseError> refused;  // the coarsest points
  double nominal = 0;
  std::vector<std::vector<post::Srif>> refined;
  for (double size = 1; found.outcome.empty();) {
    const auto begin = Clock::now();
    constexpr double first_sizes = 0.2;
    std::unique_ptr<Prepared> next;
    Found of_next;
    try {
      next = std::make_unique<Prepared>(with_size(file, size));
      of_next = solve(*next);
    } catch (const CaseError& error) {
      const auto& key = error.problems().front().key;
      if (key == "srif.accuracy" || key.starts_with("analysis.") || key.starts_with("output.")) throw;
      // such coarse points may not do where finer ones do
      if (!refused) refused = error;
      if (!plate && size < first_sizes) throw *refused;
      if (plate) found.outcome = fmt::format("what forbids the next discretisation: {}", error.problems().front().what);
      size /= doubles_the_points;
      continue;
    } catch (const plate::NumericalError& error) {
      if (!plate) throw;
      found.outcome = error.what();
      continue;
    }
    if (plate) before.add(plate->stopwatch);
    plate = std::move(next);
    nominal = nominal_factor(plate->file.content, of_next.strain_energy);
    found.path.push_back(
        step_of(size, *plate, std::move(of_next), std::chrono::duration<double>(Clock::now() - begin).count()));
    refined = post::refined(found.path, h);
    const auto error = found.path.back().error = post::largest_error(refined, plate->plate->tips().size(), h, nominal);
    progress.update(std::min(0.99, error ? found.asked / *error : 0),
                    fmt::format("{} points, {}", found.path.back().points,
                                error ? fmt::format("estimated error {:.2g} %", 100 * *error) : "no estimate yet"));
    if (error && *error <= found.asked) found.outcome = "reached";
    if (!found.outcome.empty()) break;
    size = next_size(size, error, found.asked);
    found.outcome = end_before(size, found.path, plate->motion ? plate->motion->vectors() : 0,
                               std::chrono::duration<double>(Clock::now() - start).count(), options);
  }
  progress.done();
  plate->stopwatch.add(before);
  post::judge(refined, h, nominal);
  conclude(file, std::move(refined), result);
  return result;
}

}  // namespace cases
