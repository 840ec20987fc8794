#pragma once
#include <memory>

#include "plate/bonds/family_operator.hpp"
#include "plate/bonds/levels/transfer.hpp"
#include "plate/formulation/boundary.hpp"

namespace plate {

/// The plate of every second point in both directions, R L R^T with an operator L, solved.
class CoarsePlate {
public:
  virtual ~CoarsePlate() = default;
  /// [3 x coarse points] both; zero where nothing has stiffness.
  virtual void solve(const Forces& force, State& u) const = 0;
  virtual std::size_t bytes() const = 0;
};

/// By its factor; where processes share the plate, by what they make of it together (Ranks::inverse), right at their
/// own points and the copies that they have. `transfer` and `boundary` must outlive it.
std::unique_ptr<CoarsePlate> coarse_plate(const Operator& L, const Transfer& transfer, const Boundary& boundary);

}  // namespace plate
