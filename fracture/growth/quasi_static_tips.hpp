#pragma once
#include "fracture/growth/quasi_static_growth.hpp"
#include "fracture/growth/tip_advance.hpp"

namespace fracture {

/// Text that names a tip by its position, for messages.
std::string name_of(const geometry::Tip& tip);

/// A tip under the whole load.
struct LoadedTip {
  geometry::Tip tip;
  Factors factors{0, 0, 0};
  std::optional<double> G;     // energy release rate of the plate [force]; none: no ring fits about it any more
  Factors errors{0, 0, 0};     // estimated, of the factors; infinite where not known
  double release_error = 0.0;  // estimated, of the square root of G, relative; infinite where not known
};

/// The plate with certain cracks under the whole load.
struct LoadedPlate {
  std::string split;        // not empty: a piece of the plate is not held any more, and nothing could be solved
  double displacement = 0;  // sum of loads times static displacements [energy]: what the load factor does work on
  std::vector<LoadedTip> tips;
  double held = 0;  // of it, what is of supports that move: a crack that grows takes from them what it gains from loads

  /// Twice what is released while nothing changes but the crack [energy].
  double given() const { return displacement - 2 * held; }
};

/// Tips that grow where their energy release rate lets them, in a plate that is solved anew with every length of its
/// cracks. Tips whose energy release rates are within a percent of the largest move together. A tip about which no ring
/// fits breaks through to what is nearest ahead, or stays where nothing is. A tip turns where its turn is larger than
/// the estimated error of it; growth ends where a tip would turn and its direction is not resolved (theory.md,
/// "Growth").
class QuasiStaticTips : public QuasiStaticModel {
public:
  /// Constructs quasi-static growth; all references must outlive this. `spacing`: of the points at the tips [length].
  QuasiStaticTips(const Growth& growth, const plate::Section& section, const geometry::Outline& outline, double spacing,
                  std::vector<geometry::Polyline> cracks);

  Loaded solve() override;
  void choose(const Equilibrium& state) override;
  void advance(double factor) override;
  std::string stuck() const override { return stuck_; }

  std::size_t advances() const override { return advances_; }
  const Record& record() override;
  double fracture_energy() const override { return fracture_; }
  bool longest() const override;
  std::vector<double> lengths() const override;
  const std::vector<geometry::Polyline>& cracks() const { return cracks_; }

  void save(plate::OutArchive& archive) const override;
  /// The plate is solved again.
  void restore(plate::InArchive& archive) override;

protected:
  /// The plate with these cracks under the whole load.
  virtual LoadedPlate full_load(const std::vector<geometry::Polyline>& cracks) = 0;
  /// Remedy that improves the factors of the last plate.
  virtual std::string remedy() const { return "refine"; }
  /// Advance with which a tip without a ring breaks through.
  std::optional<TipAdvance> way_through(const std::vector<geometry::Polyline>& cracks, const geometry::Tip& tip) const {
    return fracture::break_through(outline_, cracks, spacing_, tip);
  }
  /// The number of a tip among those at the start, which it keeps.
  std::size_t number_of(const geometry::Tip& tip) const;

private:
  /// Cracks and fracture energy before an advance.
  struct Start {
    std::vector<geometry::Polyline> cracks;
    double fracture;
  };

  template <typename Archive, typename Self>
  static void memory(Archive& archive, Self& self);
  bool may_grow(const LoadedTip& tip) const;
  plate::Section section_at(const geometry::Tip& tip) const { return section_.at(tip.position); }
  /// Energy release rate of a tip over its thickness, times that of the section without its regions [force].
  double demand(const LoadedTip& tip) const;
  double mean_thickness(const geometry::Point& from, const geometry::Point& to) const;
  std::vector<char> movers() const;
  double load_error() const;
  std::string unresolved();
  std::string stays(const geometry::Tip& tip);
  const LoadedTip* end_of(const LoadedPlate& trial, std::size_t mover) const;
  std::string contradicted(const LoadedPlate& trial, const std::vector<double>& angles) const;
  std::vector<Turn> turns_of(const std::vector<char>& moves) const;
  void calibrate();
  double calibration() const;
  bool break_through();
  /// Length of a piece after a turn, at least [spacings].
  double least_leg() const { return std::max(growth_.increment, shortest_leg); }
  bool lay_twice(const Start& start, std::vector<double> angles, double leg, bool anyhow = false);
  void lay(const Start& start, const std::vector<double>& angles, double leg);
  bool shows_directions(const LoadedPlate& trial) const;
  void stay(const Start& start, std::string why);
  bool correct(const LoadedPlate& trial, std::vector<double>& angles) const;
  void extend(const geometry::Tip& tip, const TipAdvance& step);
  void draw_cracks(double advance);

  struct AdvancedTip {
    std::size_t crack;
    bool at_back;
    double G, length;
  };
  const Growth& growth_;
  const plate::Section& section_;
  const geometry::Outline& outline_;
  double spacing_, toughness_;  // the latter: of the section without its regions [force]
  std::vector<geometry::Polyline> cracks_;
  LoadedPlate plate_;                                     // the last solution
  std::optional<LoadedPlate> solved_;                     // with the cracks as they are
  std::vector<std::pair<std::size_t, bool>> numbers_;     // of tips: crack, and whether at its back
  std::string stuck_;                                     // why the last advance was not made
  double most_ = 0;                                       // demand of a tip that may grow
  std::vector<char> moves_;                               // per tip
  std::vector<AdvancedTip> advanced_;                     // by the last advance
  double last_given_ = 0;                                 // before it
  double calibrated_ = 0, measured_ = 0, predicted_ = 0;  // length of a tip's way, energies of all advances
  double fracture_ = 0;
  std::size_t advances_ = 0;
};

}  // namespace fracture
