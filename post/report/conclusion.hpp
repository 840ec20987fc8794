#pragma once
#include <optional>
#include <string>
#include <vector>

#include "plate/model/state.hpp"
#include "post/files/summary.hpp"

namespace plate {
class Formulation;
struct Heat;
struct Instant;
struct Problem;
struct Resultants;
struct StaticSolution;
}  // namespace plate

namespace post {

class ReactionRows;
struct Table;

/// Peaks of a motion: K1, K2, K3 and, with a toughness, its utilisation, of every tip by its recommended method, where
/// they are resolved; none of a quantity that may be larger where it is not. `rows` of factors at `times`.
std::vector<Peak> peaks(const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows,
                        const plate::Section& section, std::optional<double> toughness);

/// Deflection over thickness beyond which plates stretch: a clamped circular plate is 12 % stiffer there (Timoshenko: w
/// + 0.488 w^3).
constexpr double small_deflection = 0.5;

/// Largest deflection and von Mises stress (of both faces, which have the same) of a run on one plate, and their
/// places. Stress is looked at in frames and where the strain energy of all rows is largest: at every row it would cost
/// more than the row. It grows without limit towards tips, sharp corners, pins and point forces: what is nearer to one
/// than half the thickness, where a plate's theory has no stresses, or than four spacings, or than a given distance,
/// does not count.
class Extremes {
public:
  /// `plate` must outlive this.
  explicit Extremes(const plate::Formulation& plate, std::optional<double> distance = {})
      : plate_(&plate), distance_(distance) {}

  void row(const plate::Instant& now);
  void frame(double time, const plate::Resultants& resultants);

  /// w, then von_mises; nothing without rows. `heat`: of the only row, where it is not that of its time.
  std::vector<Peak> found(const plate::Heat* heat = nullptr) const;

  /// The state of the row with the largest strain energy; empty before the first.
  plate::State& state() { return state_; }
  double time() const { return time_; }  // of that row
  /// Peaks found so far, of the deflection and of stress in frames; the second function sets them.
  std::vector<Peak> so_far() const;
  void so_far(const std::vector<Peak>& peaks);

  /// Archives what all ranks know: not state(), whose values go with the points.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(deflection_, stress_, strain_energy_, time_, seen_);
  }

private:
  Peak largest_stress(double time, const plate::Resultants& resultants) const;

  const plate::Formulation* plate_;
  std::optional<double> distance_;  // [length]
  std::optional<Peak> deflection_, stress_;
  // of the row with the largest strain energy
  double strain_energy_ = -1, time_ = 0;
  plate::State state_;
  std::optional<double> seen_;  // time of the last frame
};

/// Sets the fields of a summary that describe a static solution.
void describe(Summary::Analysis& analysis, const std::string& method, const plate::StaticSolution& solution,
              double tolerance);

/// Says how far linear theory is off, where the estimate (Summary::linear_theory_off) matters; empty otherwise.
std::string error_of_linear_theory(std::optional<double> estimated);

/// Results of a run.
struct Found {
  const plate::Section& section;
  const std::optional<SrifOptions>& options;  // of the case
  bool si;                                    // numbers are in SI units
  const Table& history;
  const ReactionRows& reactions;
  std::vector<Srif> factors;  // at the end
  bool stretches = false;     // the middle plane, with the deflections
  bool may_stretch = true;    // `nonlinear` = true would be accepted
};

/// Sets what summaries of all runs say alike: factors, at the faces too, reactions, the largest deflection, and warns
/// where a plate bends farther than small deflections reach, by the estimate of the summary where it has one: in SI
/// units only, cases without units may be scaled.
void conclude(Summary& summary, Found found);

/// A warning of reactions that are not in balance with the loads where springs of hubs are soft: the rounding of the
/// stiffness resists rigid motions as springs of the size 1e-14 of its entries do.
std::vector<std::string> unbalanced_hubs(const std::optional<ReactionSummary>& reactions,
                                         const plate::Problem& problem);

/// A warning of the point support whose reaction makes deflections grow most without limit as points get closer: by
/// R / (alpha S) log 2 with every halving of the spacing, alpha the angle of the plate about it. None below a share of
/// the `largest` deflection.
std::vector<std::string> sinking_supports(const std::optional<ReactionSummary>& reactions,
                                          const plate::Problem& problem, double largest);

/// Adds the largest values of a run on one plate to the summary, in motion with times. `found` by its Extremes; `rows`
/// of factors at `times`.
void look_for_largest(Summary& summary, const plate::Section& section, std::vector<Peak> found,
                      const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows);

/// Adds a warning where a utilisation is 1 or more. `when`: of what load or time; may be empty.
void tell_growth(std::size_t tip, double utilisation, const std::string& when, std::vector<std::string>& warnings);

/// Names the tips at which a crack would grow: those that reach the toughness, at the end or, in motion, at any time.
std::vector<std::string> tips_that_grow(const Summary& summary);

}  // namespace post
