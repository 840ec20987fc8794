#include "plate/solve/assembled_plate.hpp"

#include "plate/model/numerical_error.hpp"

namespace plate {

std::unique_ptr<Factor> factorised(const Eigen::SparseMatrix<double>& matrix) {
  // a part that hangs on two points of the local plate, but on more of the true one, leaves a zero
  for (double shift = 0;; shift = shift == 0 ? 1e-12 : 1e3 * shift) try {
      return std::make_unique<Factor>(matrix, shift);
    } catch (const NumericalError&) {
      if (shift > 1e-4) throw;
    }
}

Eigen::VectorXd gathered(const Unknowns& unknowns, const Forces& forces) {
  Eigen::VectorXd result(unknowns.size());
  for (Eigen::Index u = 0; u < result.size(); ++u) result[u] = at_dof(forces, unknowns.dof[std::size_t(u)]);
  return result;
}

Forces folded_diagonal(const Operator& plate, const Constraints& constraints) {
  Forces diagonal = plate.diagonal();
  constraints.fold_diagonal(diagonal);
  return diagonal;
}

AssembledPlate::AssembledPlate(const Operator& plate, const Constraints& constraints, const PointMatrix& stiffness)
    : constraints_(constraints) {
  const PointMatrix matrix = folded(stiffness, constraints);
  const Forces diagonal = folded_diagonal(plate, constraints);
  unknowns_ = unknowns(diagonal, elimination_order(matrix, diagonal));
  factor_ = std::make_unique<Factor>(of_unknowns(matrix, unknowns_));
}

void AssembledPlate::apply(const Forces& residual, State& result) const {
  const Eigen::MatrixXd solution = factor_->solve(gathered(unknowns_, residual));
  result.setZero(3, residual.cols());
  for (Eigen::Index u = 0; u < solution.rows(); ++u) at_dof(result, unknowns_.dof[std::size_t(u)]) = solution(u, 0);
}

std::vector<State> AssembledPlate::solve(const std::vector<Forces>& loads) const {
  Eigen::MatrixXd right(unknowns_.size(), Eigen::Index(loads.size()));
  for (std::size_t i = 0; i < loads.size(); ++i) {
    Forces folded = loads[i];
    constraints_.fold(folded);
    right.col(Eigen::Index(i)) = gathered(unknowns_, folded);
  }
  const Eigen::MatrixXd solution = factor_->solve(right);
  std::vector<State> result(loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    result[i].setZero(3, loads[i].cols());
    for (Eigen::Index u = 0; u < solution.rows(); ++u)
      at_dof(result[i], unknowns_.dof[std::size_t(u)]) = solution(u, Eigen::Index(i));
    constraints_.impose(result[i]);
  }
  return result;
}

}  // namespace plate
