#include "plate/solve/coupled_plate.hpp"

#include <stdexcept>

#include "plate/formulation/formulation.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

PointMatrix stacked_matrix(const PointMatrix& plate, const PointMatrix& plane, const PointMatrix& coupling) {
  const auto points = std::uint32_t(plate.points());
  PointMatrix result;
  const auto take = [&](std::uint32_t row, const Eigen::Matrix3d& block) {
    result.row.push_back(row), result.block.push_back(block);
  };
  struct Above {
    std::uint32_t row;
    std::size_t block;
  };
  std::vector<std::vector<Above>> above(points);  // by columns, ascending
  for (std::uint32_t k = 0; k < points; ++k)
    for (auto b = coupling.first[k]; b < coupling.first[k + 1]; ++b)
      if (coupling.row[b] != k) above[coupling.row[b]].push_back({k, b});
  for (std::uint32_t k = 0; k < points; ++k) {
    for (auto b = plate.first[k]; b < plate.first[k + 1]; ++b) take(plate.row[b], plate.block[b]);
    for (const auto& [row, b] : above[k]) take(points + row, coupling.block[b].transpose());
    for (auto b = coupling.first[k]; b < coupling.first[k + 1]; ++b) take(points + coupling.row[b], coupling.block[b]);
    result.first.push_back(result.row.size());
  }
  for (std::uint32_t k = 0; k < points; ++k) {
    for (auto b = plane.first[k]; b < plane.first[k + 1]; ++b) take(points + plane.row[b], plane.block[b]);
    result.first.push_back(result.row.size());
  }
  return result;
}

PointMatrix Formulation::coupling() const {
  throw std::logic_error("a coupling was asked of a formulation that does not offer it");
}

MassOffsets Formulation::mass_offsets() const {
  throw std::logic_error("mass off the middle plane was asked of a formulation that does not offer it");
}

PointMatrix Formulation::with_coupling_forces(PointMatrix, const State&, const State&) const {
  throw std::logic_error("forces of a coupling were asked of a formulation that does not offer it");
}

PointMatrix Stretching::stiffness_of_forces(const Eigen::Matrix3Xd&) const {
  throw std::logic_error("given membrane forces were asked of a formulation that does not offer them");
}

/// The stiffness of stacked states.
class CoupledPlate::Both : public Operator {
public:
  Both(const Formulation& plate, const Formulation& membrane, const PointMatrix& coupling)
      : plate_(plate), membrane_(membrane), coupling_(coupling) {}

  std::size_t points() const override { return 2 * plate_.points(); }
  void internal_force(const State& state, Forces& forces) const override {
    const State bending = of_plate(state), in_plane = of_plane(state);
    Forces on_bending, on_membrane;
    plate_.internal_force(bending, on_bending), membrane_.internal_force(in_plane, on_membrane);
    forces = stacked(on_bending - product(coupling_, in_plane), on_membrane - product(coupling_, bending));
  }
  void absolute_product(const State& state, Forces& forces) const override {
    PointMatrix sizes = coupling_;
    for (auto& block : sizes.block) block = block.cwiseAbs().eval();
    const State bending = of_plate(state), in_plane = of_plane(state);
    Forces on_bending, on_membrane;
    plate_.absolute_product(bending, on_bending), membrane_.absolute_product(in_plane, on_membrane);
    forces = stacked(on_bending + product(sizes, in_plane), on_membrane + product(sizes, bending));
  }
  Forces diagonal() const override { return stacked(plate_.diagonal(), membrane_.diagonal()); }

private:
  const Formulation &plate_, &membrane_;
  const PointMatrix& coupling_;
};

std::unique_ptr<const Operator> CoupledPlate::stiffness(const Formulation& plate, const Formulation& membrane,
                                                        const PointMatrix& coupling) {
  return std::make_unique<const Both>(plate, membrane, coupling);
}

CoupledPlate::CoupledPlate(const Formulation& plate, const Formulation& membrane)
    : plate_(plate), membrane_(membrane), coupling_(plate.coupling()) {
  constraints_ = stacked(plate.constraints(), pinned(membrane), plate.points());
  both_ = std::make_unique<const Both>(plate, membrane, coupling_);
  factor_ = std::make_unique<const AssembledPlate>(*both_, constraints_,
                                                   stacked_matrix(plate.stiffness(), membrane.stiffness(), coupling_),
                                                   plate.distributed() ? &plate.boundary() : nullptr);
}

CoupledPlate::~CoupledPlate() = default;

const Operator& CoupledPlate::of_both() const {
  return *both_;
}

const Preconditioner& CoupledPlate::inverse() const {
  return *factor_;
}

std::size_t CoupledPlate::factor_bytes() const {
  return factor_->bytes();
}

/// The second solution takes out what rounding beside the forces of the lift has left.
StaticSolution CoupledPlate::lifted(const PlateLoads& loads, const StaticOptions& options, const State& lift) const {
  const Forces load = stacked(loads.across, loads.in_plane);
  if (lift.cols() == 0) return refined(*both_, constraints_, load, options, *factor_);
  StaticSolution result;
  result.state = stacked(lift, zero_like(lift)), result.converged = true;
  for (int twice = 0; twice < 2 && result.converged; ++twice) {
    Forces left;
    both_->internal_force(result.state, left);
    const auto more = refined(*both_, constraints_, left + load, options, *factor_);
    result.state += more.state, result.iterations += more.iterations;
    result.converged = more.converged, result.stop_reason = more.stop_reason;
  }
  const Forces across = loads.across - product(coupling_, of_plane(result.state));
  result.residual = PrescribedDisplacements(plate_, across, lift).residual(of_plate(result.state)).share;
  return result;
}

CoupledEquilibrium CoupledPlate::equilibrium(const PlateLoads& loads, const StaticOptions& options,
                                             const State& lift) const {
  const auto [rigid, rest] = split_lift(plate_, lift);
  CoupledEquilibrium result;
  result.of_both = lifted(loads, options, rest);
  result.bending = of_plate(result.of_both.state), result.membrane = of_plane(result.of_both.state);
  result.on_bending = -product(coupling_, result.membrane), result.on_membrane = -product(coupling_, result.bending);
  result.bending_energy = plate_.strain_energy(result.bending);
  result.stretching_energy = membrane_.strain_energy(result.membrane);
  result.coupling_energy =
      -plate_.sum_of_points(result.on_bending.cwiseProduct(result.bending).colwise().sum().transpose());
  if (rigid.cols() > 0) result.strained = result.bending, result.bending += rigid;
  return result;
}

}  // namespace plate
