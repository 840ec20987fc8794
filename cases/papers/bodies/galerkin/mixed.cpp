// Assembly, condensation and solution of displacements with pressures; the plane formulations in a line each.
#include "cases/papers/bodies/galerkin/mixed.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace galerkin_systems {
namespace {

constexpr int linear_functions = 3;  // of P1: value and slopes

struct Entries {
  Triplets isochoric, divergence, pressures, gradients, read;
};

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
    Functions linear{{}, Eigen::MatrixXd::Ones(samples, linear_functions)};
    for (int i = 0; i < linear_functions; ++i) linear.numbers.push_back(linear_functions * k + i);
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
  return (kind == Pressure::linear ? linear_functions : 1) * b.points.cols();
}

/// One family's part; `own` is it before the bubble. Families of masters already met (bond residuals) read no pressure.
void add_family(Entries& e, const Solid& solid, const Body& b, const Family& own, const Family& f, Pressure pressure,
                Eigen::Index displacements) {
  const bool first = e.read.empty() || own.nodes[0] > e.read.back().row();
  const auto dofs = unknowns(f.nodes);
  const bool mixed = pressure != Pressure::displacement && pressure != Pressure::masters;
  const int k = own.nodes[0];
  const Functions q = mixed ? functions(b, own, k, pressure) : Functions{};
  const auto count = Eigen::Index(dofs.size()), pressures = Eigen::Index(q.numbers.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(count, count), G = K, D = Eigen::MatrixXd::Zero(pressures, count),
                  P = Eigen::MatrixXd::Zero(pressures, pressures);
  for (std::size_t j = 0; j < f.samples.size(); ++j) {
    const Sample& s = f.samples[j];
    const Eigen::MatrixXd B = strain(s.gradient);
    const bool whole = pressure == Pressure::displacement || (pressure == Pressure::masters && first);
    K += s.weight * B.transpose() * (whole ? law(solid) : isochoric_law(solid)) * B;
    Eigen::MatrixXd H(4, B.cols());
    for (Eigen::Index i = 0; i < H.cols(); ++i)
      H.col(i) << (i % 2 == 0 ? Eigen::Vector4d(s.gradient(0, i / 2), s.gradient(1, i / 2), 0, 0)
                              : Eigen::Vector4d(0, 0, s.gradient(0, i / 2), s.gradient(1, i / 2)));
    G += s.weight * H.transpose() * H;
    if (!mixed) continue;
    const Eigen::VectorXd value = q.values.row(Eigen::Index(j)).transpose();
    D += s.weight * value * divergence(s);
    P += s.weight * value * value.transpose();
  }
  add_block(e.isochoric, K, dofs, dofs);
  add_block(e.gradients, G, dofs, dofs);
  add_block(e.divergence, D, q.numbers, dofs);
  add_block(e.pressures, P, q.numbers, q.numbers);
  if (!first) return;
  if (mixed)
    e.read.emplace_back(k, int(displacements) + (pressure == Pressure::linear ? linear_functions * k : k), 1);
  else
    add_block(e.read, solid.bulk() * divergence(own.samples[0]), {k}, unknowns(own.nodes));
}

/// Smallest eigenvalue of T x = lambda S x that is not zero, and how many are.
InfSup smallest(const Eigen::MatrixXd& T, const Eigen::MatrixXd& S) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(T, S, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd values = solver.eigenvalues();
  const auto zero = (values.array() < 1e-10 * values.tail(1)[0]).count();
  return {std::sqrt(values[zero]), int(zero)};
}

System corrected_unl(const Body& b) {
  return variationally_consistent(b, moving(b));
}
System corrected_u1(const Body& b) {
  return variationally_consistent(b, linear_static(b));
}

/// Correction V4; no factors on the surface, where V4 cannot give the normals of an uneven edge.
System corrected_u2(const Body& b) {
  return variationally_consistent(b, quadratic_static(b), quadratic_correction, Normals::found);
}

System averages_with_residuals(const Body& b) {
  return central_average(b) + bond_residuals(b, central_average(b), 0.5, 1);
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

Sparse condensed(const Solid& solid, const Blocks& blocks) {
  if (blocks.pressures.rows() == 0 && blocks.isochoric.rows() == blocks.points) return blocks.isochoric;
  Eigen::MatrixXd K = blocks.isochoric;
  if (blocks.pressures.rows() > 0) {
    const Eigen::SimplicialLLT<Sparse> factor(blocks.pressures);
    const Eigen::MatrixXd theta = factor.solve(Eigen::MatrixXd(blocks.divergence));
    K += solid.bulk() * (blocks.divergence.transpose() * theta);
  }
  const Eigen::Index u = blocks.points, bubbles = K.rows() - u;
  if (bubbles == 0) return K.sparseView();
  const Eigen::MatrixXd across = K.bottomLeftCorner(bubbles, u);
  const Eigen::MatrixXd inner = K.bottomRightCorner(bubbles, bubbles);
  return Eigen::MatrixXd(K.topLeftCorner(u, u) - across.transpose() * inner.llt().solve(across)).sparseView();
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
  return smallest(T, Eigen::MatrixXd(blocks.pressures));
}

const std::vector<Basis>& bases() {
  const auto moved = [](const Body& b) { return moving(b); };
  static const std::vector<Basis> table{
      {"U1", Reach::cells, linear_static},
      {"VC U1", Reach::cells, corrected_u1},
      {"VC U1SUnl", Reach::cells, [](const Body& b) { return 0.5 * corrected_u1(b) + 0.5 * corrected_unl(b); }},
      {"VC U1SIG", Reach::cells, [](const Body& b) { return corrected_u1(b) + implicit_gradients(b); }},
      {"Unl", Reach::cells, moved},
      {"VC Unl", Reach::cells, corrected_unl},
      {"U2", Reach::two_cells, quadratic_static},
      {"VC U2", Reach::two_cells, corrected_u2, Pressure::displacement, false, Normals::found},
      {"CA, masters only", Reach::cells, central_average},
      {"PG-CA", Reach::cells, averages_with_residuals},
      {"PG-CA, residuals isochoric", Reach::cells, averages_with_residuals, Pressure::masters},
      {"UnlP0", Reach::cells, moved, Pressure::constant},
      {"VC UnlP0", Reach::cells, corrected_unl, Pressure::constant},
      {"U2P1", Reach::two_cells, quadratic_static, Pressure::linear},
      {"VC U2P1", Reach::two_cells, corrected_u2, Pressure::linear, false, Normals::found},
      {"U2P1C", Reach::two_cells, quadratic_static, Pressure::continuous},
      {"VC U2P1C", Reach::two_cells, corrected_u2, Pressure::continuous, false, Normals::found},
      {"Unl+P1C", Reach::cells, moved, Pressure::continuous, true},
      {"VC Unl+P1C", Reach::cells, corrected_unl, Pressure::continuous, true},
      {"VC UnlP1C, no bubble", Reach::cells, corrected_unl, Pressure::continuous},
  };
  return table;
}

const Basis& basis(const std::string& name) {
  for (const Basis& each : bases())
    if (each.name == name) return each;
  throw std::out_of_range("no basis " + name);
}

Eigen::Matrix2Xd load_normals(const Body& b, const Basis& basis) {
  return basis.normals == Normals::found ? nodal_normals(b, basis.system(b)) : b.normals;
}

InfSup inf_sup(const Basis& basis, Reach reach, int cells, double perturbation) {
  const Body b = body({1, 1, cells, cells, perturbation, reach});
  const Blocks all = blocks({100, 0.3}, b, basis);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < all.gradients.rows(); ++i) {
    const bool held = i < all.points && b.points(0, i / 2) == 0 && (i % 2 == 0 || b.points(1, i / 2) == 0);
    if (!held) free.push_back(i);
  }
  if (basis.pressure != Pressure::displacement) return inf_sup(all, free);
  // lambda = mu = 1 less twice lambda = 0, mu = 1/2
  const Sparse divergences = blocks({2.5, 0.25}, b, basis).isochoric - 2 * blocks({1, 0}, b, basis).isochoric;
  return smallest(Eigen::MatrixXd(divergences)(free, free), Eigen::MatrixXd(all.gradients)(free, free));
}

Sparse petrov_constant_pressure(const Solid& solid, const Body& b, const System& test, const System& dilation) {
  Triplets entries;
  for (std::size_t k = 0; k < test.size(); ++k) {
    const auto dofs = unknowns(test[k].nodes);
    const double weight = b.areas[Eigen::Index(k)] * solid.bulk();
    add_block(entries, weight * divergence(test[k].samples[0]).transpose() * divergence(dilation[k].samples[0]), dofs,
              dofs);
  }
  const Eigen::Index n = 2 * b.points.cols();
  return petrov_stiffness(isochoric_law(solid), b, moving(b), test, Petrov::first) + sparse(entries, n, n);
}

}  // namespace galerkin_systems
