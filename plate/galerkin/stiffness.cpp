#include "plate/galerkin/stiffness.hpp"

#include <omp.h>
#include <cmath>
#include <stdexcept>

#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Coefficients of the bond shear angle times length by (w, theta_x, theta_y) of the member and of the owner.
std::array<double, 3> of_member(double x, double y) {
  return {1, -y / 2, x / 2};
}

std::array<double, 3> of_owner(double x, double y) {
  return {-1, -y / 2, x / 2};
}

}  // namespace

void FamilyStiffness::find(std::size_t k) {
  members_ = families_.families[k].size() + 1;
  if (members_ > most_members) throw std::invalid_argument("a point has more than 32 neighbours");
  GalerkinStiffness stiffness(sections_[k], families_.square(k));
  if (residual_of_all_) stiffness.bending_residual = *residual_of_all_;
  take_bonds(k, stiffness);
  for (std::size_t i = 0; i < members_; ++i) find_rows(i);
  add_bonds();
}

/// Collects the terms of the bonds of family k. With half the stiffness T of the mean curvatures and the residuals'
/// products with them, X: Y = T H / 2 - X, and the energy's second derivative is H^T Y + Y^T H and what each bond has
/// alone; so for the shear angles too.
void FamilyStiffness::take_bonds(std::size_t k, const GalerkinStiffness& s) {
  const auto family = families_.families[k];
  const auto* bonds = families_.of(k);
  const double V = families_.areas[k];
  Eigen::Matrix<double, 3, 4> strain;  // kappa xx, yy, 2 xy by H xx, xy, yx, yy
  strain << 1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0;
  Eigen::Matrix4d T = V * strain.transpose() * s.bending * strain;
  Eigen::Matrix2d M = V * s.shear;
  std::array<Eigen::Matrix2d, most_members> B;  // t_b B of every bond
  for (std::size_t i = 1; i < members_; ++i) {
    const auto& bond = bonds[i - 1];
    const Point& x = families_.families.vectors()[family[i - 1].vector_id];
    x_[i] = x.x(), y_[i] = x.y(), inverse_[i] = 1 / x.norm(), share_[i] = bond.share;
    G_[0][i] = bond.gradient.x(), G_[1][i] = bond.gradient.y();
    const Point n = x * inverse_[i];
    const Eigen::Matrix2d nn = n * n.transpose();
    const double shear = n.dot(s.shear_residual * n), weight = bond.share * inverse_[i] * inverse_[i];
    B[i] = s.bending_residual * along(s.bending, n);
    for (Eigen::Index a = 0; a < 2; ++a)
      for (Eigen::Index c = 0; c < 2; ++c) T.block<2, 2>(2 * a, 2 * c) += bond.share * B[i](a, c) * nn;
    M += bond.share * shear * nn;
    residual_[0][i] = weight * B[i](0, 0), residual_[1][i] = weight * B[i](0, 1), residual_[2][i] = weight * B[i](1, 1);
    residual_[3][i] = weight * shear;
  }
  for (auto* numbers : {&G_[0], &G_[1]}) (*numbers)[0] = 0;
  for (auto& numbers : moments_) numbers[0] = 0;
  for (auto& numbers : gamma_) numbers[0] = 0;
  for (auto& numbers : forces_) numbers[0] = 0;
  for (std::size_t i = 1; i < members_; ++i) {
    const Point G(G_[0][i], G_[1][i]), n = Point(x_[i], y_[i]) * inverse_[i];
    for (std::size_t c = 0; c < 2; ++c) {
      const auto C = Eigen::Index(c);
      G_[c][0] -= G_[c][i];
      for (std::size_t a = 0; a < 2; ++a) {
        const auto A = Eigen::Index(a);
        const Point Y = T.block<2, 2>(2 * A, 2 * C) * G / 2 - share_[i] * inverse_[i] * B[i](A, C) * n;
        for (std::size_t b = 0; b < 2; ++b) {
          const auto at = 4 * a + 2 * b + c;
          moments_[at][i] = Y[Eigen::Index(b)];
          moments_[at][0] -= moments_[at][i];
        }
      }
    }
    const Point y = M * G / 2 - residual_[3][i] / inverse_[i] * n;
    const auto alpha = of_member(x_[i], y_[i]), beta = of_owner(x_[i], y_[i]);
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t d = 0; d < 3; ++d) {
        const auto at = 3 * a + d;
        const auto A = Eigen::Index(a);
        gamma_[at][i] = G[A] * alpha[d], gamma_[at][0] += G[A] * beta[d];
        forces_[at][i] = y[A] * alpha[d], forces_[at][0] += y[A] * beta[d];
      }
  }
}

/// K_ij of all j, but for what single bonds add; psi = (-theta_y, theta_x).
void FamilyStiffness::find_rows(std::size_t i) {
  double* const rows = blocks_.data() + i * 9 * stride;
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t c = 0; c < 3; ++c) {
      const double g0 = gamma_[c][i], g1 = gamma_[3 + c][i], f0 = forces_[c][i], f1 = forces_[3 + c][i];
      const double *const G0 = gamma_[d].data(), *const G1 = gamma_[3 + d].data();
      const double *const F0 = forces_[d].data(), *const F1 = forces_[3 + d].data();
      double* const to = rows + (3 * d + c) * stride;
#pragma omp simd
      for (std::size_t j = 0; j < members_; ++j) to[j] = g0 * F0[j] + g1 * F1[j] + f0 * G0[j] + f1 * G1[j];
    }
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t d = 0; d < 2; ++d) {  // of psi_c and psi_d
      const double p0 = G_[0][i], p1 = G_[1][i], y0 = moments_[4 * d + c][i], y1 = moments_[4 * d + 2 + c][i];
      const double *const Y0 = moments_[4 * c + d].data(), *const Y1 = moments_[4 * c + 2 + d].data();
      const double *const P0 = G_[0].data(), *const P1 = G_[1].data();
      const double sign = c == d ? 1 : -1;
      double* const to = rows + (3 * (2 - d) + 2 - c) * stride;
#pragma omp simd
      for (std::size_t j = 0; j < members_; ++j) to[j] += sign * (p0 * Y0[j] + p1 * Y1[j] + y0 * P0[j] + y1 * P1[j]);
    }
}

void FamilyStiffness::add_bonds() {
  const auto add = [&](std::size_t i, std::size_t j, const Eigen::Matrix3d& K) {
    for (std::size_t c = 0; c < 9; ++c) blocks_[(i * 9 + c) * stride + j] += K.data()[c];
  };
  for (std::size_t i = 1; i < members_; ++i) {
    const auto alpha = of_member(x_[i], y_[i]), beta = of_owner(x_[i], y_[i]);
    const Eigen::Vector3d a(alpha.data()), b(beta.data());
    Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();  // psi = (-theta_y, theta_x)
    bend(1, 1) = residual_[2][i], bend(2, 2) = residual_[0][i], bend(1, 2) = bend(2, 1) = -residual_[1][i];
    const double shear = residual_[3][i];
    add(i, i, shear * a * a.transpose() + bend);
    add(i, 0, shear * a * b.transpose() - bend);
    add(0, i, shear * b * a.transpose() - bend);
    add(0, 0, shear * b * b.transpose() + bend);
  }
}

Eigen::MatrixXd family_stiffness(const GalerkinFamilies& families, const PointSections& sections, std::size_t k) {
  FamilyStiffness family(families, sections);
  family.find(k);
  const auto members = Eigen::Index(family.members());
  Eigen::MatrixXd result(3 * members, 3 * members);
  for (Eigen::Index i = 0; i < members; ++i)
    for (Eigen::Index j = 0; j < members; ++j)
      result.block<3, 3>(3 * i, 3 * j) = family.block(std::size_t(i), std::size_t(j));
  return result;
}

namespace {

/// A point and its neighbours, ascending, with their places in its family; 0: the point itself.
struct Members {
  std::array<std::uint32_t, FamilyStiffness::most_members> point, place;
  std::size_t count = 0;

  Members(const geometry::Families& families, std::uint32_t k) {
    std::uint32_t i = 0;
    bool taken = false;
    const auto take = [&](std::uint32_t j, std::uint32_t at) { point[count] = j, place[count++] = at; };
    for (const auto& bond : families[k]) {
      if (!taken && bond.neighbour > k) take(k, 0), taken = true;
      take(bond.neighbour, ++i);
    }
    if (!taken) take(k, 0);
  }
};

/// Adds the blocks of one family in the columns begin ... end - 1.
void add_family(const FamilyStiffness& family, const Members& members, std::uint32_t begin, std::uint32_t end,
                PointMatrix& matrix) {
  for (std::size_t c = 0; c < members.count; ++c) {
    const auto k = members.point[c];
    if (k < begin || k >= end) continue;
    auto at = matrix.first[k];
    for (auto r = c; r < members.count; ++r) {
      while (matrix.row[at] != members.point[r]) ++at;
      matrix.block[at] += family.block(members.place[r], members.place[c]);
    }
  }
}

}  // namespace

PointMatrix stiffness_matrix(const GalerkinFamilies& all, const PointSections& sections,
                             std::optional<double> residual) {
  const auto points = all.areas.size();
  auto result = zeros(points, [&](Column& column, std::uint32_t k) {
    for (const auto& bond : all.families[k]) {
      column.couple(bond.neighbour);
      for (const auto& next : all.families[bond.neighbour]) column.couple(next.neighbour);
    }
  });
  // every thread has columns of its own, and adds the families to them in their order; of the lattice there is one,
  // whichever thread this is: areas of its points differ in the last bit
  const auto shares = [&](std::uint32_t k) { return sections.uniform() && all.kind[k] == 0; };
  const auto lattice = sections.uniform() ? lattice_family(all) : std::nullopt;
#pragma omp parallel
  {
    const auto threads = std::size_t(omp_get_num_threads()), thread = std::size_t(omp_get_thread_num());
    const auto begin = std::uint32_t(points * thread / threads), end = std::uint32_t(points * (thread + 1) / threads);
    FamilyStiffness own(all, sections, residual), shared(lattice ? *lattice->families : all, sections, residual);
    if (lattice) shared.find(lattice->point);
    for (std::uint32_t k = 0; k < points && begin < end; ++k) {
      const Members members(all.families, k);
      if (members.point[members.count - 1] < begin || members.point[0] >= end) continue;
      if (!shares(k)) own.find(k);
      add_family(shares(k) ? shared : own, members, begin, end, result);
    }
  }
  return result;
}

GalerkinCoupling galerkin_coupling(const GalerkinFamilies& families, const Section& section) {
  const auto by = [&](PlateLaw law) {
    Section result = section;
    result.law = law;
    return result;
  };
  const auto residual = [&](PlateLaw law) { return GalerkinStiffness(by(law), families.square(0)).bending_residual; };
  return {PointSections(by(PlateLaw::coupling)), std::sqrt(residual(PlateLaw::bending) * residual(PlateLaw::membrane))};
}

PointMatrix coupling_matrix(const GalerkinFamilies& families, const Section& section) {
  const auto coupling = galerkin_coupling(families, section);
  return stiffness_matrix(families, coupling.sections, coupling.residual);
}

PointMatrix stiffness_matrix(const GalerkinOperator& plate) {
  return with(plate.own_matrix(), plate.elastic_supports());
}

}  // namespace plate
