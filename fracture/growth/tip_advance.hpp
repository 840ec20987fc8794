#pragma once
#include "fracture/growth/growth.hpp"
#include "geometry/shape/crack_path.hpp"
#include "plate/model/section.hpp"

namespace fracture {

/// Intensity factors of a tip: of moments and the shear force, and of membrane forces where loads act in the plane.
struct Factors {
  double K1, K2, K3;
  double N1 = 0, N2 = 0;
};

/// Factors at the tip of a short piece that leaves a tip at `angle` (counter-clockwise), to the first order of its
/// length: those of the moment M_tt and M_tr, of the shear force Q_t and of the membrane forces N_tt and N_tr on the
/// line ahead under that angle (theory.md, "Growth").
Factors kinked(const Factors& factors, double angle);

/// Energy release rate of an isotropic plate by its factors, of bending and in the plane together [force]
/// (theory.md, "Growth").
double energy_release(const Factors& factors, const plate::Section& section);

/// The face of the plate at which the largest tension across a tip is larger: 1 is z = h/2, -1 is z = -h/2.
int governing_face(const Factors& factors, double thickness);

/// True where the crack opens at neither face of the plate: loads in the plane press its faces together.
bool pressed(const Factors& factors, double thickness);

/// Size of factors, those in the plane as the moments with the same stress at a face [force length^(1/2)].
double size_of(const Factors& factors, double thickness);

/// The angle in which a tip goes on [rad, counter-clockwise], in [-pi/2, pi/2].
double kink_angle(const Factors& factors, Growth::Direction direction, const plate::Section& section);

/// The most by which kink_angle() changes where each factor is off by its error [rad]; pi where an error is not known
/// (infinite). Errors of the factors are estimates.
double kink_error(const Factors& factors, const Factors& errors, Growth::Direction direction,
                  const plate::Section& section);

/// The error of the square root of the energy release rate, relative to it: load factors have the same. Infinite where
/// an error is not known.
double release_error(const Factors& factors, const Factors& errors, const plate::Section& section);

/// The turn that a tip makes, and whether the errors of its factors leave it a direction.
struct Turn {
  double angle = 0;  // [rad]; 0 where it is no larger than its error
  double error = 0;  // kink_error()
  double asked = 0;  // kink_angle()
  /// True where the direction is known within half of what a kink may be.
  bool known() const;
  /// False: the tip would turn by more than it may be left straight, and its direction is not known.
  bool resolved() const;
};

/// `share`: of its error that a turn must exceed to be made.
Turn turn_of(const Factors& factors, const Factors& errors, Growth::Direction direction, const plate::Section& section,
             double share = 1);

/// True where the angle counts as a turn, from one degree on [rad].
bool turns(double angle);

/// Advance of a tip.
struct TipAdvance {
  geometry::Point to;
  double length = 0;                          // of the new piece [length]
  std::optional<geometry::Obstacle> reached;  // an edge, a hole or a crack: the tip is no more
};

/// Length of a piece after a turn, so that a ring about its tip fits beside the bend [spacings].
inline constexpr double shortest_leg = 5;

/// Straight on by the increment, or with a turn by `angle` [rad]. Turns below a degree are not made; a piece after a
/// turn is at least five spacings long, so that a ring about its tip fits beside the bend. So is one that goes with
/// such a piece of another tip (`long_leg`), and then turns from a fifth of a degree on are made: alike tips stay
/// alike. A tip that would come closer than that to something ahead breaks through to it, and to another crack that it
/// would pass at less than half a spacing. `leg`: asked for in the place of the five spacings, as far as what is ahead
/// leaves room.
TipAdvance advance(const Growth& growth, const geometry::Outline& outline,
                   const std::vector<geometry::Polyline>& cracks, double spacing, const geometry::Tip& tip,
                   double angle, bool long_leg, double leg = shortest_leg);

/// Breaks through to what is nearest ahead or beside: of tips so near to an edge or a crack that no ring fits between.
/// None where what leaves no room for a ring is neither.
std::optional<TipAdvance> break_through(const geometry::Outline& outline, const std::vector<geometry::Polyline>& cracks,
                                        double spacing, const geometry::Tip& tip);

/// Ends the ways of tips that meet where they do, whatever the order of the tips: halfway where two have reached each
/// other's tip, as none is before the other; else where two ways cross.
void meet(const std::vector<geometry::Tip>& tips, std::vector<std::optional<TipAdvance>>& ways);

/// Ends ways where their crack comes to growth.max_length; the tips of a crack share what is left. A piece after a turn
/// stays at least five spacings long, and one that reaches something keeps its way where no ring would fit before it.
void end_at_longest(const Growth& growth, const std::vector<geometry::Polyline>& cracks, double spacing,
                    const std::vector<geometry::Tip>& tips, std::vector<std::optional<TipAdvance>>& ways);

/// True for a tip that stands on what it reaches: it has no way to go.
bool touches_at_once(const TipAdvance& way, double spacing);

/// "crack 1"; of an edge or a hole its name, "'left'"
std::string name_of(const geometry::Obstacle& obstacle);

}  // namespace fracture
