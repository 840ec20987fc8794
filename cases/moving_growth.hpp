#pragma once
#include "cases/assembly.hpp"
#include "fracture/moving_cracks.hpp"
#include "post/frame.hpp"
#include "post/srif_methods.hpp"
#include "post/summary.hpp"
#include "post/table.hpp"

namespace cases {

/// Cracks that grow in a dynamic run: the plate whose bonds they sever, and what is written of them.
class MovingGrowth {
public:
  /// Both must outlive this; the plate is of bonds over a horizon.
  MovingGrowth(const CaseFile& file, const Assembly& assembly);

  const plate::Operator& plate() const { return plate_; }
  plate::Changes& changes() { return cracks_; }
  double fracture_energy() const { return cracks_.fracture_energy(); }

  /// Factors of the tips where they are now, by the methods of the case; none of tips beside edges and other cracks.
  std::vector<post::Srif> srifs(const plate::State& state) const;
  /// The cells between points that still see each other; sets the frame's resultants and damage.
  post::Mesh draw(post::Frame& frame, const plate::State& state) const;
  /// growth.csv and cracks.csv; with `lines` cracks.vtp.
  void write(const std::filesystem::path& folder, bool lines) const;
  post::GrowthSummary summary() const;

private:
  post::TipMethods methods(const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip,
                           const post::SrifOptions& options, double reach = INFINITY) const;
  fracture::Gauge gauge(const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip) const;

  const Case& case_;
  const Assembly& assembly_;
  fracture::SeveredPlate plate_;
  fracture::MovingCracks cracks_;
};

}  // namespace cases
