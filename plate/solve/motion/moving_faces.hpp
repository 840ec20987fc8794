#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "plate/model/point_map.hpp"
#include "plate/model/space.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Constraints;
class FaceRows;
class Formulation;

using AtFaces = std::array<double, 2>;  // at z = h/2, z = -h/2

/// Two points that face each other on a crack, in a motion. Openings are sums over degrees of freedom; forces that
/// press both points apart push those that are free. Numbers are those of MovingPairs::dofs.
struct MovingPair {
  struct Term {
    std::uint32_t number;
    AtFaces shares;
  };
  struct Push {
    std::uint32_t number;
    double inverse_mass;
    AtFaces shares;
  };
  std::vector<Term> terms;
  std::vector<Push> pushes;  // folded
};

/// Pairs on all cracks of a plate. Every rank has all of them, in the same order.
struct MovingPairs {
  std::vector<MovingPair> pairs;
  std::vector<std::optional<Dof>> dofs;  // absent where another rank owns the point
  const Communicator* communicator = &single_process();
};

/// Pairs of a plate and its plane, whose states are stacked(): the points of the plane follow those of the plate.
/// `mass`: folded. Collective.
MovingPairs moving_pairs(const FaceRows& rows, const Formulation& plate, const Constraints& constraints,
                         const Forces& mass);

/// Opening of a pair at a step, and the force that keeps it from being negative at the next one [length, force].
struct PairContact {
  AtFaces opening{}, force{};
};

/// Contact of crack faces until now.
struct ContactSoFar {
  double least_opening = INFINITY;  // of all steps [length]
  double lost = 0;                  // by points that meet, less what they have given back [energy]
};

/// Contact of crack faces between two steps.
struct ContactMemory {
  ContactSoFar so_far = {};
  std::vector<double> held = {};  // of every pair at both faces: to be given back as it opens [energy]
  std::vector<char> closed = {};  // likewise, in the step before
};

/// Faces of cracks that do not overlap in time steps, without friction: the forces of a step are not negative, no
/// opening is negative at the next one, and one of both is zero.
/// Pairs, and groups of pairs that share points, hold the energy that they lose as they meet until they open, and give
/// it back then (theory.md, "Faces that touch"). Every rank finds the forces of all pairs, with the same bits.
class MovingFaces {
public:
  MovingFaces() = default;
  MovingFaces(MovingPairs faces, ContactMemory memory);

  bool any() const { return !faces_.pairs.empty(); }

  /// Data of a step without contact.
  struct FreeStep {
    const State& state;
    const State& velocity;                           // half a step before, at step 0 that of time 0
    double time_step, share;                         // share: of the velocity half a step after, in this acceleration
    double drag;                                     // 1 + alpha dt / 2
    std::function<double(const Dof&)> acceleration;  // of what is free
    bool first;
  };
  /// Finds the forces of a step and adds them to folded forces. Collective.
  void press(const FreeStep& step, Forces& forces);
  /// Counts the step, which has been taken.
  void count() { memory_.so_far.lost += lost_before_ + lost_after_; }

  const std::vector<PairContact>& contacts() const { return contacts_; }
  /// Until a step whose forces have been found.
  ContactSoFar so_far() const { return {memory_.so_far.least_opening, memory_.so_far.lost + lost_before_}; }
  /// To go on from before a step.
  const ContactMemory& memory() const { return memory_; }

private:
  void read(const FreeStep& step);
  void find_openings();
  bool solve(std::size_t pair);
  std::array<double, 3> compliance(std::size_t pair) const;
  AtFaces opening(std::size_t pair, const FreeStep& step, bool next) const;
  void push(std::size_t pair, const AtFaces& force);
  void give_back(std::size_t pair, const FreeStep& step);
  void settle(const std::vector<std::size_t>& group);
  void give_back_together(const std::vector<std::size_t>& group, const FreeStep& step);
  struct Given {
    double force = 0, work = 0;  // force: times those along which it acts
  };
  Given give(const std::vector<std::size_t>& group, const std::vector<AtFaces>& along, double energy,
             const FreeStep& step);
  void press_along(const std::vector<std::size_t>& group, const std::vector<AtFaces>& along, double force);
  void add_forces(const FreeStep& step, Forces& forces);

  MovingPairs faces_;
  std::vector<PairContact> contacts_;
  std::vector<std::uint32_t> pushed_;             // numbers of what any pair pushes, ascending
  std::vector<std::size_t> shared_;               // pairs that push what other pairs push
  std::vector<std::vector<std::size_t>> groups_;  // of these, joined by what they push
  std::vector<double> displacement_, velocity_;   // by number
  std::vector<double> change_;                    // of displacements over the step, by number
  double size_ = 0;                               // of displacements of faces, beside which there is rounding
  double response_ = 0;                           // of a unit mass to a unit force, over the step [time^2]
  ContactMemory memory_;
  double lost_before_ = 0, lost_after_ = 0;  // in both halves of the step in hand [energy]
};

}  // namespace plate
