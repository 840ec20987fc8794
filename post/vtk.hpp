#pragma once
#include "post/frame.hpp"
#include <filesystem>

namespace post {

/// Frames for ParaView: fields_NNNN.vtu (binary, compressed) and fields.pvd, which lists them with their times and is
/// written anew with each frame. Point data: w, theta (2 components), damage, cut, Mxx, Myy, Mxy, Qx, Qy, von_mises,
/// displacement (3 components: 0, 0, w).
class VtkSeries {
public:
  VtkSeries(std::filesystem::path folder, Mesh mesh);
  void write(const Frame& frame);

private:
  std::filesystem::path folder_;
  Mesh mesh_;
  std::vector<double> times_;
};

}  // namespace post
