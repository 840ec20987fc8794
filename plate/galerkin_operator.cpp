#include "plate/galerkin_operator.hpp"

#include <cmath>

namespace plate {

using geometry::Point;

GalerkinOperator::GalerkinOperator(GalerkinFamilies families, const Section& section)
    : families_(std::move(families)), section_(section), rows_(families_, section) {
  constexpr auto none = std::uint32_t(-1);
  std::vector<std::uint32_t> place(points(), none);
  const auto keep = [&](std::uint32_t k) {
    if (place[k] == none) place[k] = std::uint32_t(kept_.size()), kept_.push_back(k);
    return place[k];
  };
  const auto& f = families_.families;
  first_.push_back(0);
  for (const auto i : rows_.others()) {
    place_.push_back(keep(i));
    const GalerkinStiffness own(section, families_.square(i));
    for (std::size_t b = 0; b < f[i].size(); ++b) {
      const auto [j, vector] = f[i][b];
      const GalerkinStiffness others(section, families_.square(j));
      const auto &out = families_.of(i)[b], &back = families_.of(j)[f[j].find(i)];
      const Point& x = f.vectors()[vector];
      const double length = x.norm();
      bonds_.push_back({j, keep(j), x, out.gradient, back.gradient, out.share * own.bending_residual / length,
                        back.share * others.bending_residual / length, out.share * own.shear_residual / length,
                        back.share * others.shear_residual / length});
    }
    first_.push_back(bonds_.size());
  }
  resultants_.resize(kept_.size());
  for (std::uint32_t k = 0; k < points() && lattice_stiffness_.size() == 0; ++k)
    if (families_.kind[k] == 0) lattice_stiffness_ = family_stiffness(families_, section_, k);
}

GalerkinOperator::Resultants GalerkinOperator::resultants(std::size_t k, const State& state) const {
  const auto strains = family_strains(families_, k, state);
  const GalerkinStiffness s(section_, families_.square(k));
  const double V = families_.areas[k], nu = s.nu;
  const Eigen::Matrix2d kappa = (strains.psi + strains.psi.transpose()) / 2;
  Resultants result{strains.psi, V * s.D * ((1 - nu) * kappa + nu * kappa.trace() * Eigen::Matrix2d::Identity()),
                    strains.gamma, V * s.shear * strains.gamma};
  const auto family = families_.families[k];
  const auto* bonds = families_.of(k);
  const Point own = psi_of(state, k);
  for (std::size_t b = 0; b < family.size(); ++b) {
    const auto [j, vector] = family[b];
    const Point& x = families_.families.vectors()[vector];
    const double length = x.norm();
    const Point n = x / length, r = (psi_of(state, j) - own) / length - strains.psi * n;
    const double rho = bond_shear(state, k, j, x) / length - n.dot(strains.gamma);
    const Point t = bonds[b].share * s.bending_residual * ((1 - nu) / 2 * r + (1 + nu) / 2 * r.dot(n) * n);
    result.moment -= t * n.transpose();
    result.shear -= bonds[b].share * s.shear_residual * rho * n;
  }
  return result;
}

Eigen::Vector3d GalerkinOperator::force(std::size_t i, const State& state) const {
  const auto k = rows_.others()[i];
  const Resultants& own = resultants_[place_[i]];
  const double nu = section_.poisson;
  const Point psi = psi_of(state, k);
  double phi_sum = 0;
  Point couple(0, 0);
  for (auto b = first_[i]; b < first_[i + 1]; ++b) {
    const Bond& bond = bonds_[b];
    const Resultants& other = resultants_[bond.family];
    const double length = bond.x.norm();
    const Point n = bond.x / length, turn = (psi_of(state, bond.neighbour) - psi) / length;
    const double g = bond_shear(state, k, bond.neighbour, bond.x) / length;
    // tractions of the residuals in i's family and in j's, both along x
    const Point r = turn - own.strain * n, s = turn - other.strain * n;
    const Point residual = bond.own_bending * r + bond.others_bending * s;
    const Point t = (1 - nu) / 2 * residual + (1 + nu) / 2 * residual.dot(n) * n;
    const double tau = bond.own_shear * (g - n.dot(own.gamma)) + bond.others_shear * (g - n.dot(other.gamma));
    const double phi = other.shear.dot(bond.others) - own.shear.dot(bond.own) - tau;
    phi_sum += phi;
    couple += other.moment * bond.others - own.moment * bond.own - t + bond.x * (phi / 2);
  }
  return {-phi_sum, -couple.y(), couple.x()};
}

void GalerkinOperator::internal_force(const State& state, Forces& forces) const {
  forces.resize(3, state.cols());
  rows_.internal_force(state, forces);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < kept_.size(); ++k) resultants_[k] = resultants(kept_[k], state);
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < rows_.others().size(); ++i) forces.col(rows_.others()[i]) = force(i, state);
  }
}

/// Adds to every point in no row what the families that it belongs to have for it: local(k, K) of the family of k with
/// stiffness K, three numbers for every member.
template <typename Local>
void GalerkinOperator::gather(const Local& local, Forces& result) const {
  const auto& f = families_.families;
  std::vector<Eigen::VectorXd> found(kept_.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t n = 0; n < kept_.size(); ++n) {
    const auto k = kept_[n];
    found[n] = local(k, families_.kind[k] == 0 ? lattice_stiffness_ : family_stiffness(families_, section_, k));
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < rows_.others().size(); ++i) {
    const auto k = rows_.others()[i];
    result.col(k) += found[place_[i]].head<3>();
    for (auto b = first_[i]; b < first_[i + 1]; ++b)
      result.col(k) += found[bonds_[b].family].segment<3>(Eigen::Index(3 * (f[bonds_[b].neighbour].find(k) + 1)));
  }
}

void GalerkinOperator::absolute_product(const State& state, Forces& forces) const {
  forces.setZero(3, state.cols());
  rows_.absolute_product(state, forces);
  const auto local = [&](std::uint32_t k, const Eigen::MatrixXd& K) -> Eigen::VectorXd {
    const auto family = families_.families[k];
    Eigen::VectorXd own(K.cols());
    own.head<3>() = state.col(k);
    for (std::size_t b = 0; b < family.size(); ++b) own.segment<3>(Eigen::Index(3 * (b + 1))) = state.col(family[b].neighbour);
    return K.cwiseAbs() * own;
  };
  gather(local, forces);
}

Forces GalerkinOperator::diagonal() const {
  Forces result = Forces::Zero(3, Eigen::Index(points()));
  rows_.diagonal(result);
  gather([](std::uint32_t, const Eigen::MatrixXd& K) -> Eigen::VectorXd { return K.diagonal(); }, result);
  return result;
}

Eigen::VectorXd GalerkinOperator::energies(const State& state) const {
  Eigen::VectorXd result(state.cols());
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.size(); ++k)
    result[k] = family_energy(families_, section_, std::size_t(k), state);
  return result;
}

std::size_t GalerkinOperator::bytes() const {
  return rows_.bytes() + kept_.size() * (sizeof(std::uint32_t) + sizeof(Resultants)) +
         rows_.others().size() * (sizeof(std::uint32_t) + sizeof(std::size_t)) + bonds_.size() * sizeof(Bond) +
         families_.bonds.size() * sizeof(GalerkinBond) + families_.first.size() * sizeof(std::size_t) +
         families_.kind.size() * sizeof(std::uint32_t);
}

}  // namespace plate
