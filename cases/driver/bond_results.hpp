#pragma once
#include "cases/driver/bond_cracks.hpp"
#include "cases/driver/results.hpp"
#include "fracture/growth/bonds_at_rest.hpp"

namespace cases {

/// What bonds that break at rest leave in the folder of a run: growth.csv, tips.csv, cracks.csv, cracks.vtp and what Results
/// writes, with the number of the advance in the place of time.
class BondResults {
public:
  /// All must outlive this.
  BondResults(const CaseFile& file, const Assembly& assembly, const fracture::SeveredPlate& plate, BondCracks& cracks,
              std::filesystem::path folder);

  /// Before its bonds break. `new_lines`: the cracks are others than at the last event; `last`: no bond breaks any more.
  void event(const fracture::BondEvent& event, bool new_lines, bool last);
  /// The tables and, last, the summary; returns it complete.
  post::Summary finish(post::Summary summary, const std::string& outcome, Stopwatch& stopwatch);

private:
  void row(const fracture::BondEvent& event);
  void factors(double factor, const plate::State& state);
  void frame();

  const CaseFile& file_;
  const Assembly& assembly_;
  const fracture::SeveredPlate& plate_;
  BondCracks& cracks_;
  std::filesystem::path folder_;
  std::string resolved_;
  std::vector<std::pair<std::string, std::vector<post::Share>>> probes_;
  post::Table growth_, history_, probe_table_, srifs_;
  std::optional<post::VtkSeries> vtk_;
  std::vector<post::Srif> latest_;
  plate::State state_;  // of the last event
  std::size_t advance_ = 0;
  bool framed_ = false;
  fracture::Ledger books_;  // of the last event
  std::optional<double> first_factor_;
  double largest_factor_ = 0;
};

}  // namespace cases
