#pragma once
#include <filesystem>
#include <set>

#include "plate/model/point_map.hpp"
#include "post/files/frame.hpp"

namespace post {

/// Frames for ParaView: fields_NNNN.vtu (binary, compressed) and fields.pvd, which lists them with their times and is
/// written anew with each frame. Point data: w, theta (2 components), damage, cut, Mxx, Myy, Mxy, Qx, Qy, von_mises,
/// displacement (3 components: 0, 0, w); after the points of the plate come the corners of its cells on edges and
/// cracks. Where cracks change, cracks_NNNN.vtp and cracks.pvd beside them. Where the plate is distributed, each writes
/// its piece, fields_NNNN_RANK.vtu, and the first fields_NNNN.pvtu, which names the pieces. Collective: every rank must
/// call each member function.
class VtkSeries {
public:
  /// `mesh`: what this rank draws. `communicator` must outlive this.
  VtkSeries(std::filesystem::path folder, Mesh mesh, const plate::Communicator& communicator = plate::single_process());
  /// Sets the mesh of the frames from now on.
  void remesh(Mesh mesh) { mesh_ = std::move(mesh); }
  /// Throws std::invalid_argument where the values are not those of the points.
  void write(const Frame& frame);
  /// Continues after frames that an interrupted run has written; frames that are gone are removed from the list, and
  /// pieces of later ones are deleted.
  void go_on(std::vector<double> times);

private:
  std::filesystem::path folder_;
  Mesh mesh_;
  const plate::Communicator* communicator_;
  std::vector<double> times_;
  std::set<std::size_t> gone_;  // of the frames
};

/// A frame that was written, and the cells that it is drawn with.
struct Drawn {
  Mesh mesh;
  Frame frame;
};
/// The frames that fields.pvd lists, in their order; none without that file, or where each is in pieces.
std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder);
/// Throws std::runtime_error where the file is none of ours.
Drawn read_frame(const std::filesystem::path& path);

/// cracks.vtp: lines, and tips as vertices. Cell data: crack and tip, their numbers; tip is -1 at a line. Point
/// data: advance (at which a vertex was reached), tip; K1, K2, K3 at tips, where they are known, else not a number.
void write_cracks(const std::filesystem::path& path, const Cracks& cracks);

}  // namespace post
