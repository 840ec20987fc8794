#pragma once
#include <filesystem>
#include <memory>
#include "post/files/frame.hpp"
#include "post/files/hdf5/in_parts.hpp"
#include "post/files/table.hpp"

namespace post {

/// state.h5: points (positions, areas, cut), every written frame (time, step, state, moments, shear_forces, von_mises),
/// tables (history, probes, srif), the text of the resolved case; each dataset with attributes `unit` and
/// `description`, those of points with checksums. Written beside, as state.h5.0 and so on, and put in its place by
/// close().
/// Throws std::runtime_error where HDF5 fails.
class StateFile {
public:
  struct Options {
    std::filesystem::path path;
    std::string resolved_case, version;
    bool velocities = false;  // of motions, with every frame
    bool goes_on = false;     // with the file of a run that was ended
  };
  /// What it holds of points: x, y; area; share that is cut. They are asked for one after the other.
  struct Points {
    std::size_t count = 0;
    InParts positions, areas, cut;
  };
  /// A frame: w, theta_x, theta_y of every point, where velocities are stored their rates, and the resultants. They are
  /// asked for one after the other.
  struct Motion {
    double time = 0;
    std::size_t step = 0, points = 0;
    InParts state, velocity, moments, shear_forces, von_mises;
  };
  StateFile(Options options, const Mesh& mesh);
  StateFile(Options options, const Points& points);
  ~StateFile();
  StateFile(StateFile&&) noexcept;

  /// After so many frames that a run had written by its last part(); further ones are dropped.
  void go_on(std::size_t frames);
  /// The frames so far are what another process can go on after, from now on.
  void part();
  /// Throws std::invalid_argument where velocities or resultants are not those of the points.
  void write(const Frame& frame, const plate::State* velocity);
  void write(const Motion& frame);
  /// No frame comes after a table.
  void write(const std::string& name, const Table& table);
  void close();

  /// The open file (files.hpp).
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
  std::unique_ptr<Open> open_;
};

/// What `pdplate srif` needs of a finished run.
struct StoredRun {
  std::vector<Eigen::Vector2d> positions;
  std::vector<double> times;
  std::vector<plate::State> states;
  std::string resolved_case = {};
};

/// Throws std::runtime_error where the file is damaged, or the case beside it is not the one that it is of.
StoredRun read_run(const std::filesystem::path& path);

}  // namespace post
