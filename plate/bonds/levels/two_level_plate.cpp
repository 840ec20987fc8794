#include "plate/bonds/levels/two_level_plate.hpp"

#include "plate/bonds/rows/lattice_operator.hpp"

namespace plate {
namespace {

constexpr int sweeps = 2;       // before and after
constexpr double weight = 0.6;  // of a sweep

}  // namespace

TwoLevelPlate::TwoLevelPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                             const Discretization& discretization)
    : plate_(plate, plate.attached(), everywhere(plate.attached())),
      constraints_(boundary.constraints),
      transfer_(plate.families(), boundary) {
  const Forces diagonal = folded_diagonal(plate, constraints_);
  inverse_diagonal_ = diagonal.unaryExpr([](double d) { return d > 0 ? weight / d : 0.0; });
  const LatticeOperator local(local_operator(plate, boundary, section, discretization));
  const TouchedPlate touched(local, local.attached(), everywhere(local.attached()));
  coarse_plate_ = coarse_plate(touched, transfer_, boundary);
}

void TwoLevelPlate::apply(const Forces& residual, State& result) const {
  const auto subtract_product = [&] {  // rest = residual - K result
    constraints_.impose(result);
    plate_.internal_force(result, product_);
    constraints_.fold(product_);
    rest_ = residual + product_;
  };
  result = inverse_diagonal_.cwiseProduct(residual);
  for (int i = 1; i < sweeps; ++i) {
    subtract_product();
    result += inverse_diagonal_.cwiseProduct(rest_);
  }
  subtract_product();
  constraints_.fetch(rest_);
  transfer_.restrict_to(coarse_force_, rest_);
  coarse_plate_->solve(coarse_force_, coarse_);
  transfer_.prolong(coarse_, result);
  for (int i = 0; i < sweeps; ++i) {
    subtract_product();
    result += inverse_diagonal_.cwiseProduct(rest_);
  }
}

}  // namespace plate
