#include "plate/bonds/stretching.hpp"

#include "plate/bonds/results.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/section.hpp"

namespace plate {
namespace {

/// Values of a point by which bonds stretch: w of the plate, theta_x = -v and theta_y = u of its plane.
Kinematics<> stretched(const State& bending, const State& membrane, std::size_t k) {
  const auto i = Eigen::Index(k);
  return {bending(0, i), membrane(1, i), membrane(2, i)};
}

/// Elongation n . (u_j - u_k) + (w_j - w_k)^2 / (2 xi) of a bond k -> j.
template <typename Bond>
double elongation(const Bond& bond, const Kinematics<>& k, const Kinematics<>& j) {
  const double across = j.w - k.w;
  return across * across / (2 * bond.length) - curvature_difference(bond, k, j);
}

/// Derivative of the elongation by the values of the far end; that by those of the near end is its negative.
Eigen::Vector3d by_far_end(const PatternBond& bond, const Kinematics<>& k, const Kinematics<>& j) {
  return {(j.w - k.w) / bond.length, -bond.mx, -bond.my};
}

/// The bonds of a plate in one state: elongations, and q = 2 A a theta of every point. Its constructor is collective.
class StretchedBonds {
public:
  StretchedBonds(const FamilyOperator& plate, const State& bending, const State& membrane)
      : plate_(plate), bonds_(plate), bending_(bending), membrane_(membrane), q_(Eigen::Index(plate.points())) {
#pragma omp parallel for schedule(static)
    for (std::uint32_t k = 0; k < plate.points(); ++k) {
      double dilatation = 0;
      for (const auto& bond : bonds_.of(k)) dilatation += bond.D_kj * elongation_of(k, bond);
      q_[k] = plate.dilatation_stiffness()[k] * dilatation;
    }
    if (const auto& exchange = plate.part().exchange) exchange->fetch(std::span(q_.data(), std::size_t(q_.size())));
  }

  std::span<const PatternBond> of(std::size_t k) const {
    return bonds_.of(k);
  }
  Kinematics<> at(std::size_t k) const {
    return stretched(bending_, membrane_, k);
  }
  double elongation_of(std::uint32_t k, const PatternBond& bond) const {
    return elongation(bond, at(k), at(bond.neighbour(k)));
  }
  Eigen::Vector3d by_neighbour(std::uint32_t k, const PatternBond& bond) const {
    return by_far_end(bond, at(k), at(bond.neighbour(k)));
  }
  /// Derivative of the energy by the elongation of a bond [force].
  double force(std::uint32_t k, const PatternBond& bond) const {
    return bond.curvature * elongation_of(k, bond) + bond.D_kj * q_[k] + bond.D_jk * q_[bond.neighbour(k)];
  }
  double dilatation_stiffness(std::uint32_t k) const {
    return plate_.dilatation_stiffness()[k];
  }

private:
  const FamilyOperator& plate_;
  PointBonds bonds_;
  const State &bending_, &membrane_;
  Eigen::ArrayXd q_;
};

/// Second derivatives of the energy by the values of one point and of all that share a family with it, by the places of
/// those in a list.
class StretchedColumn {
public:
  StretchedColumn(const StretchedBonds& bonds, std::size_t points) : bonds_(bonds), place_(points) {}

  /// Finds the blocks of point k; `rows`: the points that share a family with it.
  const std::vector<Eigen::Matrix3d>& find(std::uint32_t k, std::span<const std::uint32_t> rows) {
    for (std::uint32_t i = 0; i < rows.size(); ++i) place_[rows[i]] = i;
    blocks_.assign(rows.size(), Eigen::Matrix3d::Zero());
    Eigen::Vector3d own(0, 0, 0);
    for (const auto& bond : bonds_.of(k)) {
      const auto j = bond.neighbour(k);
      const Eigen::Vector3d d = bonds_.by_neighbour(k, bond);
      Eigen::Matrix3d direct = bond.curvature * d * d.transpose();
      direct(0, 0) += bonds_.force(k, bond) / bond.length;
      at(k) += direct, at(j) -= direct;
      own -= bond.D_kj * d;
      add_dilatation(j, -bond.D_jk * d);
    }
    add_dilatation(k, own);
    return blocks_;
  }

private:
  Eigen::Matrix3d& at(std::uint32_t row) { return blocks_[place_[row]]; }
  /// Adds that of the dilatation of point p, with its derivative by the values of the point of this column.
  void add_dilatation(std::uint32_t p, const Eigen::Vector3d& by_column) {
    const Eigen::Vector3d factor = bonds_.dilatation_stiffness(p) * by_column;
    if (factor.isZero(0)) return;
    Eigen::Vector3d sum(0, 0, 0);
    for (const auto& bond : bonds_.of(p)) {
      const Eigen::Vector3d by_j = bond.D_kj * bonds_.by_neighbour(p, bond);
      sum -= by_j;
      at(bond.neighbour(p)) += by_j * factor.transpose();
    }
    at(p) += sum * factor.transpose();
  }

  const StretchedBonds& bonds_;
  std::vector<std::uint32_t> place_;
  std::vector<Eigen::Matrix3d> blocks_;
};

/// Strains xx, yy, 2 xy of the gradients of theta_x = -v and theta_y = u.
Eigen::Vector3d strain(const Eigen::Matrix2d& theta) {
  return {theta(1, 0), -theta(0, 1), theta(1, 1) - theta(0, 0)};
}

}  // namespace

Eigen::VectorXd BondStretching::energies(const State& bending, const State& membrane) const {
  Eigen::VectorXd result(bending.cols());
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const auto own = stretched(bending, membrane, std::size_t(k));
    const auto family = plate_.families()[std::size_t(k)];
    double dilatation = 0, sum = 0;
    for (std::size_t i = 0; i < family.size(); ++i) {
      const auto& weights = plate_.weights().of(std::size_t(k), i);
      const double e =
          elongation(plate_.shapes()[family[i].vector_id], own, stretched(bending, membrane, family[i].neighbour));
      dilatation += weights.D * e, sum += weights.B * e * e;
    }
    result[k] = plate_.dilatation_stiffness()[k] / 2 * dilatation * dilatation + areas_[std::size_t(k)] * sum;
  }
  return result;
}

void BondStretching::internal_force(const State& bending, const State& membrane, Forces& on_bending,
                                    Forces& on_membrane) const {
  const StretchedBonds bonds(plate_, bending, membrane);
  on_bending.setZero(unknowns_per_point, bending.cols());
  on_membrane.setZero(unknowns_per_point, membrane.cols());
#pragma omp parallel for schedule(static)
  for (std::uint32_t k = 0; k < plate_.points(); ++k) {
    Eigen::Vector3d sum(0, 0, 0);
    for (const auto& bond : bonds.of(k)) sum += bonds.force(k, bond) * bonds.by_neighbour(k, bond);
    on_bending(0, k) = sum[0];
    on_membrane.col(k).tail<2>() = sum.tail<2>();
  }
}

PointMatrix BondStretching::stiffness(const State& bending, const State& membrane) const {
  const auto points = std::uint32_t(plate_.points());
  const StretchedBonds bonds(plate_, bending, membrane);
  const auto couple = [&](Column& column, std::uint32_t k, std::uint32_t first) {
    column.couple(first + k);
    for (const auto& bond : bonds.of(k)) {
      const auto j = bond.neighbour(k);
      column.couple(first + j);
      for (const auto& next : bonds.of(j)) column.couple(first + next.neighbour(j));
    }
  };
  auto result = zeros(2 * std::size_t(points), [&](Column& column, std::uint32_t k) {
    if (k < points) couple(column, k, 0);
    couple(column, k % points, points);
  });
#pragma omp parallel
  {
    StretchedColumn column(bonds, points);
    std::vector<std::uint32_t> rows;
#pragma omp for schedule(dynamic, 64)
    for (std::uint32_t k = 0; k < points; ++k) {
      auto of_plate = result.first[k], in_plane = result.first[points + k], across = of_plate;
      while (result.row[across] < points) ++across;
      rows.assign(result.row.begin() + std::ptrdiff_t(across),
                  result.row.begin() + std::ptrdiff_t(result.first[k + 1]));
      for (auto& row : rows) row -= points;
      const auto& blocks = column.find(k, rows);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        result.block[across + i].block<2, 1>(1, 0) = blocks[i].block<2, 1>(1, 0);
        if (rows[i] < k) continue;
        result.block[of_plate++](0, 0) = blocks[i](0, 0);
        result.block[in_plane++].bottomRightCorner<2, 2>() = blocks[i].bottomRightCorner<2, 2>();
      }
    }
  }
  return result;
}

/// A matrix of zeros with the blocks of points that share a bond.
PointMatrix BondStretching::between_deflections() const {
  const PointBonds bonds(plate_);
  return zeros(plate_.points(), [&](Column& column, std::uint32_t k) {
    for (const auto& bond : bonds.of(k)) column.couple(bond.neighbour(k));
  });
}

PointMatrix BondStretching::geometric_stiffness(const State& membrane) const {
  const State flat = zero_like(membrane);
  const StretchedBonds bonds(plate_, flat, membrane);
  auto result = between_deflections();
#pragma omp parallel for schedule(static)
  for (std::uint32_t k = 0; k < plate_.points(); ++k)
    for (const auto& bond : bonds.of(k)) {
      const double across = bonds.force(k, bond) / bond.length;
      const auto j = bond.neighbour(k);
      result.block[result.first[k]](0, 0) += across;
      if (j < k) continue;
      auto at = result.first[k];
      while (result.row[at] != j) ++at;
      result.block[at](0, 0) -= across;
    }
  return result;
}

/// Stiffness by elongations less `free` times the length in every family, as force_of_curvature() has them.
PointMatrix BondStretching::stiffness_of_heat(const Eigen::VectorXd& free) const {
  auto result = between_deflections();
  const auto add = [&](std::uint32_t column, std::uint32_t row, double value) {
    auto at = result.first[column];
    while (result.row[at] != row) ++at;
    result.block[at](0, 0) += value;
  };
  for (std::uint32_t k = 0; k < free.size(); ++k) {
    const auto family = plate_.families()[k];
    double dilatation = 0;  // of unit strain
    for (std::size_t i = 0; i < family.size(); ++i)
      dilatation += plate_.weights().of(k, i).D * plate_.shapes()[family[i].vector_id].length;
    for (std::size_t i = 0; i < family.size(); ++i) {
      const auto& weights = plate_.weights().of(k, i);
      const double length = plate_.shapes()[family[i].vector_id].length;
      const double across =
          -free[k] * (plate_.dilatation_stiffness()[k] * dilatation * weights.D / length + 2 * areas_[k] * weights.B);
      const auto j = family[i].neighbour;
      add(k, k, across), add(j, j, across), add(std::min(j, k), std::max(j, k), -across);
    }
  }
  return result;
}

Stretch BondStretching::stretch(const State& bending) const {
  Stretch result{strains(bending), {}};
  Forces ignored;
  internal_force(bending, zero_like(bending), ignored, result.forces);
  return result;
}

/// Half the squares of the slopes, which are those of least squares over every family.
Eigen::Matrix3Xd BondStretching::strains(const State& bending) const {
  State deflections = zero_like(bending);
  deflections.row(0) = bending.row(0);
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, bending.cols());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < plate_.points(); ++k) {
    if (plate_.families()[k].empty()) continue;
    const auto g = gradients(k, deflections, plate_.families(), plate_.shapes(), areas_).shear;
    result.col(Eigen::Index(k)) << g.x() * g.x() / 2, g.y() * g.y() / 2, g.x() * g.y();
  }
  return result;
}

Eigen::Matrix3Xd BondStretching::membrane_forces(const State& bending, const State& membrane) const {
  const LocalSection local(section_);
  Eigen::Matrix3Xd result = strains(bending).leftCols(Eigen::Index(plate_points_));
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < plate_points_; ++k) {
    auto own = result.col(Eigen::Index(k));
    own =
        local.bending * (own + strain(gradients(k, membrane, plate_.families(), plate_.shapes(), areas_).theta)).eval();
  }
  return result;
}

}  // namespace plate
