#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"

namespace plate {
class Formulation;
struct Surroundings;
}  // namespace plate

namespace post {
struct Peak;
struct Srif;
}  // namespace post

namespace fracture {

/// Numbers of the points of a plate, equal on all ranks and ascending by the rows of the lattice. Where one process
/// holds the whole plate, the local indices.
class PointNumbers {
public:
  /// `boundary` must outlive this.
  explicit PointNumbers(const plate::Boundary& boundary);

  std::uint32_t of(std::uint32_t k) const;
  /// Local index of the point; nothing where this rank does not know it.
  std::optional<std::uint32_t> point(std::uint32_t number) const { return index_ ? index_->at(place(number)) : number; }
  /// [lattice units]
  geometry::Point place(std::uint32_t number) const;

private:
  const plate::Boundary& boundary_;
  std::optional<geometry::CellIndex> index_;  // where the plate is distributed
  std::uint32_t columns_ = 0;
};

/// Surroundings that a rank knows of a plate whose bonds break, beside its owned points: all that decides about its
/// bonds, or whatever tips need (`tips`), as they may come anywhere. Null where one process holds the whole plate.
std::shared_ptr<const plate::Surroundings> overlap_of_growth(const plate::Formulation& start, bool tips);

/// The factors that all processes have found, by tips.
std::vector<post::Srif> of_all(const plate::Formulation& plate, std::vector<post::Srif> own);
/// Largest value of every quantity over all ranks, and its place.
std::vector<post::Peak> of_all(const plate::Formulation& plate, std::vector<post::Peak> own);

}  // namespace fracture
