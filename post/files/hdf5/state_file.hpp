#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "plate/model/point_map.hpp"
#include "post/files/frame.hpp"
#include "post/files/table.hpp"

namespace post {
class PointOrder;

/// Numbers of points as state.h5 takes them: of `count` points from `first` on, point by point, in the order of the
/// file. It asks from the first to the last, for points_at_once of them but at the end, and each part once; what it has
/// been given may be gone when it asks for the next.
using InParts = std::function<std::span<const double>(std::size_t first, std::size_t count)>;

/// Points that are written, and stored, together: 1.5 MB of a state.
constexpr std::size_t points_at_once = std::size_t(1) << 16;

/// Calls visit(first, count) for the parts of so many points.
template <typename Visit>
void for_each_part(std::size_t points, const Visit& visit) {
  for (std::size_t first = 0; first < points; first += points_at_once)
    visit(first, points - first < points_at_once ? points - first : points_at_once);
}

/// state.h5: points (positions, areas, cut), every written frame (time, step, state, moments, shear_forces, von_mises;
/// where loads act in the plane displacement and membrane_forces), tables (history, probes, srif), the text of the
/// resolved case; each dataset with attributes `unit` and `description`, those of points with checksums. Written
/// beside, as state.h5.0 and so on, and put in its place by close(). Where the plate is distributed the first writes,
/// and the others send it their points, points_at_once of all, so that none holds more than that of others' points;
/// then constructor and write(frame) are collective. Throws std::runtime_error where HDF5 fails.
class StateFile {
public:
  struct Options {
    std::filesystem::path path;
    std::string resolved_case, version;
    bool velocities = false;  // of motions, with every frame
    bool goes_on = false;     // with the file of a run that was ended
    bool in_plane = false;    // displacements and membrane forces there, with every frame
  };
  /// Data of the points in the file: x, y; area; cut share of the family. They are requested one after the other.
  struct Points {
    std::size_t count = 0;
    InParts positions, areas, cut;
  };
  /// A frame: w, theta_x, theta_y of every point, where velocities are stored their rates, the resultants, and where
  /// fields in the plane are stored u, v and Nxx, Nyy, Nxy. They are asked for one after the other.
  struct Motion {
    double time = 0;
    std::size_t step = 0, points = 0;
    InParts state, velocity, moments, shear_forces, von_mises, displacement, membrane_forces;
  };
  /// `mesh`: with the rank's owned points first. `communicator` must outlive this.
  StateFile(Options options, const Mesh& mesh, const plate::Communicator& communicator = plate::single_process());
  ~StateFile();
  StateFile(StateFile&&) noexcept;

  /// Continues after so many frames that a run had written by its last part(); further ones are dropped.
  void go_on(std::size_t frames);
  /// The frames so far are what another process can go on after, from now on.
  void part();
  /// `velocity`: null where none are stored. Throws std::invalid_argument where velocities, resultants or fields in the
  /// plane are not those of the points.
  void write(const Frame& frame, const plate::State* velocity);
  /// Writes a table; no frame comes after it.
  void write(const std::string& name, const Table& table);
  void close();

  /// The open file.
  class Open {
  public:
    virtual ~Open() = default;
    virtual void go_on(std::size_t frames) = 0;
    virtual void part() = 0;
    virtual void write(const Motion& frame) = 0;
    virtual void write(const std::string& name, const Table& table) = 0;
    virtual void close() = 0;
  };

private:
  using Numbers = std::function<void(std::size_t k, double* to)>;
  InParts parts(std::size_t width, Numbers numbers);
  template <typename Rows>
  InParts parts(const Rows& rows);

  std::unique_ptr<const PointOrder> order_;
  Eigen::Index own_;            // points of the rank: the first columns of a frame
  bool others_follow_;          // behind them
  bool in_plane_;               // fields in the plane are stored
  std::vector<double> room_;    // the part in hand
  std::unique_ptr<Open> open_;  // of the first rank
};

/// Data of a finished run that `pdplate srif` needs.
struct StoredRun {
  std::vector<Eigen::Vector2d> positions;
  std::vector<double> times;
  std::vector<plate::State> states;
  std::string resolved_case = {};
  std::vector<Eigen::Matrix2Xd> displacements = {};  // u, v, where they are stored
};

/// Functions that need HDF5, in a library that is loaded where state.h5 is first written or read: the system takes as
/// long to map the libraries behind HDF5 as a small plate takes to be solved.
struct Files {
  std::unique_ptr<StateFile::Open> (*open)(StateFile::Options options, const StateFile::Points& points);
  StoredRun (*read_run)(const std::filesystem::path& path);
};

/// Throws std::runtime_error where the file is damaged, or the case beside it is not the one that it is of.
StoredRun read_run(const std::filesystem::path& path);

}  // namespace post
