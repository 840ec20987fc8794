#pragma once
#include <functional>
#include <variant>

#include "post/files/summary.hpp"

namespace plate {
class Formulation;
struct Discretization;
struct Problem;
}  // namespace plate

namespace post {

class Progress;

/// The lengths of the discretisation of a path to a stated accuracy: those far from tips and holes and their growth
/// `size` times those of the first, those at tips by its square (theory.md, "To a stated accuracy"). In motion waves
/// have to cross the plate.
plate::Discretization discretization_of(const plate::Problem& problem, bool moves, double size);

/// The lengths of a path to a stated accuracy of results other than factors, of a plate that does not move: those of
/// discretization_of(), also where there are no tips, as free and softly supported edges and re-entrant corners then
/// have closer points too; of a formulation without graded points the spacing alone.
plate::Discretization discretization_for_results(const plate::Problem& problem, double size);

/// Reason that forbids a finer discretisation of a plate that does not move; empty where there is none.
/// `size`: its own, of discretization_for_results(). `last`: the one before. `spent`, `most`: time of the search so far
/// and at most [s].
struct SizeOfStep {
  double size;
  std::size_t points;
  double seconds;
};
std::string end_of_search(const plate::Problem& problem, double size, const SizeOfStep& last, double spent,
                          double most);

/// Results of one discretisation of a search.
struct AccuracyTrial {
  const plate::Formulation* plate;
  std::vector<std::vector<Srif>> rows;                // at all times; of a static case one
  std::vector<double> truncated;                      // of every tip of a plate in motion: LanczosMotion::truncated()
  double strain_energy;                               // the largest
  std::size_t vectors;                                // of Lanczos
  std::vector<std::vector<Srif>> rows_in_plane = {};  // N1 and N2 as K1 and K2, where loads act there ...
  double energy_in_plane = 0;                         // ... and the strain energy
};

/// Reason why a discretisation is infeasible: points that are too coarse may not do where finer ones do.
struct Infeasible {
  std::string why;
};

/// A discretisation of a size, solved.
using Solve = std::function<std::variant<AccuracyTrial, Infeasible>(double size)>;

struct AccuracyFound {
  AccuracySummary summary;                 // without a path where no discretisation could be had
  std::vector<std::vector<Srif>> refined;  // what all discretisations tend to, for each tip at all times
  std::vector<std::vector<Srif>> refined_in_plane;
};

/// Refines until every factor is known to options.accuracy, or time, memory or sizes end it (theory.md, "To a stated
/// accuracy"). The factors are those of best_of(): a finer wish never gives less than a coarser one. `solve`: with the
/// lengths of discretization_of() at a size; the plate of a trial lives until the next one. Throws
/// plate::NumericalError where the first trial does.
AccuracyFound refine(const SrifOptions& options, const Solve& solve, Progress& progress);

/// Rows of the search: for each tip the limit of all discretisations, then those of the finest; without rows in the
/// plane where no load acts there.
struct FactorsFound {
  std::vector<std::vector<Srif>> rows, in_plane;
};

/// `truncated`: what the vectors of the finest discretisation leave out of a motion.
FactorsFound rows_of(AccuracyFound found, const std::optional<std::vector<double>>& truncated,
                     const SrifOptions& options, double thickness);

/// Warnings that the accuracy was not reached, and what ended the search.
std::vector<std::string> warnings_about(const AccuracySummary& found);

}  // namespace post
