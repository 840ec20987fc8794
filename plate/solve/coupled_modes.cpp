#include "plate/solve/coupled_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

PointMatrix no_blocks(std::size_t points) {
  return zeros(points, [](Column&, std::uint32_t) {});
}

/// Mass of a plate and of its plane, not carried over to the free degrees of freedom: u and v have that of w, and where
/// the mass lies off the middle plane they are coupled with the rotations.
PointMatrix stacked_mass(const Formulation& plate, double rotary) {
  const Forces own = unconstrained_mass(plate, rotary);
  const auto [first, second] = plate.mass_offsets();
  auto bending = no_blocks(plate.points()), in_plane = bending, coupling = bending;
  for (std::size_t k = 0; k < plate.points(); ++k) {
    const auto at = Index(k);
    bending.block[k].diagonal() = own.col(at);
    bending.block[k].diagonal().tail<2>().array() += second[at];
    in_plane.block[k].diagonal().tail<2>().setConstant(own(0, at));
    coupling.block[k].diagonal().tail<2>().setConstant(first[at]);
  }
  return stacked_matrix(bending, in_plane, coupling);
}

/// Unknowns of a coupled plate, and their matrices.
class CoupledUnknowns {
public:
  /// `held`: of the plane.
  CoupledUnknowns(const Formulation& plate, const Formulation& membrane, const Constraints& held)
      : points_(Index(plate.points())) {
    constraints_.add(plate.constraints(), 0);
    constraints_.add(held, std::uint32_t(plate.points()));
    constraints_.resolve();
    const auto stiffness =
        folded(stacked_matrix(plate.stiffness(), membrane.stiffness(), plate.coupling()), constraints_);
    Forces diagonal = stacked(plate.diagonal(), membrane.diagonal());
    constraints_.fold_diagonal(diagonal);
    unknowns_ = plate::unknowns(diagonal, elimination_order(stiffness, diagonal));
    stiffness_ = of_unknowns(stiffness, unknowns_);
  }

  const Constraints& constraints() const { return constraints_; }
  const Matrix& stiffness() const { return stiffness_; }
  /// Lower triangle of a matrix of both, or of the plate alone.
  Matrix matrix(const PointMatrix& of_both) const { return of_unknowns(folded(of_both, constraints_), unknowns_); }
  Matrix of_deflections(const PointMatrix& geometric) const {
    const auto none = no_blocks(std::size_t(points_));
    return matrix(stacked_matrix(geometric, none, none));
  }

  /// Values of the plate, or of its plane, alone.
  VectorXd of_plate(VectorXd values) const {
    for (Index u = 0; u < values.size(); ++u)
      if (Index(unknowns_.dof[std::size_t(u)].point) >= points_) values[u] = 0;
    return values;
  }
  /// States of the plate and of its plane; the largest of |w|, |u| and |v| is 1, and positive.
  std::pair<State, State> states(const VectorXd& values) const {
    State both = zero_state(std::size_t(2 * points_));
    for (Index u = 0; u < values.size(); ++u) at_dof(both, unknowns_.dof[std::size_t(u)]) = values[u];
    constraints_.impose(both);
    const auto displacements = [&](const State& state) {
      VectorXd result(3 * points_);
      result << state.row(0).head(points_).transpose(), -state.row(1).tail(points_).transpose(),
          state.row(2).tail(points_).transpose();
      return result;
    };
    Index at = 0;
    const VectorXd all = displacements(both);
    if (all.cwiseAbs().maxCoeff(&at) > 0) both /= all[at];
    return {plate::of_plate(both), of_plane(both)};
  }

private:
  Index points_;
  Constraints constraints_;
  Unknowns unknowns_;
  Matrix stiffness_;
};

VectorXd product(const Matrix& lower, const VectorXd& x) {
  return lower.selfadjointView<Eigen::Lower>() * x;
}

/// Size of forces in the norm of StaticOptions.
double norm(const VectorXd& forces, const Matrix& stiffness) {
  return std::sqrt(forces.cwiseAbs2().dot(stiffness.diagonal().cwiseInverse()));
}

/// Vectors of motions without strain less those in the plane alone, `count` of them. `vectors`: M-orthonormal, with M.
MatrixXd without_motions_in_plane(const MatrixXd& vectors, Index count, const Matrix& mass,
                                  const CoupledUnknowns& both) {
  MatrixXd of_plate = vectors;
  for (Index i = 0; i < vectors.cols(); ++i) of_plate.col(i) = both.of_plate(vectors.col(i));
  const MatrixXd shares = of_plate.transpose() * (mass.selfadjointView<Eigen::Lower>() * of_plate);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen((shares + shares.transpose()) / 2);
  return vectors * eigen.eigenvectors().rightCols(vectors.cols() - count);
}

/// The state of a distributed plate and of its plane, of which the largest |w|, |u| and |v| is 1, and positive.
std::pair<State, State> scaled(const Constraints& constraints, const State& both) {
  const State bending = of_plate(both), in_plane = of_plane(both);
  MatrixXd displacements(3, bending.cols());
  displacements << bending.row(0), -in_plane.row(1), in_plane.row(2);
  const double high = largest_of(constraints, displacements.maxCoeff()),
               low = largest_of(constraints, -displacements.minCoeff()), size = high >= low ? high : -low;
  return {bending / size, in_plane / size};
}

/// A stacked state of any shape.
State any_shape(const Formulation& plate, const Formulation& membrane) {
  return stacked(start_by_place(plate).value(), start_by_place(membrane).value());
}

const char* const buckled =
    "the plate buckles below these loads and has no frequencies: find them by kind = \"buckling\"";

/// The vectors of the lowest eigenvalues of (K, M), without rigid motions in the plane, of which there are `rigid`.
MatrixXd lowest(const Matrix& K, const Matrix& M, Index rigid, const CoupledUnknowns& both,
                const FrequencyOptions& options, std::size_t& solutions) {
  constexpr double none = 1e-5;  // of the shift: no strain
  const Matrix shifted = K + options.shift * M;
  const auto found = [&] {
    try {
      return largest_eigenvectors(M, shifted, options.modes + std::size_t(rigid), options.tolerance, "frequencies",
                                  both.constraints());
    } catch (const NotPositive&) {
      throw NumericalError(buckled);
    }
  }();
  solutions = found.solutions;
  MatrixXd vectors = found.vectors;
  for (Index i = 0; i < vectors.cols(); ++i) vectors.col(i) /= std::sqrt(found.values[i]);
  Index strainless = 0;
  while (strainless < vectors.cols() && 1 / found.values[strainless] - options.shift < none * options.shift)
    ++strainless;
  if (rigid == 0 || strainless < rigid) return vectors;
  MatrixXd result(vectors.rows(), vectors.cols() - rigid);
  result << without_motions_in_plane(vectors.leftCols(strainless), rigid, M, both),
      vectors.rightCols(vectors.cols() - strainless);
  return result;
}

/// Frequencies of a coupled plate that ranks share, whose plane supports hold.
FrequencySolution shared_frequencies(const Formulation& plate, const Formulation& membrane, double rotary,
                                     const PointMatrix* geometric, const FrequencyOptions& options) {
  const auto none = no_blocks(plate.points()), coupling = plate.coupling(), mass = stacked_mass(plate, rotary);
  const auto constraints = stacked(plate.constraints(), pinned(membrane), plate.points());
  const auto linear = CoupledPlate::stiffness(plate, membrane, coupling);
  auto more = stacked_matrix(geometric ? *geometric : none, none, none);
  add(mass, options.shift, more);
  const StressedPlate shifted(*linear, more);
  const auto stiffness = with_first(more, stacked_matrix(plate.stiffness(), membrane.stiffness(), coupling));
  const auto inverse = [&] {
    try {
      return AssembledPlate(*linear, constraints, stiffness, &plate.boundary());
    } catch (const NotPositive&) {
      throw NumericalError(buckled);
    }
  }();
  const auto found = largest_shared_eigenvectors({.stiffness = shifted,
                                                  .constraints = constraints,
                                                  .inverse = &inverse,
                                                  .other = mass,
                                                  .start = any_shape(plate, membrane),
                                                  .purpose = "frequencies"},
                                                 options.modes, options.tolerance);
  const auto kinetic = [&](const State& state) {
    const Forces work = state.cwiseProduct(product(mass, state));
    return plate.sum_of_points((of_plate(work) + of_plane(work)).colwise().sum().transpose());
  };
  FrequencySolution result;
  for (const auto& [value, residual, vector] : found) {
    const double square = 1 / value - options.shift;
    if (geometric && square < 0 && plate.held()) throw NumericalError(buckled);
    auto [bending, in_plane] = scaled(constraints, vector);
    const double alone = kinetic(stacked(zero_like(in_plane), in_plane));
    const double share = alone / kinetic(stacked(bending, in_plane));
    result.modes.push_back({std::sqrt(std::max(square, 0.0)) / (2 * std::numbers::pi), residual, std::move(bending),
                            std::move(in_plane), share});
  }
  return result;
}

/// Buckling of a coupled plate that ranks share.
std::vector<BucklingMode> shared_buckling(const Formulation& plate, const Formulation& membrane,
                                          const PointMatrix& geometric, std::size_t modes, double tolerance) {
  const CoupledPlate both(plate, membrane);
  const auto none = no_blocks(plate.points());
  const auto of_both = stacked_matrix(geometric, none, none);
  const auto found = largest_shared_eigenvectors({.stiffness = both.of_both(),
                                                  .constraints = both.constraints(),
                                                  .inverse = &both.inverse(),
                                                  .other = of_both,
                                                  .share = -1,
                                                  .start = any_shape(plate, membrane),
                                                  .purpose = "buckling"},
                                                 modes, tolerance);
  std::vector<BucklingMode> result;
  for (const auto& [value, residual, vector] : found) {
    auto [bending, in_plane] = scaled(both.constraints(), vector);
    result.push_back({1 / value, residual, std::move(bending), std::move(in_plane)});
  }
  return result;
}

}  // namespace

CoupledPrestress coupled_prestress(const Formulation& plate, const Formulation& membrane) {
  const StaticOptions options{1e-8, 100, {}};
  const Heat across = heat_of(plate, 1), in_plane_heat = heat_of(membrane, 1);
  const Forces bends = across.none() ? zero_forces(plate.points()) : across.forces;
  CoupledPrestress result{CoupledPlate(plate, membrane).equilibrium({bends, membrane.total_load()}, options), {}};
  const auto& [of_both, bending, in_plane] =
      std::tie(result.at_rest.of_both, result.at_rest.bending, result.at_rest.membrane);
  if (!of_both.converged) throw NumericalError("under the loads in the plane: " + of_both.stop_reason);
  result.geometric =
      plate.with_coupling_forces(membrane.stretching()->geometric_stiffness(in_plane), bending, in_plane);
  if (!in_plane_heat.none()) add(stiffness_of_heat(membrane, in_plane_heat), 1, result.geometric);
  return result;
}

FrequencySolution coupled_frequencies(const Formulation& plate, const Formulation& membrane, double rotary,
                                      const PointMatrix* geometric, const FrequencyOptions& options) {
  if (plate.distributed()) return shared_frequencies(plate, membrane, rotary, geometric, options);
  const CoupledUnknowns both(plate, membrane, membrane.constraints());
  const auto rigid = Index(pinned(membrane).held().size() - membrane.constraints().held().size());
  const Matrix M = both.matrix(stacked_mass(plate, rotary));
  Matrix K = both.stiffness();
  if (geometric) K += both.of_deflections(*geometric);
  FrequencySolution result;
  const MatrixXd vectors = lowest(K, M, rigid, both, options, result.solutions);
  for (Index i = 0; i < vectors.cols(); ++i) {
    const VectorXd x = vectors.col(i), Kx = product(K, x), Mx = product(M, x), bent = both.of_plate(x);
    const double kinetic = x.dot(Mx), square = x.dot(Kx) / kinetic;
    const double residual =
        norm(Kx - square * Mx, both.stiffness()) / ((square + options.shift) * norm(Mx, both.stiffness()));
    if (geometric && square < 0 && plate.held()) throw NumericalError(buckled);
    auto [bending, in_plane] = both.states(x);
    const VectorXd rest = x - bent;
    result.modes.push_back({std::sqrt(std::max(square, 0.0)) / (2 * std::numbers::pi), residual, std::move(bending),
                            std::move(in_plane), rest.dot(product(M, rest)) / kinetic});
  }
  result.iterations = result.solutions;
  return result;
}

Inertia coupled_inertia(const Formulation& plate, double rotary, const Constraints& constraints) {
  const PointMatrix mass = stacked_mass(plate, rotary);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block) {
    for (std::uint32_t c = 0; c < unknowns_per_point; ++c)  // of one component each
      if (const double m = block(c, c); m != 0)
        entries.emplace_back(int(index_in_state({row, c}, mass.points())),
                             int(index_in_state({column, c}, mass.points())), m);
  };
  for (std::uint32_t k = 0; k < mass.points(); ++k)
    for (auto b = mass.first[k]; b < mass.first[k + 1]; ++b) {
      add(mass.row[b], k, mass.block[b]);
      if (mass.row[b] != k) add(k, mass.row[b], mass.block[b]);
    }
  const auto values = Index(unknowns_per_point * mass.points());
  Matrix result(values, values);
  result.setFromTriplets(entries.begin(), entries.end());
  return {std::move(result), constraints};
}

std::vector<BucklingMode> coupled_buckling(const Formulation& plate, const Formulation& membrane,
                                           const PointMatrix& geometric, std::size_t modes, double tolerance) {
  constexpr double none = 1e-9;  // of the largest |1 / factor| of single points: rounding
  if (plate.distributed()) return shared_buckling(plate, membrane, geometric, modes, tolerance);
  const CoupledUnknowns both(plate, membrane, pinned(membrane));
  const Matrix &K = both.stiffness(), K_g = both.of_deflections(geometric);
  const auto [inverse_factors, vectors, solutions] =
      largest_eigenvectors(Matrix(-K_g), K, modes, tolerance, "buckling", both.constraints());
  const double largest = K_g.diagonal().cwiseAbs().cwiseQuotient(K.diagonal()).maxCoeff();
  std::vector<BucklingMode> result;
  for (Index i = 0; i < inverse_factors.size() && inverse_factors[i] > none * largest; ++i) {
    const VectorXd x = vectors.col(i), Kx = product(K, x);
    const double factor = 1 / inverse_factors[i];
    auto [bending, in_plane] = both.states(x);
    result.push_back(
        {factor, norm(Kx + factor * product(K_g, x), K) / norm(Kx, K), std::move(bending), std::move(in_plane)});
  }
  return result;
}

}  // namespace plate
