// Assembly, condensation and solution of displacements with pressures.
#include "tests/verification/galerkin/mixed.hpp"

#include <cmath>

#include "tests/dense.hpp"
#include "tests/verification/galerkin/plate.hpp"

namespace galerkin_systems {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

struct Entries {
  Triplets isochoric, divergence, pressures, gradients, read;
};

void add(Triplets& list, const Eigen::MatrixXd& values, const std::vector<int>& rows, const std::vector<int>& columns) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
      list.emplace_back(rows[i], columns[j], values(Eigen::Index(i), Eigen::Index(j)));
}

std::vector<int> unknowns(const Nodes& nodes) {
  std::vector<int> list;
  for (const int node : nodes) list.insert(list.end(), {2 * node, 2 * node + 1});
  return list;
}

Eigen::RowVectorXd divergence(const Sample& s) {
  return Eigen::Map<const Eigen::RowVectorXd>(s.gradient.data(), s.gradient.size());
}

/// Pressure functions of a family: their numbers and values at the samples, samples x functions.
struct Functions {
  std::vector<int> numbers;
  Eigen::MatrixXd values;
};

Functions functions(const Body& b, const Family& f, int k, Pressure kind) {
  const auto samples = Eigen::Index(f.samples.size());
  if (kind == Pressure::constant) return {{k}, Eigen::MatrixXd::Ones(samples, 1)};
  Eigen::MatrixXd X(samples, 2);  // of the samples, from the master
  for (Eigen::Index j = 0; j < samples; ++j)
    X.row(j) =
        (b.points.col(f.nodes[std::size_t(f.samples[std::size_t(j)].at)]) - b.points.col(f.nodes[0])).transpose();
  if (kind == Pressure::linear) {
    Functions linear{{3 * k, 3 * k + 1, 3 * k + 2}, Eigen::MatrixXd::Ones(samples, 3)};
    linear.values.rightCols(2) = X / std::sqrt(b.areas[f.nodes[0]]);
    return linear;
  }
  Functions continuous{f.nodes, X * f.samples[0].gradient};
  continuous.values.col(0).array() += 1;
  return continuous;
}

/// Bode 6.15, 6.16: one more node per family, whose gradients are X_j - X_c.
System enriched(const Body& b, System system) {
  const auto n = int(b.points.cols());
  for (std::size_t k = 0; k < system.size(); ++k) {
    Family& f = system[k];
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    double sum = 0;
    for (const Sample& s : f.samples) {
      centre += s.weight * b.points.col(f.nodes[std::size_t(s.at)]);
      sum += s.weight;
    }
    for (Sample& s : f.samples) {
      s.gradient.conservativeResize(Eigen::NoChange, s.gradient.cols() + 1);
      s.gradient.rightCols(1) = b.points.col(f.nodes[std::size_t(s.at)]) - centre / sum;
    }
    f.nodes.push_back(n + int(k));
  }
  return system;
}

Eigen::Index functions_count(const Body& b, Pressure kind) {
  if (kind == Pressure::displacement || kind == Pressure::masters) return 0;
  return (kind == Pressure::linear ? 3 : 1) * b.points.cols();
}

/// One family's part; `own` is it before the bubble. Families of masters already met (bond residuals) read no pressure.
void add_family(Entries& e, const Solid& solid, const Body& b, const Family& own, const Family& f, Pressure pressure,
                Eigen::Index displacements) {
  const bool first = e.read.empty() || own.nodes[0] > e.read.back().row();
  const auto dofs = unknowns(f.nodes);
  const bool mixed = pressure != Pressure::displacement && pressure != Pressure::masters;
  const int k = own.nodes[0];
  const Functions q = mixed ? functions(b, own, k, pressure) : Functions{};
  for (std::size_t j = 0; j < f.samples.size(); ++j) {
    const Sample& s = f.samples[j];
    const Eigen::MatrixXd B = strain(s.gradient);
    const bool whole = pressure == Pressure::displacement || (pressure == Pressure::masters && first);
    add(e.isochoric, s.weight * B.transpose() * (whole ? law(solid) : isochoric_law(solid)) * B, dofs, dofs);
    Eigen::MatrixXd H(4, B.cols());
    for (Eigen::Index i = 0; i < H.cols(); ++i)
      H.col(i) << (i % 2 == 0 ? Eigen::Vector4d(s.gradient(0, i / 2), s.gradient(1, i / 2), 0, 0)
                              : Eigen::Vector4d(0, 0, s.gradient(0, i / 2), s.gradient(1, i / 2)));
    add(e.gradients, s.weight * H.transpose() * H, dofs, dofs);
    if (!mixed) continue;
    const Eigen::VectorXd value = q.values.row(Eigen::Index(j)).transpose();
    add(e.divergence, s.weight * value * divergence(s), q.numbers, dofs);
    add(e.pressures, s.weight * value * value.transpose(), q.numbers, q.numbers);
  }
  if (!first) return;
  if (mixed)
    e.read.emplace_back(k, int(displacements) + (pressure == Pressure::linear ? 3 * k : k), 1);
  else
    add(e.read, solid.bulk() * divergence(own.samples[0]), {k}, unknowns(own.nodes));
}

Sparse sparse(const Triplets& entries, Eigen::Index rows, Eigen::Index columns) {
  Sparse matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

Blocks blocks(const Solid& solid, const Body& b, const System& system, Pressure pressure, bool bubble) {
  const System all = bubble ? enriched(b, system) : system;
  const Eigen::Index points = 2 * b.points.cols(), n = bubble ? 2 * points : points, m = functions_count(b, pressure);
  Entries e;
  for (std::size_t k = 0; k < all.size(); ++k) add_family(e, solid, b, system[k], all[k], pressure, n);
  return {sparse(e.isochoric, n, n), sparse(e.divergence, m, n),        sparse(e.pressures, m, m),
          sparse(e.gradients, n, n), sparse(e.read, points / 2, n + m), points};
}

Blocks blocks(const Solid& solid, const Body& b, const Basis& basis) {
  return blocks(solid, b, basis.system(b), basis.pressure, basis.bubble);
}

Eigen::MatrixXd condensed(const Solid& solid, const Blocks& blocks) {
  Eigen::MatrixXd K = blocks.isochoric;
  if (blocks.pressures.rows() > 0) {
    const Eigen::SimplicialLLT<Sparse> factor(blocks.pressures);
    const Eigen::MatrixXd theta = factor.solve(Eigen::MatrixXd(blocks.divergence));
    K += solid.bulk() * (blocks.divergence.transpose() * theta);
  }
  const Eigen::Index u = blocks.points, bubbles = K.rows() - u;
  if (bubbles == 0) return K;
  const Eigen::MatrixXd across = K.bottomLeftCorner(bubbles, u);
  return K.topLeftCorner(u, u) -
         across.transpose() * Eigen::MatrixXd(K.bottomRightCorner(bubbles, bubbles)).llt().solve(across);
}

PlaneSolution solution(const Solid& solid, const Blocks& blocks, const Eigen::VectorXd& load,
                       const Eigen::VectorXd& prescribed) {
  const Eigen::Index n = blocks.isochoric.rows(), all = n + blocks.pressures.rows();
  Triplets entries;
  const auto put = [&](const Sparse& block, Eigen::Index row, Eigen::Index column, double factor, bool turned) {
    for (int j = 0; j < block.outerSize(); ++j)
      for (Sparse::InnerIterator it(block, j); it; ++it)
        entries.emplace_back(int(row + (turned ? it.col() : it.row())), int(column + (turned ? it.row() : it.col())),
                             factor * it.value());
  };
  put(blocks.isochoric, 0, 0, 1, false);
  put(blocks.divergence, n, 0, 1, false);
  put(blocks.divergence, 0, n, 1, true);
  put(blocks.pressures, n, n, -1 / solid.bulk(), false);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(all), held = nothing_prescribed(all);
  right.head(load.size()) = load;
  held.head(prescribed.size()) = prescribed;
  const Eigen::VectorXd x = solved(sparse(entries, all, all), right, held);
  return {x.head(blocks.points), blocks.read * x};
}

InfSup inf_sup(const Blocks& blocks, const std::vector<Eigen::Index>& free) {
  const Eigen::MatrixXd S = Eigen::MatrixXd(blocks.gradients)(free, free);
  const Eigen::MatrixXd B = Eigen::MatrixXd(blocks.divergence)(Eigen::all, free);
  const Eigen::MatrixXd T = B * S.llt().solve(B.transpose());
  const Eigen::VectorXd values = dense::eigenvalues(T, Eigen::MatrixXd(blocks.pressures));
  const auto zero = (values.array() < 1e-10 * values.tail(1)[0]).count();
  return {std::sqrt(values[zero]), int(zero)};
}

}  // namespace galerkin_systems
