#include <algorithm>
#include <unordered_map>

#include "post/factors/tip_integrals.hpp"

namespace post {
namespace {

using geometry::Point;

/// The energy of the Galerkin plate's families about the ring, at two positions of the tip one step before and after.
class MovedPoints : public EnergyRelease {
public:
  MovedPoints(const BondedPlate& plate, const TipFrame& frame, const Ring& ring)
      : section_(plate.section), step_(1e-4 * plate.spacing) {
    geometry::Tessellation about{plate.cells->units, plate.cells->graded, {}, {}, {}, {}, {}, {}};
    std::unordered_map<std::uint32_t, std::uint32_t> index;
    const auto near = [&](const auto& cell) {
      return std::any_of(cell.begin(), cell.end(),
                         [&](auto k) { return (plate.positions[k] - frame.origin).norm() < 2 * ring.outer; });
    };
    const auto add = [&](const auto& cell, auto& cells) {
      if (!near(cell)) return;
      auto own = cell;
      for (auto& k : own) {
        const auto [entry, fresh] = index.try_emplace(k, std::uint32_t(points_.size()));
        if (fresh) points_.push_back(k);
        k = entry->second;
      }
      cells.push_back(own);
    };
    for (const auto& square : plate.cells->squares) add(square, about.squares);
    for (const auto& triangle : plate.cells->triangles) add(triangle, about.triangles);

    std::vector<double> extension;
    for (const auto k : points_) extension.push_back(ring.extension((plate.positions[k] - frame.origin).norm()));
    for (const int sign : {1, -1}) {
      about.local.clear();
      for (std::size_t i = 0; i < points_.size(); ++i)
        about.local.push_back(plate.cells->local[points_[i]] + sign * step_ * extension[i] * frame.ahead);
      moved_[sign > 0 ? 0 : 1] = plate::moved_galerkin_families(about);
    }
    find_changed(extension);
  }

  double operator()(const NearField& u) const override {
    plate::State state(3, Eigen::Index(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto own = u(points_[i]);
      state.col(Eigen::Index(i)) << own.w, own.theta_x, own.theta_y;
    }
    double sum = 0;
    for (const auto i : changed_)
      sum += plate::family_energy(moved_[1], section_, i, state) - plate::family_energy(moved_[0], section_, i, state);
    return sum / (2 * step_);
  }

private:
  /// Points whose families, or the areas of their members, are not only carried along.
  void find_changed(const std::vector<double>& extension) {
    const auto& families = moved_[0].families;
    std::vector<char> deformed(points_.size(), 0);
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const auto& bond : families[i]) deformed[i] = deformed[i] || extension[bond.neighbour] != extension[i];
    for (std::size_t i = 0; i < points_.size(); ++i) {
      bool changed = deformed[i];
      for (const auto& bond : families[i]) changed = changed || deformed[bond.neighbour];
      if (changed) changed_.push_back(i);
    }
  }

  plate::Section section_;
  double step_;
  std::vector<std::uint32_t> points_;  // of the plate, by the numbers of the moved families
  plate::GalerkinFamilies moved_[2];   // one step ahead, one step back
  std::vector<std::size_t> changed_;
};

}  // namespace

std::unique_ptr<EnergyRelease> moved_points(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<MovedPoints>(plate, frame, ring);
}

}  // namespace post
