#pragma once
#include "cases/assembly.hpp"
#include "plate/frequencies.hpp"
#include "post/hdf5.hpp"
#include "post/summary.hpp"
#include "post/vtk.hpp"

namespace cases {

/// One intensity factor extraction per tip and method, set up before anything is solved.
/// Throws CaseError where a tip has too few points beside its crack.
std::vector<post::DisplacementExtrapolation> extrapolations(const CaseFile& file,
                                                            const std::vector<geometry::Point>& positions,
                                                            const std::vector<geometry::CrackPath>& paths);

/// What a run writes into its folder, as it goes: tables in memory, frames at once. Nothing that the case does not ask
/// for is computed.
class Results {
public:
  Results(const CaseFile& file, const Assembly& assembly, std::filesystem::path folder);

  /// A row of history, probes and intensity factors.
  void sample(const plate::Instant& now);
  /// A frame for ParaView and HDF5.
  void frame(const plate::Instant& now);
  /// A row of frequencies.csv and a frame, number `number` (from 1).
  void mode(std::size_t number, const plate::Mode& mode);
  /// Writes the tables and, last, the summary; returns it complete.
  post::Summary finish(post::Summary summary, Stopwatch& stopwatch);

  double strain_energy() const { return strain_energy_; }

private:
  void sample_probes(const plate::Instant& now);
  void sample_srifs(const plate::Instant& now);

  const Case& case_;
  const Assembly& assembly_;
  std::filesystem::path folder_;
  std::string resolved_;
  std::optional<post::VtkSeries> vtk_;
  std::optional<post::StateFile> hdf5_;
  std::vector<std::pair<std::string, std::vector<post::Share>>> probes_;
  std::vector<post::DisplacementExtrapolation> extrapolations_;
  post::Table history_, probe_table_, srif_table_, frequency_table_;
  std::vector<post::Srif> latest_;
  std::vector<post::Frequency> frequencies_;
  double strain_energy_ = 0;
};

}  // namespace cases
