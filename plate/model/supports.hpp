#pragma once
#include <optional>
#include <string>
#include <vector>
#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"

namespace plate {

/// How an edge is held (theory.md, "Supports"); psi_n and psi_s: rotation along the normal and along the edge.
enum class SupportKind {
  free,
  clamped,                      // w = psi_n = psi_s = 0 on the line
  simply_supported,             // w = 0 on the line (soft)
  simply_supported_hard,        // w = psi_s = 0 on the line
  symmetry,                     // mirror plane
  clamped_layer,                // Dai et al.: all zero in a layer of one horizon outside the plate
  simply_supported_layer,       // Dai et al.: w = 0 in that layer
  simply_supported_hard_layer,  // w = psi_s = 0 in that layer
  pinned                        // w = 0 at single points, along lines or on parts of the plate
};

/// A support of named edges; or within the plate, pinned (w) or clamped (w and rotations), of single points, of a line
/// or of a part. One of the four is given.
struct Support {
  SupportKind kind = SupportKind::free;
  std::vector<std::string> edges;
  std::vector<geometry::Point> points;
  geometry::Polyline along = {};
  std::optional<geometry::Hole> patch = {};

  bool holds_edges() const { return kind != SupportKind::free && !edges.empty(); }
  /// Is there a line or a part of the plate that it holds?
  bool holds_inside() const { return !along.empty() || patch; }
};

/// Of the kinds that hold points outside the plate.
bool is_layer(SupportKind kind);

/// The kind that holds the same in a layer; the kind itself where there is none.
SupportKind in_layer(SupportKind kind);

}  // namespace plate
