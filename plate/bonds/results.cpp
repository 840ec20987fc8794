#include "plate/bonds/results.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/cells/drawn_cells.hpp"
#include "plate/bonds/family_weights.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/dense_algebra.hpp"

namespace plate {
namespace {

/// Weights of the points that a corner sees. Points on one line, or nearly, extend no linear field across it: then the
/// mean.
Mesh::Corner corner(const geometry::DrawnCells::Corner& from, const Boundary& boundary) {
  constexpr double largest = 3;  // weight; beside a straight edge 1.5
  const geometry::Point at = boundary.cloud.units.to_units(from.position);
  std::vector<std::pair<std::uint32_t, geometry::Point>> near;
  for (const auto k : from.seen) near.emplace_back(k, boundary.lattice[k]);
  Mesh::Corner result{from.position, {}};
  double sum = 0, linear = 0;
  for (const auto& share : interpolation(near, at)) {
    const double mean = 1 / ((boundary.lattice[share.point] - at).squaredNorm() + 1e-6);
    result.sources.push_back({share.point, share.weight, mean});
    sum += mean, linear += share.weight;
  }
  for (auto& source : result.sources) source.mean /= sum;
  const auto is_large = [](const Mesh::Source& source) { return std::abs(source.linear) > largest; };
  if (std::abs(linear - 1) > 1e-6 || std::ranges::any_of(result.sources, is_large))
    for (auto& source : result.sources) source.linear = source.mean;
  return result;
}

}  // namespace

Mesh mesh(const Boundary& boundary, const geometry::Outline& outline, const std::vector<geometry::CrackPath>& cracks,
          std::vector<double> cut, double thickness) {
  const auto count = std::ptrdiff_t(boundary.cloud.plate_points);
  const auto& [units, positions, areas, plate_points, part] = boundary.cloud;
  Mesh result{{positions.begin(), positions.begin() + count},
              {areas.begin(), areas.begin() + count},
              std::move(cut),
              {},
              {},
              units.spacing,
              thickness};
  try {
    auto cells =
        geometry::drawn_cells(outline, cracks, units, {boundary.lattice.begin(), boundary.lattice.begin() + count});
    for (const auto& one : cells.corners) result.corners.push_back(corner(one, boundary));
    result.quads = std::move(cells.squares), result.triangles = std::move(cells.triangles);
  } catch (const std::logic_error&) {  // no cells can be drawn: the mesh has points alone
    result.corners.clear();
  }
  return result;
}

Gradients gradients(std::size_t k, const State& state, const geometry::Families& families,
                    const std::vector<BondShape>& shapes, const std::vector<double>& areas) {
  const auto kinematics = [&](std::size_t i) {
    const auto u = state.col(static_cast<Eigen::Index>(i));
    return Kinematics<>{u[0], u[1], u[2]};
  };
  const Kinematics<> own = kinematics(k);
  Gradients sum;
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
  for (const auto [j, id] : families[k]) {
    const BondShape& bond = shapes[id];
    const Kinematics<> other = kinematics(j);
    const Eigen::Vector2d xi = families.vectors()[id] * (bond.weight * areas[j]);
    shape += xi * families.vectors()[id].transpose();
    sum.theta += Eigen::Vector2d(other.theta_x - own.theta_x, other.theta_y - own.theta_y) * xi.transpose();
    sum.shear += xi * shear_difference(bond, own, other);
  }
  // a family on one line has no gradient across it: the least-norm inverse leaves it zero
  const double trace = shape.trace();
  const bool regular = shape.determinant() > 1e-8 * trace * trace;
  const Eigen::Matrix2d inverse =
      regular ? Eigen::Matrix2d(shape.inverse()) : Eigen::Matrix2d(pseudo_inverse(shape).inverse);
  return {sum.theta * inverse, inverse * sum.shear};
}

Resultants resultants(const State& state, const geometry::Families& families, const std::vector<BondShape>& shapes,
                      const std::vector<double>& areas, std::size_t plate_points, const Section& section) {
  const auto count = static_cast<Eigen::Index>(plate_points);
  Resultants result = resultants_of(count);
  const LocalSection local(section);
  const double S = section.shear_stiffness();
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const Gradients g = gradients(static_cast<std::size_t>(k), state, families, shapes, areas);
    set(result, k, local, g.theta, S * g.shear);
  }
  return result;
}

namespace {

using geometry::Point;

/// The plate's energy in the bonds of the ring, at two positions of the tip one step before and after.
class BondEnergyRelease : public EnergyRelease {
public:
  BondEnergyRelease(const TipView& plate, const TipFrame& frame, const Ring& ring) {
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
        std::vector<FamilyBond> bonds;
        // along a curve the axes of a point turn with it: by how much the other one turns more
        std::vector<double> turns;
        for (const auto [j, id] : plate.families[k]) {
          const double more = sign * step * (extension(j) - own);
          bonds.push_back({plate.families.vectors()[id] + more * frame.velocity(plate.positions[j]),
                           plate.shapes[id].weight * plate.areas[j]});
          turns.push_back(more * frame.curvature);
        }
        const auto weights = position_aware(plate.section, bonds);
        const double share = -sign * plate.areas[k] * (1 + sign * step * divergence) / (2 * step);
        RingPoint point{k, share, weights.a, bonds_.size(), 0};
        for (std::size_t i = 0; i < bonds.size(); ++i) {
          const double length = bonds[i].vector.norm();
          bonds_.push_back({.j = plate.families[k][i].neighbour,
                            .mx = bonds[i].vector.y() / length,
                            .my = -bonds[i].vector.x() / length,
                            .length = length,
                            .turn = turns[i],
                            .weights = weights.bonds[i]});
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
        auto other = u(bond.j);
        if (bond.turn != 0)
          other = {other.w, other.theta_x - bond.turn * other.theta_y, other.theta_y + bond.turn * other.theta_x};
        const double curvature = curvature_difference(bond, own, other);
        dilatation += bond.weights.D * curvature;
        energy += bond_energy(bond.weights.B, bond.weights.S, curvature, shear_difference(bond, own, other));
      }
      sum += point.share * (energy + point.a * dilatation * dilatation);
    }
    return sum;
  }

private:
  struct Bond {
    std::uint32_t j;
    double mx, my, length;
    double turn;  // of the rotations of j [rad]
    BondWeights weights;
  };
  struct RingPoint {
    std::uint32_t k;
    double share, a;  // share: of its energy in -dU/da
    std::size_t begin, end;
  };
  std::vector<RingPoint> points_;
  std::vector<Bond> bonds_;
};

/// Gradient shares by the bonds no longer than `reach` spacings; nothing where they do not determine linear and
/// quadratic terms.
std::optional<GradientShares> quadratic_shares(const TipView& plate, std::uint32_t k, double reach) {
  const auto& families = plate.families;
  GradientShares result;
  for (const auto& bond : families[k])
    if (plate.shapes[bond.vector_id].length < reach * plate.spacing) result.bonds.push_back(bond);
  const auto count = static_cast<Eigen::Index>(result.bonds.size());
  if (count < 5) return std::nullopt;
  Eigen::MatrixXd basis(count, 5);
  Eigen::VectorXd weight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point x = families.vectors()[result.bonds[std::size_t(i)].vector_id] / plate.spacing;
    basis.row(i) << x.x(), x.y(), x.x() * x.x(), x.x() * x.y(), x.y() * x.y();
    weight[i] = 1 / x.squaredNorm();
  }
  const auto [inverse, rank] = pseudo_inverse(weight.asDiagonal() * basis);
  if (rank < 5) return std::nullopt;
  result.share = inverse.topRows(2) * weight.asDiagonal() / plate.spacing;
  return result;
}

}  // namespace

BondView::BondView(const geometry::Cloud& cloud, const geometry::Families& their_families,
                   const std::vector<BondShape>& their_shapes, const Section& its_section,
                   const Discretization& discretization)
    : TipView(cloud.positions, cloud.areas, their_families, their_shapes, cloud.plate_points, its_section) {
  constexpr double doubtful_of_bonds = 0.3;  // spacings: the lattice, not the line, tells which side points are on
  spacing = discretization.spacing_at_tips(), horizon = discretization.horizon();
  graded = points_on_faces = false;
  doubtful = doubtful_of_bonds * spacing;
  // in the plane, oblique cracks of 4 to 17 spacings: N2 up to 1.5 times as far off as by the weight of bending
  const double near = section.law == PlateLaw::membrane ? 0.25 : 0.1;
  trust = {0.4, 0.4, 1.6, 2, near, 0.2, horizon / 2, 0.1, 0.03, false, 0.08, 0.2};
}

Gradients BondView::gradients(std::uint32_t k, const State& state) const {
  return plate::gradients(k, state, families, shapes, areas);
}

/// Gradient shares from the nearest neighbours that suffice: the layer beside a face is as thin as a few spacings.
GradientShares BondView::gradient_shares(std::uint32_t k) const {
  for (const double reach : {1.5, 2.1, 3.0, 100.0})
    if (auto found = quadratic_shares(*this, k, reach)) return *found;
  GradientShares linear;
  Eigen::MatrixXd basis(Eigen::Index(families[k].size()), 2);
  for (const auto& bond : families[k]) {
    basis.row(Eigen::Index(linear.bonds.size())) = families.vectors()[bond.vector_id].transpose();
    linear.bonds.push_back(bond);
  }
  linear.share = pseudo_inverse(basis).inverse;
  return linear;
}

Point BondView::extension_slope(std::uint32_t k, const TipFrame& frame, const Ring& ring) const {
  const Point x = positions[k] - frame.origin;
  return x.norm() > 0 ? Point(ring.slope(x.norm()) / x.norm() * x) : Point(0, 0);
}

Eigen::Matrix2d BondView::shear_stiffness(std::uint32_t) const {
  return section.shear_stiffness() * Eigen::Matrix2d::Identity();
}

std::unique_ptr<EnergyRelease> BondView::virtual_extension(const TipFrame& frame, const Ring& ring) const {
  return std::make_unique<BondEnergyRelease>(*this, frame, ring);
}

}  // namespace plate
