#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plate/formulation/interpolation.hpp"
#include "plate/solve/archive_types.hpp"
#include "post/files/frame.hpp"
#include "post/files/processes.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace plate {
class Formulation;
class Stopwatch;
struct Boundary;
struct Heat;
}  // namespace plate

namespace post {

/// Destination of the results of a run: a folder, or memory.
class Sink {
public:
  using Tables = std::vector<std::pair<std::string, const Table*>>;  // name, rows

  virtual ~Sink() = default;

  /// True where frames with resultants and cells are wanted.
  virtual bool draws() const = 0;
  /// True where states are wanted to continue from.
  virtual bool stores() const = 0;
  /// True where plots are wanted.
  virtual bool plots() const = 0;

  /// The points and cells of all frames that bring none of their own, and the points of what is stored.
  virtual void open(const Mesh& mesh) = 0;
  /// Takes a frame, with separate cells where they are given.
  virtual void frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) = 0;
  /// The state of a run whose points are not the same throughout.
  virtual void final_state(const Mesh& mesh, const Frame& frame) = 0;
  /// Lines and tips, with the factors that are known; where frames are wanted.
  virtual void cracks(const Cracks& cracks) = 0;
  /// A drawing or a page: NAME.svg
  virtual void plot(const std::string& name, const std::string& svg) = 0;
  /// Takes all tables; no frame comes after them.
  virtual void tables(const Tables& tables) = 0;
  /// The last.
  virtual void summary(const std::string& json) = 0;

  // Of sinks that keep what they have got when the process is killed:
  /// Times of the frames that have been given, all of which are written when this returns.
  virtual std::vector<double> written() { return {}; }
  /// The frames of these times were written before the run was ended.
  virtual void go_on([[maybe_unused]] const std::vector<double>& times) {}
};

/// A row of history.csv: one instant. What does not exist in an analysis stays empty.
struct Sample {
  double time;
  std::size_t step;
  const plate::State& state;
  double strain_energy, kinetic_energy, external_work, fracture_energy;
  std::optional<double> discrete_energy = {}, energy_residual = {};  // in motion
  std::optional<double> dissipated_energy = {};                      // of a damped motion, or one with contact
  const Eigen::Matrix2Xd* in_plane = nullptr;  // u, v of every point, where loads act in the plane
  std::optional<double> released_energy = {}, load_factor = {}, displacement = {};  // of a quasi-static growth
  std::optional<double> contact_energy = {};  // part of what is dissipated by faces of cracks that meet
};

/// The points of the plate at an instant, with resultants and damage (zero) where they are wanted; `heat`: what
/// temperatures do to it then.
Frame frame_of(const plate::Formulation& plate, double time, std::size_t step, const plate::State& state,
               bool resultants, const plate::Heat* heat = nullptr);

/// The points of the plate without cells: what state.h5 holds of them.
Mesh points_of(const plate::Formulation& plate);

/// A place whose displacements are wanted, and the points that give them.
struct Probe {
  std::string name;
  geometry::Point position;
  std::vector<plate::PlaceShare> shares;
};

/// The results of a run as they come: rows stay in memory, frames go on to the sink at once, and everything at the end,
/// also after a failure. Nothing that is not asked for is computed.
class Recorder {
public:
  /// `resolved`: the whole case as text; `version` of the program.
  Recorder(std::unique_ptr<Sink> sink, std::string resolved, std::string version, ProcessesOfRun processes = {});

  /// The cells that are drawn, and the points of the states in state.h5, which are those of all frames. Without it
  /// frames are drawn with cells of their own, and state.h5 holds one state, given to final_state().
  void open(const plate::Mesh& mesh) { sink_->open(mesh); }
  void final_state(const plate::Mesh& mesh, const Frame& frame) { sink_->final_state(mesh, frame); }

  /// A row of history.csv and of probes.csv, of a state of this boundary. Throws plate::NumericalError where a number
  /// is not finite.
  void row(const Sample& sample, const std::vector<Probe>& probes, const plate::Boundary& boundary);
  /// A row of frequencies.csv.
  void mode(const Frequency& mode);

  bool draws() const { return sink_->draws(); }
  bool stores() const { return sink_->stores(); }
  bool plots() const { return sink_->plots(); }
  /// True in the process that writes what all share.
  bool on_first_process() const { return processes_.first(); }
  /// A frame, with other cells where they are given. What went wrong with it is thrown with the next one, or by
  /// finish().
  void frame(Frame frame, std::optional<plate::Mesh> mesh, plate::State velocity);

  /// Adds another table, NAME.csv.
  void table(const std::string& name, Table content) { tables_.emplace_back(name, std::move(content)); }
  /// Records the cracks where fields are wanted.
  void cracks(Cracks cracks, const std::vector<Srif>& factors);
  /// NAME.svg.
  void picture(const std::string& name, const std::string& svg) { sink_->plot(name, svg); }

  /// Writes the tables and, last, the summary; returns it complete.
  Summary finish(Summary summary, plate::Stopwatch& stopwatch);

  const Table& history() const { return history_; }

  /// Saves what has been recorded; on return all frames so far are written.
  void save(plate::OutArchive& archive);
  /// Restores what has been recorded, after open().
  void restore(plate::InArchive& archive);

private:
  std::unique_ptr<Sink> sink_;
  ProcessesOfRun processes_;
  std::string resolved_, version_;
  Table history_, probes_, frequencies_;
  std::vector<std::pair<std::string, Table>> tables_;
};

}  // namespace post
