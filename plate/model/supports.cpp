#include "plate/model/supports.hpp"

namespace plate {

bool is_layer(SupportKind kind) {
  using enum SupportKind;
  return kind == clamped_layer || kind == simply_supported_layer || kind == simply_supported_hard_layer;
}

}  // namespace plate
