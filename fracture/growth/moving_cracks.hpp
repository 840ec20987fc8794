#pragma once
#include <deque>
#include <functional>

#include "fracture/severing/severed_plate.hpp"
#include "fracture/growth/tip_advance.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace fracture {

/// Energy release rate [force] and intensity factors of a tip in a state of motion.
struct Drive {
  double G;
  Factors factors;
};
/// Looks at one tip; `force`: internal force of the state. Built anew where the tip has moved.
using Gauge = std::function<Drive(const plate::State& state, const plate::Forces& force)>;

/// A piece that a tip has gone.
struct Piece {
  double begin, end;          // time
  std::size_t crack;
  bool at_back;
  geometry::Point from, to;
  double spent;               // energy taken, over fracture energy and area of the piece
  std::string reached;        // an edge, a hole or a crack; empty: none
};

/// Cracks that run through a plate of bonds over a horizon (theory.md, "Growth in motion"). A tip at rest starts when its
/// energy release rate reaches the fracture energy. Bonds across the next piece are then severed gradually; the energy
/// that this takes is counted step by step, and tells how fast the tip goes on: faster where a piece took more than the
/// fracture energy, slower or not at all where it took less.
class MovingCracks : public plate::Changes {
public:
  /// What is asked of the program: the gauge of a tip, empty where no ring fits about it. The gauge sees the families as
  /// they are then.
  using MakeGauge = std::function<Gauge(const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip)>;

  /// All references must outlive this. `paths`: the cracks at the start [length].
  MovingCracks(const Growth& growth, const plate::Section& section, const geometry::Outline& outline,
               SeveredPlate& plate, std::vector<geometry::CrackPath> paths, double spacing, MakeGauge make_gauge);

  void before_force(const plate::Moment& now) override;
  void after_force(const plate::Moment& now, const plate::Forces& force) override;

  const std::vector<geometry::CrackPath>& paths() const { return paths_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Energy taken so far, and length gone.
  double fracture_energy() const { return spent_; }
  double length() const { return length_; }
  /// Speed that no tip exceeds: 0.93 of the shear wave's, about Rayleigh's [length/time].
  double speed_limit() const { return speed_limit_; }
  /// Those that may still go on, by their number at the start.
  std::vector<std::pair<std::size_t, geometry::Tip>> tips() const;

private:
  struct Running {
    std::size_t severing;
    double begin, duration, length, spent;
    geometry::Point from;
    TipAdvance way;
  };
  struct MovingTip {
    geometry::Tip tip;
    double speed;
    double length = 0, spent = 0;   // of all pieces
    std::deque<std::pair<double, double>> recent = {};  // lengths and energies of the last ones
    double since_look = 0;          // length gone without a look at the factors
    std::size_t next_look = 0;      // step
    Gauge gauge = {};
    std::optional<Running> running = {};
    bool ended = false;
  };

  bool stays(const MovingTip& tip, const Drive& drive) const;
  void start(MovingTip& tip, const Factors& factors, double time);
  void arrive(MovingTip& tip, const plate::Moment& now);

  const Growth& growth_;
  const plate::Section& section_;
  const geometry::Outline& outline_;
  SeveredPlate& plate_;
  std::vector<geometry::CrackPath> paths_;
  double spacing_, toughness_, speed_limit_;
  MakeGauge make_gauge_;
  std::vector<MovingTip> tips_;
  std::vector<Piece> pieces_;
  double spent_ = 0, length_ = 0;
};

}  // namespace fracture
