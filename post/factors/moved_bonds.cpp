#include "plate/bonds/parameters/position_aware.hpp"
#include "post/factors/tip_integrals.hpp"

#include <algorithm>

namespace post {
namespace {

using geometry::Point;

/// The plate's energy in the bonds of the ring, at two positions of the tip one step before and after.
class MovedBonds : public EnergyRelease {
public:
  MovedBonds(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
    const double step = 1e-4 * plate.spacing;
    const auto extension = [&](std::uint32_t k) { return ring.extension((plate.positions[k] - frame.origin).norm()); };
    double longest = 0;
    for (const auto& shape : plate.shapes) longest = std::max(longest, shape.length);
    for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
      const Point x = plate.positions[k] - frame.origin;
      if (x.norm() < ring.inner - longest || x.norm() > ring.outer + longest) continue;
      const double divergence = x.norm() > 0 ? ring.slope(x.norm()) * x.dot(frame.ahead) / x.norm() : 0;
      const double own = extension(k);
      bool moves = divergence != 0;
      for (const auto& bond : plate.families[k]) moves = moves || extension(bond.neighbour) != own;
      if (!moves) continue;
      for (const int sign : {1, -1}) {
        std::vector<plate::FamilyBond> bonds;
        for (const auto [j, id] : plate.families[k])
          bonds.push_back({plate.families.vectors()[id] + sign * step * (extension(j) - own) * frame.ahead,
                           plate.shapes[id].weight * plate.areas[j]});
        const auto weights = plate::position_aware(plate.section, bonds);
        const double share = -sign * plate.areas[k] * (1 + sign * step * divergence) / (2 * step);
        RingPoint point{k, share, weights.a, bonds_.size(), 0};
        for (std::size_t i = 0; i < bonds.size(); ++i) {
          const double length = bonds[i].vector.norm();
          bonds_.push_back({plate.families[k][i].neighbour, bonds[i].vector.y() / length,
                            -bonds[i].vector.x() / length, length, weights.bonds[i]});
        }
        point.end = bonds_.size();
        points_.push_back(point);
      }
    }
  }

  double operator()(const NearField& u) const override {
    double sum = 0;
    for (const auto& point : points_) {
      const auto own = u(point.k);
      double energy = 0, dilatation = 0;
      for (auto b = point.begin; b < point.end; ++b) {
        const Bond& bond = bonds_[b];
        const auto other = u(bond.j);
        const double curvature = curvature_difference(bond, own, other);
        dilatation += bond.weights.D * curvature;
        energy += plate::bond_energy(bond.weights.B, bond.weights.S, curvature, shear_difference(bond, own, other));
      }
      sum += point.share * (energy + point.a * dilatation * dilatation);
    }
    return sum;
  }

private:
  struct Bond {
    std::uint32_t j;
    double mx, my, length;
    plate::BondWeights weights;
  };
  struct RingPoint {
    std::uint32_t k;
    double share, a;  // share: of its energy in -dU/da
    std::size_t begin, end;
  };
  std::vector<RingPoint> points_;
  std::vector<Bond> bonds_;
};

}  // namespace

std::unique_ptr<EnergyRelease> moved_bonds(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<MovedBonds>(plate, frame, ring);
}

}  // namespace post
