#pragma once
#include <deque>

#include "fracture/growth/bond_failure.hpp"
#include "fracture/growth/record.hpp"
#include "geometry/shape/crack_graph.hpp"
#include "plate/formulation/formulation.hpp"

namespace fracture {

/// A tip of broken bonds, as it was last seen.
struct BondTip {
  std::size_t number;
  geometry::Tip tip;                                        // its crack: which line
  double speed = 0;                                         // over the last eight spacings of its way, 0 before
  std::deque<std::pair<double, geometry::Point>> way = {};  // time and place of earlier looks
};

/// The cracks that broken bonds make: lines, tips and where they have been.
class BondCracks {
public:
  /// The cracks of an plate, which must outlive this. `fastest`: speed that no tip exceeds between two looks; none: at
  /// rest.
  explicit BondCracks(const plate::Formulation& plate, std::optional<double> fastest = std::nullopt);

  /// Bonds that have broken. True where some of them were between neighbours, so that the lines have changed.
  bool broke(const std::vector<LoadedBond>& bonds, double time);
  /// Looks where the tips are now: the nearest one that was seen before has come from there. A row for each goes into
  /// the record; `advance`: number of it, where it is not the time.
  void look(double time, Record& record, double advance);

  /// Lines in the units of the case, and all of them as cracks.
  const std::vector<geometry::GraphLine>& lines() const { return lines_; }
  std::vector<geometry::CrackPath> paths() const;
  /// Lines along which the plate is parted: the cracks as they were given, and since then the sides between the cells
  /// of points whose bonds have broken, which lines are off by up to a spacing.
  std::vector<geometry::CrackPath> cuts() const;
  const std::vector<BondTip>& tips() const { return tips_; }
  /// Tips of cracks at least eight spacings long, for which intensity factors are meaningful.
  std::vector<std::pair<std::size_t, geometry::Tip>> tips_of_cracks() const;
  double length() const;
  /// Length of the present cracks, whether look() has seen them or not.
  double length_now();
  /// Growth of the length since the start.
  double growth() const { return length() - first_length_; }
  std::size_t broken() const { return broken_; }

  /// Cracks as they are to be written.
  post::Cracks drawn() const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(graph_, grown_, lines_, tips_, seen_, broken_, time_);
  }

private:
  void find_lines();

  /// Tip of the last look that a tip has come from; `same`: no other has come from it as well.
  struct Origin {
    std::optional<std::size_t> earlier = {};
    bool same = false;
  };
  std::vector<Origin> origins(const std::vector<geometry::Tip>& tips, double time) const;
  BondTip seen_again(const geometry::Tip& tip, const Origin& origin, double time);

  const geometry::LatticeUnits& units_;
  std::vector<geometry::CrackPath> given_;
  std::optional<double> fastest_;
  std::shared_ptr<const PointNumbers> numbers_;
  std::function<bool(const geometry::CrackGraph::Corner&)> inside_;  // are all four cells about a corner of the plate?
  geometry::CrackGraph graph_, grown_;                               // all; without those of the given cracks
  std::vector<geometry::GraphLine> lines_;
  std::vector<BondTip> tips_;
  std::size_t first_sides_ = 0, seen_ = 0, broken_ = 0;
  double first_length_ = 0, time_ = 0;  // time of the last look
};

}  // namespace fracture
