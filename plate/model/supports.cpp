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

InPlane Support::held_in_plane() const {
  if (in_plane) return *in_plane;
  if (kind == SupportKind::symmetry) return InPlane::normal;
  return kind == SupportKind::in_plane ? InPlane::fixed : InPlane::free;
}

bool Support::holds_one_way() const {
  const auto held = held_in_plane();
  return held != InPlane::free && held != InPlane::fixed;
}

Held held_by(SupportKind kind) {
  using enum SupportKind;
  switch (kind) {
    case clamped:
    case clamped_layer:
    case hub:
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
    case in_plane:
    case u_alone:
    case v_alone:
      break;
  }
  return {};
}

Held held_in_plane(InPlane in_plane) {
  using enum InPlane;
  return {false, in_plane == fixed || in_plane == normal, in_plane == fixed || in_plane == tangential};
}

}  // namespace plate
