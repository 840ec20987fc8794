#pragma once
#include "plate/model/supports.hpp"

namespace plate {

/// What a support holds of the line of an edge: w, the rotation psi_n along its normal, psi_s along it.
struct Held {
  bool w = false, normal = false, tangential = false;
};

Held held_by(SupportKind kind);

}  // namespace plate
