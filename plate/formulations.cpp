#include "plate/formulations.hpp"

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/galerkin/galerkin_plate.hpp"

namespace plate {

const std::vector<const FormulationKind*>& formulations() {
  static const std::vector<const FormulationKind*> known{&galerkin, &ordinary};
  return known;
}

}  // namespace plate
