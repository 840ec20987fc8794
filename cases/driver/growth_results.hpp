#pragma once
#include <memory>

#include "cases/driver/results.hpp"
#include "fracture/growth/quasi_static.hpp"

namespace cases {

/// A plate whose cracks have grown so far, under the whole load.
struct GrownPlate {
  CaseFile file;  // with the cracks as they are
  Assembly assembly;
  plate::State state;
  std::vector<post::Srif> srifs;  // the recommended one of each tip first
};

/// What a growth at rest writes into its folder: growth.csv, cracks.csv, cracks.vtp and what Results writes, with the number of
/// the advance in the place of time.
class GrowthResults {
public:
  GrowthResults(const CaseFile& file, std::filesystem::path folder);

  void event(const fracture::Event& event, const std::shared_ptr<const GrownPlate>& plate);
  /// The last state, the tables and, last, the summary; returns it complete.
  post::Summary finish(post::Summary summary, const fracture::Grown& grown, Stopwatch& stopwatch);

  double load_factor() const { return factor_; }

private:
  void frame();
  void write_state() const;
  void tips(const fracture::Event& event, const GrownPlate& plate);
  void cracks(const fracture::Event& event);

  const CaseFile& file_;
  std::filesystem::path folder_;
  std::string resolved_;
  post::Table growth_, history_, probes_, srifs_;
  std::vector<post::CrackLine> lines_;
  std::optional<post::VtkSeries> vtk_;
  std::vector<double> first_cut_;                    // of bonds over a horizon: at the start
  std::shared_ptr<const GrownPlate> last_;           // of the last event
  std::size_t advance_ = 0;                          // of that
  double factor_ = 0;
  bool framed_ = false;
  double first_factor_ = 0, largest_factor_ = 0;
};

}  // namespace cases
