#include "plate/boundary/taylor.hpp"

#include <fmt/format.h>
#include <cmath>
#include <functional>
#include "plate/model/algebra/dense.hpp"
#include "plate/model/refused.hpp"

namespace plate {

namespace {

/// Products of powers of x of degree 1 to `order`, from the highest power of the first component on.
Eigen::RowVectorXd monomials(const Eigen::VectorXd& x, int order) {
  const int dimension = int(x.size());
  std::vector<double> result;
  std::vector<int> power(std::size_t(dimension), 0);
  const std::function<void(int, int, double)> add = [&](int component, int left, double product) {
    if (component + 1 == dimension) {
      result.push_back(product * std::pow(x[component], left));
      return;
    }
    for (int k = left; k >= 0; --k) add(component + 1, left - k, product * std::pow(x[component], k));
  };
  for (int degree = 1; degree <= order; ++degree) add(0, degree, 1);
  return Eigen::Map<Eigen::RowVectorXd>(result.data(), Eigen::Index(result.size()));
}

}  // namespace

int taylor_terms(int dimension, int order) {
  int terms = 1;
  for (int i = 1; i <= dimension; ++i) terms = terms * (order + i) / i;
  return terms;
}

Eigen::VectorXd taylor_weights(const Eigen::MatrixXd& nodes, const Eigen::VectorXd& at, int order) {
  const Eigen::Index count = nodes.cols(), derivatives = taylor_terms(int(nodes.rows()), order) - 1;
  Eigen::VectorXd weights = Eigen::VectorXd::Unit(count, 0);
  if (derivatives == 0) return weights;
  const auto refuse = [&] {
    throw Refused({{Subject::spacing, 0,
                    fmt::format("an extrapolation of order {} needs {} nodes that determine it, {} are there", order,
                                derivatives + 1, count)}});
  };
  if (count <= derivatives) refuse();
  const Eigen::MatrixXd apart = nodes.rightCols(count - 1).colwise() - nodes.col(0);
  const double unit = apart.cwiseAbs().maxCoeff();
  Eigen::MatrixXd expansions(derivatives, count - 1);  // of each node about the first, without its value
  for (Eigen::Index q = 0; q + 1 < count; ++q) expansions.col(q) = monomials(apart.col(q) / unit, order).transpose();
  const auto [shares, rank] = least_norm(expansions, monomials((at - nodes.col(0)) / unit, order).transpose());
  if (rank < derivatives) refuse();
  weights.tail(count - 1) = shares;
  weights[0] = 1 - weights.tail(count - 1).sum();
  return weights;
}

}  // namespace plate
