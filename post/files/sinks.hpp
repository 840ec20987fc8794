#pragma once
#include <filesystem>
#include <future>

#include "post/files/hdf5/state_file.hpp"
#include "post/files/recorder.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/vtk_series.hpp"

namespace post {

/// Keeps results in a value that outlives it.
class MemorySink : public Sink {
public:
  explicit MemorySink(ResultsInMemory& in_memory) : in_memory_(in_memory) {}

  bool draws() const override { return in_memory_.wants_fields; }
  bool stores() const override { return false; }
  bool plots() const override { return false; }
  void open(const Mesh& mesh) override { mesh_ = mesh; }
  void frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) override;
  void final_state(const Mesh&, const Frame&) override {}
  void cracks(const Cracks& cracks) override;
  void plot(const std::string&, const std::string&) override {}
  void tables(const Tables& tables) override;
  void summary(const std::string& json) override { in_memory_.summary = json; }

private:
  ResultsInMemory& in_memory_;
  Mesh mesh_;
};

/// Options of the results that are written into a folder.
struct FolderOptions {
  std::filesystem::path folder;
  bool vtk = true, hdf5 = true;
  StateFile::Options state;  // of state.h5 there
  const plate::Communicator* communicator = &plate::single_process();
};

/// The results of a run as files. A single process writes a frame while the solver goes on: what went wrong with it is
/// thrown with the next one, or with the tables. Where the plate is distributed, all write their points and cells, and
/// the first rank everything else; collective.
class Folder : public Sink {
public:
  /// Writes the case into the folder, which is there and locked for this. `lock`: of the first rank alone.
  Folder(FolderOptions options, std::optional<FolderLock> lock);

  bool draws() const override { return options_.vtk; }
  bool stores() const override { return options_.hdf5; }
  bool plots() const override { return options_.vtk && lock_; }
  void open(const Mesh& mesh) override;
  void frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) override;
  void final_state(const Mesh& mesh, const Frame& frame) override;
  void cracks(const Cracks& cracks) override;
  void plot(const std::string& name, const std::string& svg) override;
  void tables(const Tables& tables) override;
  void summary(const std::string& json) override;
  std::vector<double> written() override;
  void go_on(const std::vector<double>& times) override;

private:
  void wait_for_frame();

  FolderOptions options_;
  std::optional<FolderLock> lock_;
  std::optional<VtkSeries> vtk_;
  std::optional<StateFile> hdf5_;
  std::vector<double> times_;  // of the frames
  std::future<void> writing_;  // of the last frame; ends before what it writes to
};

}  // namespace post
