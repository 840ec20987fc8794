#pragma once
#include <filesystem>
#include <future>

#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "post/files/frame.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/files/vtk/series.hpp"

namespace plate {
class Formulation;
}

namespace post {

/// What a recorder writes, and where to.
struct RecorderOptions {
  std::filesystem::path folder;
  std::string resolved, version;  // the whole case as text; of the program
  bool vtk = true, hdf5 = true;
  bool velocities = false;  // in state.h5
};

/// A row of history.csv: one instant. What does not exist in an analysis stays empty.
struct Sample {
  double time;
  std::size_t step;
  const plate::State& state;
  double strain_energy, kinetic_energy, external_work, fracture_energy;
  std::optional<double> discrete_energy = {}, energy_residual = {};                 // in motion
  std::optional<double> released_energy = {}, load_factor = {}, displacement = {};  // of a quasi-static growth
};

/// The points of the plate at an instant, with resultants and damage (zero) where they are wanted.
Frame frame_of(const plate::Formulation& plate, double time, std::size_t step, const plate::State& state,
               bool resultants);

/// A place whose displacements are wanted, and the points that give them.
struct Probe {
  std::string name;
  geometry::Point position;
  std::vector<plate::Share> shares;
};

/// The results of a run as they come: rows in memory, frames at once, and everything whole at the end, also after a
/// failure. Nothing that is not asked for is computed.
class Recorder {
public:
  /// Makes the folder and writes the case into it.
  explicit Recorder(RecorderOptions options);

  /// The cells that are drawn, and the points of the states in state.h5, which are those of all frames.
  void open(const plate::Mesh& mesh);
  /// Frames are drawn with cells of their own, and state.h5 holds one state, given to final_state().
  void open();
  void final_state(const plate::Mesh& mesh, const Frame& frame);

  /// A row of history.csv and of probes.csv. Throws plate::NumericalError where a number is not finite.
  void row(const Sample& sample, const std::vector<Probe>& probes, std::size_t plate_points);
  /// A row of frequencies.csv.
  void mode(const Frequency& mode);

  bool draws() const { return options_.vtk; }
  /// A frame for ParaView, with other cells where they are given, and for HDF5; written while the solver goes on. What
  /// went wrong with a frame is thrown with the next one, or by finish().
  void frame(Frame frame, std::optional<plate::Mesh> mesh, plate::State velocity);

  /// Another table, NAME.csv.
  void table(const std::string& name, Table content) { tables_.emplace_back(name, std::move(content)); }
  /// cracks.vtp, where fields are for ParaView.
  void cracks(Cracks cracks, const std::vector<Srif>& factors);
  /// NAME.svg.
  void picture(const std::string& name, const std::string& svg);

  /// Writes the tables and, last, the summary; returns it complete.
  Summary finish(Summary summary, plate::Stopwatch& stopwatch);

  const Table& history() const { return history_; }

private:
  void wait_for_frame();

  RecorderOptions options_;
  std::optional<VtkSeries> vtk_;
  std::optional<StateFile> hdf5_;
  Table history_, probes_, frequencies_;
  std::vector<std::pair<std::string, Table>> tables_;
  std::future<void> writing_;  // of the last frame; ends before what it writes to
};

}  // namespace post
