#pragma once
#include <optional>

#include "post/files/summary.hpp"

namespace plate {
class Formulation;
struct Instant;
struct Resultants;
}  // namespace plate

namespace post {

/// Where the deflection and the von Mises stress (of both faces, which have the same) of a run on one plate are
/// largest. Stress is looked at in frames and where the strain energy of all rows is largest: at every row it would
/// cost more than the row. It grows without limit towards tips, pins and point forces: what is nearer to one than half
/// the thickness, where a plate's theory has no stresses, or than four spacings, does not count.
class Extremes {
public:
  /// `plate` must outlive this.
  explicit Extremes(const plate::Formulation& plate) : plate_(&plate) {}

  void row(const plate::Instant& now);
  void frame(double time, const plate::Resultants& resultants);

  /// w, then von_mises; nothing without rows.
  std::vector<Peak> found() const;

private:
  Peak largest_stress(double time, const plate::Resultants& resultants) const;

  const plate::Formulation* plate_;
  std::optional<Peak> deflection_, stress_;
  // of the row with the largest strain energy
  double strain_energy_ = -1, time_ = 0;
  plate::State state_;
  std::optional<double> seen_;  // time of the last frame
};

}  // namespace post
