#include "plate/model/faults/held.hpp"

namespace plate {

Held held_by(SupportKind kind) {
  using enum SupportKind;
  switch (kind) {
    case clamped:
    case clamped_layer:
      return {true, true, true};
    case simply_supported:
    case simply_supported_layer:
      return {true, false, false};
    case simply_supported_hard:
    case simply_supported_hard_layer:
      return {true, false, true};
    case symmetry:
      return {false, true, false};
    case free:
    case pinned:
      break;
  }
  return {};
}

}  // namespace plate
