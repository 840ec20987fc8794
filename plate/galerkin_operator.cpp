#include "plate/galerkin_operator.hpp"

namespace plate {

GalerkinOperator::GalerkinOperator(GalerkinFamilies families, const Section& section)
    : families_(std::move(families)),
      section_(section),
      rows_(families_, section),
      lists_(families_, section, rows_.others()) {
  for (std::uint32_t k = 0; k < points() && lattice_stiffness_.size() == 0; ++k)
    if (families_.kind[k] == 0) lattice_stiffness_ = family_stiffness(families_, section_, k);
}

void GalerkinOperator::internal_force(const State& state, Forces& forces) const {
  forces.resize(3, state.cols());
  rows_.internal_force(state, forces);
  lists_.internal_force(state, forces);
}

/// Adds to every point in no row what the families that it belongs to have for it: local(k, K) of the family of k with
/// stiffness K, three numbers for every member.
template <typename Local>
void GalerkinOperator::gather(const Local& local, Forces& result) const {
  const auto& f = families_.families;
  const auto& kept = lists_.kept();
  std::vector<Eigen::VectorXd> found(kept.size());
  std::vector<std::uint32_t> place(points());
  for (std::uint32_t n = 0; n < kept.size(); ++n) place[kept[n]] = n;
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t n = 0; n < kept.size(); ++n) {
    const auto k = kept[n];
    found[n] = local(k, families_.kind[k] == 0 ? lattice_stiffness_ : family_stiffness(families_, section_, k));
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < rows_.others().size(); ++i) {
    const auto k = rows_.others()[i];
    result.col(k) += found[place[k]].head<3>();
    for (const auto& bond : f[k])
      result.col(k) += found[place[bond.neighbour]].segment<3>(Eigen::Index(3 * (f[bond.neighbour].find(k) + 1)));
  }
}

void GalerkinOperator::absolute_product(const State& state, Forces& forces) const {
  forces.setZero(3, state.cols());
  rows_.absolute_product(state, forces);
  const auto local = [&](std::uint32_t k, const Eigen::MatrixXd& K) -> Eigen::VectorXd {
    const auto family = families_.families[k];
    Eigen::VectorXd own(K.cols());
    own.head<3>() = state.col(k);
    for (std::size_t b = 0; b < family.size(); ++b)
      own.segment<3>(Eigen::Index(3 * (b + 1))) = state.col(family[b].neighbour);
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
  return rows_.bytes() + lists_.bytes() + families_.bonds.size() * sizeof(GalerkinBond) +
         families_.first.size() * sizeof(std::size_t) + families_.kind.size() * sizeof(std::uint32_t);
}

}  // namespace plate
