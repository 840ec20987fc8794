#include "plate/model/supports.hpp"

namespace plate {

bool is_layer(SupportKind kind) {
  using enum SupportKind;
  return kind == clamped_layer || kind == simply_supported_layer || kind == simply_supported_hard_layer;
}

SupportKind in_layer(SupportKind kind) {
  using enum SupportKind;
  if (kind == clamped) return clamped_layer;
  if (kind == simply_supported) return simply_supported_layer;
  return kind == simply_supported_hard ? simply_supported_hard_layer : kind;
}

}  // namespace plate
