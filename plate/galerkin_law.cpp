#include "plate/galerkin_law.hpp"

#include <array>
#include <cmath>

namespace plate {

using geometry::Point;

GalerkinStiffness::GalerkinStiffness(const Section& section, double spacing_square, const GalerkinWeights& weights)
    : D(section.bending_stiffness()), nu(section.poisson), bending_residual(weights.bending_residual * D) {
  const double square = section.thickness * section.thickness, S = section.shear_stiffness();
  shear = S * square / (square + weights.shear_scaling * spacing_square);
  shear_residual = weights.shear_residual * S * square / (square + weights.residual_scaling * spacing_square);
}

FamilyStrains family_strains(const GalerkinFamilies& families, std::size_t k, const State& state) {
  FamilyStrains result;
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  const Point own = psi_of(state, k);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, vector] = family[i];
    result.psi += (psi_of(state, j) - own) * bonds[i].gradient.transpose();
    result.gamma += bonds[i].gradient * bond_shear(state, k, j, families.families.vectors()[vector]);
  }
  return result;
}

double family_energy(const GalerkinFamilies& families, const Section& section, std::size_t k, const State& state) {
  const GalerkinStiffness stiffness(section, families.square(k));
  const FamilyStrains strains = family_strains(families, k, state);
  const Eigen::Matrix2d kappa = (strains.psi + strains.psi.transpose()) / 2;
  const double nu = stiffness.nu;
  double energy = families.areas[k] / 2 *
                  (stiffness.D * ((1 - nu) * kappa.squaredNorm() + nu * kappa.trace() * kappa.trace()) +
                   stiffness.shear * strains.gamma.squaredNorm());
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, vector] = family[i];
    const Point& x = families.families.vectors()[vector];
    const double length = x.norm();
    const Point n = x / length, r = (psi_of(state, j) - psi_of(state, k)) / length - strains.psi * n;
    const double along = r.dot(n), rho = bond_shear(state, k, j, x) / length - n.dot(strains.gamma);
    energy += bonds[i].share / 2 *
              (stiffness.bending_residual * ((1 - nu) / 2 * r.squaredNorm() + (1 + nu) / 2 * along * along) +
               stiffness.shear_residual * rho * rho);
  }
  return energy;
}

namespace {

/// Rows of factors of the degrees of freedom of a family, of which the energy is half the sum of squares.
class SquareRows {
public:
  SquareRows(std::size_t bonds)
      : rows_(Eigen::MatrixXd::Zero(Eigen::Index(5 + 3 * bonds), Eigen::Index(3 * (bonds + 1)))) {}

  using Row = Eigen::RowVectorXd;
  Row zero() const { return Row::Zero(rows_.cols()); }
  /// psi_a of a member, psi = (-theta_y, theta_x).
  static void add_psi(Row& row, std::size_t member, int a, double factor) {
    row[Eigen::Index(3 * member + (a == 0 ? 2 : 1))] += a == 0 ? -factor : factor;
  }
  void square(const Row& row, double factor) { rows_.row(next_++) = std::sqrt(factor) * row; }
  Eigen::MatrixXd stiffness() const { return rows_.transpose() * rows_; }

private:
  Eigen::MatrixXd rows_;
  Eigen::Index next_ = 0;
};

}  // namespace

Eigen::MatrixXd family_stiffness(const GalerkinFamilies& families, const Section& section, std::size_t k) {
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  const GalerkinStiffness s(section, families.square(k));
  const double V = families.areas[k], nu = s.nu;
  SquareRows rows(family.size());
  const auto add_psi = SquareRows::add_psi;
  std::array<std::array<SquareRows::Row, 2>, 2> H{{{rows.zero(), rows.zero()}, {rows.zero(), rows.zero()}}};
  std::array<SquareRows::Row, 2> gamma{rows.zero(), rows.zero()};
  std::vector<SquareRows::Row> shears;
  for (std::size_t i = 0; i < family.size(); ++i) {
    const Point& x = families.families.vectors()[family[i].vector_id];
    auto& shear = shears.emplace_back(rows.zero());
    shear[Eigen::Index(3 * (i + 1))] = 1, shear[0] = -1;
    for (const int a : {0, 1})
      for (const std::size_t member : {i + 1, std::size_t(0)}) add_psi(shear, member, a, -x[a] / 2);
    for (const std::size_t b : {0, 1}) {
      const double G = bonds[i].gradient[Eigen::Index(b)];
      gamma[b] += G * shear;
      for (const int a : {0, 1}) add_psi(H[std::size_t(a)][b], i + 1, a, G), add_psi(H[std::size_t(a)][b], 0, a, -G);
    }
  }
  // kxx^2 + kyy^2 + 2 nu kxx kyy by the sum and the difference
  rows.square(H[0][0] + H[1][1], V * s.D * (1 + nu) / 2);
  rows.square(H[0][0] - H[1][1], V * s.D * (1 - nu) / 2);
  rows.square(H[0][1] + H[1][0], V * s.D * (1 - nu) / 2);
  for (const auto& row : gamma) rows.square(row, V * s.shear);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const Point& x = families.families.vectors()[family[i].vector_id];
    const double length = x.norm(), bending = bonds[i].share * s.bending_residual;
    const Point n = x / length, across(-n.y(), n.x());
    auto along = rows.zero(), aside = rows.zero();  // r . n, r across n
    for (const int a : {0, 1}) {
      SquareRows::Row r = -n.x() * H[std::size_t(a)][0] - n.y() * H[std::size_t(a)][1];
      add_psi(r, i + 1, a, 1 / length), add_psi(r, 0, a, -1 / length);
      along += n[a] * r, aside += across[a] * r;
    }
    rows.square(along, bending);
    rows.square(aside, bending * (1 - nu) / 2);
    rows.square(shears[i] / length - n.x() * gamma[0] - n.y() * gamma[1], bonds[i].share * s.shear_residual);
  }
  return rows.stiffness();
}

}  // namespace plate
