#include "plate/galerkin/results.hpp"

#include <algorithm>
#include <unordered_map>

#include "plate/model/problem.hpp"
#include "plate/model/space.hpp"

namespace plate {

Resultants resultants(const State& state, const GalerkinFamilies& families, const PointSections& sections) {
  const auto count = static_cast<Eigen::Index>(families.areas.size());
  Resultants result = resultants_of(count);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto strains = family_strains(families, std::size_t(k), state);
    const GalerkinStiffness stiffness(sections[std::size_t(k)], families.square(std::size_t(k)));
    Eigen::Matrix2d theta;  // psi = (-theta_y, theta_x)
    theta << strains.psi.row(1), -strains.psi.row(0);
    set(result, k, sections[std::size_t(k)], theta, stiffness.shear * strains.gamma);
  }
  return result;
}

namespace {

using geometry::Point;

/// The energy of the Galerkin plate's families about the ring, at two positions of the tip one step before and after.
class PointEnergyRelease : public EnergyRelease {
public:
  PointEnergyRelease(const TipView& plate, const geometry::Tessellation& cells, const TipFrame& frame, const Ring& ring)
      : section_(plate.section.at(frame.origin)), step_(1e-4 * plate.spacing), curvature_(frame.curvature) {
    geometry::Tessellation about{cells.units, cells.graded, {}, {}, {}, {}, {}, {}};
    std::unordered_map<std::uint32_t, std::uint32_t> index;
    const auto near = [&](const auto& cell) {
      return std::any_of(cell.begin(), cell.end(),
                         [&](auto k) { return (plate.positions[k] - frame.origin).norm() < 2 * ring.outer; });
    };
    const auto add = [&](const auto& cell, auto& into) {
      if (!near(cell)) return;
      auto own = cell;
      for (auto& k : own) {
        const auto [entry, fresh] = index.try_emplace(k, std::uint32_t(points_.size()));
        if (fresh) points_.push_back(k);
        k = entry->second;
      }
      into.push_back(own);
    };
    for (const auto& square : cells.squares) add(square, about.squares);
    for (const auto& triangle : cells.triangles) add(triangle, about.triangles);

    for (const auto k : points_) extension_.push_back(ring.extension((plate.positions[k] - frame.origin).norm()));
    for (const int sign : {1, -1}) {
      about.local.clear();
      for (std::size_t i = 0; i < points_.size(); ++i)
        about.local.push_back(cells.local[points_[i]] +
                              sign * step_ * extension_[i] * frame.velocity(plate.positions[points_[i]]));
      moved_[sign > 0 ? 0 : 1] = moved_galerkin_families(about);
    }
    find_changed();
  }

  double operator()(const NearField& u) const override {
    const State ahead = turned(u, step_ * curvature_), back = turned(u, -step_ * curvature_);
    double sum = 0;
    for (const auto i : changed_)
      sum += family_energy(moved_[1], section_, i, back) - family_energy(moved_[0], section_, i, ahead);
    return sum / (2 * step_);
  }

private:
  /// The state at the points of the ring, whose rotations turn with the extension: `angle` where that is 1 [rad].
  State turned(const NearField& u, double angle) const {
    State state(unknowns_per_point, Eigen::Index(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto own = u(points_[i]);
      const double turn = angle * extension_[i];
      state.col(Eigen::Index(i)) << own.w, own.theta_x - turn * own.theta_y, own.theta_y + turn * own.theta_x;
    }
    return state;
  }

  /// Points whose families, or the areas of their members, are not only carried along.
  void find_changed() {
    const auto& families = moved_[0].families;
    std::vector<char> deformed(points_.size(), 0);
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const auto& bond : families[i]) deformed[i] = deformed[i] || extension_[bond.neighbour] != extension_[i];
    for (std::size_t i = 0; i < points_.size(); ++i) {
      bool changed = deformed[i];
      for (const auto& bond : families[i]) changed = changed || deformed[bond.neighbour];
      if (changed) changed_.push_back(i);
    }
  }

  LocalSection section_;  // the same all over the ring
  double step_, curvature_;
  std::vector<std::uint32_t> points_;  // of the plate, by the numbers of the moved families
  std::vector<double> extension_;      // of these points
  GalerkinFamilies moved_[2];          // one step ahead, one step back
  std::vector<std::size_t> changed_;
};

}  // namespace

GalerkinView::GalerkinView(const geometry::Tessellation& cells, const GalerkinFamilies& galerkin,
                           const std::vector<geometry::Point>& seen, const std::vector<BondShape>& their_shapes,
                           const Problem& problem, const PointSections& sections)
    : TipView(seen, galerkin.areas, galerkin.families, their_shapes, seen.size(), problem.section),
      cells_(cells),
      galerkin_(galerkin),
      sections_(sections) {
  constexpr double doubtful_of_faces =
      0.05;  // spacings: rounding would tell the side, and these are the least accurate
  spacing = problem.discretization.spacing_at_tips(), horizon = problem.discretization.horizon();
  graded = cells.graded, points_on_faces = true;
  doubtful = doubtful_of_faces * spacing;
  const double near = section.law == PlateLaw::membrane ? 0.1 : 0.032;  // in the plane nothing else stands for the tip
  trust = {0.2, 0, 0.6, 1.6, near, 0.04, spacing, 0.05, 0.1, true, 0.0037};
  if (section.law == PlateLaw::membrane) trust.near_sliding = 0.17;  // N2 of oblique cracks is up to 2 times as far off
}

Gradients GalerkinView::gradients(std::uint32_t k, const State& state) const {
  const auto strains = family_strains(galerkin_, k, state);
  Gradients result{Eigen::Matrix2d(), strains.gamma};
  result.theta << strains.psi.row(1), -strains.psi.row(0);  // psi = (-theta_y, theta_x)
  return result;
}

GradientShares GalerkinView::gradient_shares(std::uint32_t k) const {
  const auto family = families[k];
  GradientShares own{{}, Eigen::Matrix2Xd(2, Eigen::Index(family.size()))};
  for (std::size_t i = 0; i < family.size(); ++i) {
    own.bonds.push_back(family[i]);
    own.share.col(Eigen::Index(i)) = galerkin_.of(k)[i].gradient;
  }
  return own;
}

/// Slope by the families, for which Gauss's theorem holds.
Point GalerkinView::extension_slope(std::uint32_t k, const TipFrame& frame, const Ring& ring) const {
  const auto extension = [&](std::uint32_t j) { return ring.extension((positions[j] - frame.origin).norm()); };
  Point slope(0, 0);
  const auto family = families[k];
  for (std::size_t i = 0; i < family.size(); ++i)
    slope += galerkin_.of(k)[i].gradient * (extension(family[i].neighbour) - extension(k));
  return slope;
}

Eigen::Matrix2d GalerkinView::shear_stiffness(std::uint32_t k) const {
  return GalerkinStiffness(sections_[k], galerkin_.square(k)).shear;
}

std::unique_ptr<EnergyRelease> GalerkinView::virtual_extension(const TipFrame& frame, const Ring& ring) const {
  return std::make_unique<PointEnergyRelease>(*this, cells_, frame, ring);
}

}  // namespace plate
