#pragma once
#include <vector>

#include "post/files/recorder.hpp"
#include "post/files/summary.hpp"

namespace plate {
struct Boundary;
}

namespace post {

struct Frame;

/// Deflection, rotations, moments, forces and von Mises stress of a frame at probes, with u, v and membrane forces
/// where loads act in the plane. `boundary`: of the points of the frame.
std::vector<ProbeValue> values_at(const std::vector<Probe>& probes, const Frame& frame,
                                  const plate::Boundary& boundary);

/// Sets the estimated errors of the results of a plate at rest, or of its frequencies: the share of the difference from
/// those of other points. Two values may agree by chance, so that deflections, rotations and strain energy have at
/// least the largest relative difference among them, and so have reactions, forces in the plane, moments; a frequency
/// has at least that of the modes below. `size` of the plate [length], between forces and moments.
void set_errors(Summary& summary, const OtherResults& other, double size);

}  // namespace post
