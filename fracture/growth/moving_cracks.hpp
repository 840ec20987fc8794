#pragma once
#include <algorithm>
#include <deque>
#include <optional>

#include "fracture/breakage/damaged_plate.hpp"
#include "fracture/growth/tip_advance.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/factors/tip_methods.hpp"

namespace plate {
struct Problem;
}

namespace fracture {

/// A piece that a tip has gone.
struct Piece {
  double begin, end;  // time
  std::size_t crack;
  bool at_back;
  geometry::Point from, to;
  double spent;           // energy taken, over fracture energy and area of the piece
  std::string reached;    // an edge, a hole or a crack; empty: none
  std::size_t tip, tips;  // number of the tip; how many may still go on
};

/// A tip that stopped because it would have turned, and its direction is not resolved, or because what it took is not
/// the energy of a crack.
struct StoppedTip {
  double time;
  std::size_t tip;  // number
  geometry::Point position;
  double asked, error;  // of the turn [rad]
  double spent = 0;     // lately, over the fracture energy; 0 where it stopped for its direction
};

/// Cracks that run through a plate of bonds over a horizon (theory.md, "Growth"). A tip at rest starts when its
/// energy release rate reaches the fracture energy, and those whose rate is the same but for rounding with it. It stops
/// where its direction is not resolved, or where five spacings took less than 0.6 or more than 1.6 times the fracture
/// energy. Bonds across the next piece then break gradually; the energy
/// that this takes is counted step by step, and tells how fast the tip goes on: faster where a piece took more than the
/// fracture energy, slower or not at all where it took less.
class MovingCracks : public plate::Changes {
public:
  /// Constructs growth in motion; all references must outlive this. `paths`: the cracks at the start [length].
  /// `membrane`: the problem in the plane, of a plate that has one.
  MovingCracks(const Growth& growth, const plate::Problem& problem, DamagedPlate& plate,
               std::vector<geometry::CrackPath> paths, const plate::Problem* membrane = nullptr);

  void before_force(const plate::Step& now) override;
  void after_force(const plate::Step& now, const plate::Forces& force) override;

  const std::vector<geometry::CrackPath>& paths() const { return paths_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Number of tips whose last piece has begun and not ended.
  std::size_t under_way() const {
    return std::size_t(std::ranges::count_if(tips_, [](const auto& tip) { return tip.running.has_value(); }));
  }
  const std::vector<StoppedTip>& stopped() const { return stopped_; }
  /// True where a tip whose direction is not known has gone straight on.
  bool direction_unknown() const { return direction_unknown_; }
  /// Energy taken so far, and length gone.
  double fracture_energy() const { return spent_; }
  double length() const { return length_; }
  /// Tips that may still advance, by their number at the start.
  std::vector<std::pair<std::size_t, geometry::Tip>> tips() const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(paths_, tips_, pieces_, stopped_, direction_unknown_, spent_, length_);
  }

private:
  struct Running {
    std::size_t breakage;
    double begin, duration, length, spent;
    geometry::Point from;
    TipAdvance way;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(breakage, begin, duration, length, spent, from, way);
    }
  };
  /// Energy release rate of a tip, in bending and in the plane.
  struct Gauge {
    post::TipMethods bending;
    std::optional<post::TipMethods> in_plane;
  };
  struct MovingTip {
    geometry::Tip tip;
    double speed;
    double length = 0, spent = 0;                       // of all pieces
    std::deque<std::pair<double, double>> recent = {};  // lengths and energies of the last ones
    double since_look = 0;                              // length gone without a look at the factors
    std::size_t next_look = 0;                          // step
    std::shared_ptr<const Gauge> gauge = {};            // of the tip where it is
    std::optional<Running> running = {};
    bool ended = false;

    /// Serialises the tip without the gauge, which is made again.
    template <typename Archive>
    void serialize(Archive& archive) {
      archive(tip, speed, length, spent, recent, since_look, next_look, running, ended);
    }
  };

  /// Energy release rate and factors of a tip with their errors; `fits`: a ring does.
  struct TipMeasurement {
    bool fits = false;
    double G = 0;
    Factors factors{0, 0, 0}, errors{0, 0, 0};
  };
  /// A tip that goes on at a time, under an angle to its direction [rad].
  struct Departure {
    std::size_t tip;
    double angle, time;
  };
  /// State and internal force of the plate, and of its plane where loads act there.
  struct Strained {
    const plate::State& state;
    const plate::Forces& force;
    const plate::State* in_plane = nullptr;
    const plate::Forces* force_in_plane = nullptr;
  };
  TipMeasurement look(MovingTip& tip, const Strained& now) const;
  std::shared_ptr<const Gauge> gauge(const geometry::Tip& tip) const;
  bool stays(const MovingTip& tip, double G, const Factors& factors) const;
  bool finds_direction(std::size_t tip, const TipMeasurement& seen, double time, double& angle);
  std::vector<std::optional<TipAdvance>> ways_of(const std::vector<Departure>& departures);
  void depart(const std::vector<Departure>& departures);
  /// Energy over the fracture energy of its last five spacings.
  double taken_lately(std::size_t tip) const;
  /// Ends the advance of a tip; returns true where the tip may go straight on.
  bool arrive(MovingTip& tip, const plate::Step& now);

  const Growth& growth_;
  const plate::Problem& problem_;
  const plate::Problem* membrane_;
  DamagedPlate& plate_;
  std::vector<geometry::CrackPath> paths_;
  double spacing_, toughness_, speed_limit_;
  std::vector<MovingTip> tips_;
  std::vector<Piece> pieces_;
  std::vector<StoppedTip> stopped_;
  bool direction_unknown_ = false;
  double spent_ = 0, length_ = 0;
};

}  // namespace fracture
