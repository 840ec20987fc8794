#pragma once
#include <future>

#include "cases/driver/assembly.hpp"
#include "cases/driver/moving_growth.hpp"
#include "cases/driver/tip_factors.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "post/files/hdf5.hpp"
#include "post/files/summary.hpp"
#include "post/files/vtk.hpp"

namespace cases {

/// The points of the plate about a place that no crack parts from it.
std::vector<post::Share> probe(const Assembly& assembly, const geometry::Point& at);

/// The cells that are drawn.
post::Mesh mesh_of(const Case& content, const Assembly& assembly);

/// The points of the plate at an instant; resultants and damage (zero) where they are wanted.
post::Frame frame_of(const Case& content, const Assembly& assembly, double time, std::size_t step, const plate::State& state,
                     bool resultants);

/// Completes the summary by what it says of the program and the machine, and writes it.
void write_summary(post::Summary& summary, const std::string& resolved, const Stopwatch& stopwatch,
                   const std::filesystem::path& folder);

/// What a run writes into its folder, as it goes: tables in memory, frames at once. Nothing that the case does not ask
/// for is computed.
class Results {
public:
  /// `methods` of every tip. All must outlive this.
  Results(const CaseFile& file, const Assembly& assembly, const std::vector<post::TipMethods>& methods, std::filesystem::path folder);

  /// Intensity factors of the same tips and methods with twice the spacing: the difference counts in estimated errors.
  void coarser(std::vector<post::Srif> srifs) { coarser_ = std::move(srifs); }
  /// Intensity factors of the same tips in another formulation, row by row, the recommended of each tip first.
  void second(std::string formulation, std::vector<std::vector<post::Srif>> rows) {
    second_ = {std::move(formulation), std::move(rows)};
  }
  /// The factors of all rows where they are known already, the recommended ones of each tip first, and how they were found.
  void known(std::vector<std::vector<post::Srif>> rows, post::AccuracySummary found) {
    known_ = std::move(rows), accuracy_ = std::move(found);
  }
  /// What the estimated errors of every tip miss of a motion: a share of the largest factor that the tip ever has.
  void truncated(std::vector<double> shares) { truncated_ = std::move(shares); }
  /// Those of every row so far.
  std::vector<std::vector<post::Srif>> srif_rows() && { return std::move(srif_rows_); }
  /// The growth of the run, which must outlive it.
  void grows(MovingGrowth& growth);
  /// A row of history, probes and intensity factors; of the last, all rings go into the summary.
  void sample(const plate::Instant& now, bool last);
  /// A frame for ParaView and HDF5, written while the solver goes on. What went wrong with a frame is thrown with the
  /// next one, or by finish().
  void frame(const plate::Instant& now);
  /// A row of frequencies.csv and a frame, number `number` (from 1).
  void mode(std::size_t number, const plate::Mode& mode);
  /// Writes the tables and, last, the summary; returns it complete.
  post::Summary finish(post::Summary summary, Stopwatch& stopwatch);

  double strain_energy() const { return strain_energy_; }

private:
  void wait_for_frame();
  void sample_probes(const plate::Instant& now);
  void sample_srifs(const plate::Instant& now, bool last);
  post::Table srif_table();
  std::vector<post::Srif> widened_srifs(const plate::State& state, bool all_rings) const;

  const Case& case_;
  const Assembly& assembly_;
  std::filesystem::path folder_;
  std::string resolved_;
  std::optional<post::VtkSeries> vtk_;
  std::optional<post::StateFile> hdf5_;
  std::vector<std::pair<std::string, std::vector<post::Share>>> probes_;
  const std::vector<post::TipMethods>& tip_methods_;
  post::Table history_, probe_table_, frequency_table_;
  std::vector<post::Srif> coarser_;
  std::vector<std::vector<post::Srif>> known_;
  std::vector<double> truncated_;
  std::optional<post::AccuracySummary> accuracy_;
  std::vector<std::vector<post::Srif>> srif_rows_;
  std::vector<double> largest_;  // of every tip so far: of |K1|, |K2|, |K3| h, by any method
  std::pair<std::string, std::vector<std::vector<post::Srif>>> second_;  // formulation, rows
  std::vector<post::Frequency> frequencies_;
  double strain_energy_ = 0;
  MovingGrowth* growth_ = nullptr;
  std::future<void> writing_;  // of the last frame; ends before what it writes to
};

}  // namespace cases
