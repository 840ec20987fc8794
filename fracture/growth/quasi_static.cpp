#include "fracture/growth/quasi_static.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fracture/growth/tip_advance.hpp"

namespace fracture {
namespace {

constexpr double least_calibrated = 10;       // spacings of a tip: the lattice's steps are half of one
constexpr double largest_calibration = 1.15;  // what is further off is wrong in another way
constexpr double least_correction = 0.009;  // of a turn: half a degree
constexpr double together = 0.01;  // of the largest energy release rate: twice what integrals scatter with the lattice

/// Grows cracks at rest. One use.
class RestGrowth {
public:
  RestGrowth(const Growth& growth, const plate::Section& section, const geometry::Outline& outline, double spacing,
             std::vector<geometry::Polyline> cracks)
      : growth_(growth), section_(section), outline_(outline), spacing_(spacing),
        toughness_(growth.fracture_energy * section.thickness), load_(growth.control) {
    result_.cracks = std::move(cracks);
  }

  Grown operator()(const Solve& solve, const std::function<void(const Event&)>& observe) {
    while (true) {
      const auto plate = solved_ ? *std::exchange(solved_, {}) : solve(result_.cracks);
      if (!plate.split.empty()) {
        result_.outcome = "the plate split: " + plate.split;
        result_.ledger.fracture = booked_;  // with work and strain energy before the last advance
        return result_;
      }
      if (break_through(plate)) continue;
      if (!load(plate, observe)) return result_;
      move(plate, solve);
    }
  }

private:
  bool may_grow(const LoadedTip& tip) const {
    return *tip.G > 0 && !(growth_.tension_only && tip.factors.K1 <= 0) && !growth_.held(tip.tip.position);
  }

  /// Raises the load to where the next tip moves. False where the growth ends.
  bool load(const LoadedPlate& plate, const std::function<void(const Event&)>& observe) {
    double most = 0;
    for (const auto& tip : plate.tips)
      if (may_grow(tip)) most = std::max(most, *tip.G);
    calibrate(plate);
    const double critical = most > 0 ? std::sqrt(toughness_ / (calibration() * most)) : INFINITY;
    const auto step = load_.to(plate.displacement, critical);
    result_.ledger.external_work = load_.ledger.external_work, result_.ledger.strain = load_.ledger.strain;
    std::string why = end_of_growth(plate, most > 0, step.beyond);
    if (why.empty() && !step.stable && growth_.unstable != Growth::Unstable::jump) why = unstable_advance;
    Event event{result_.advances, load_.factor(), load_.displacement(), critical, step.stable, result_.ledger, plate, result_.cracks, {}};
    for (const auto& tip : plate.tips)
      event.moves.push_back(why.empty() && may_grow(tip) && *tip.G >= (1 - together) * most);
    moves_ = event.moves, booked_ = result_.ledger.fracture;
    observe(event);
    result_.outcome = why;
    return why.empty();
  }

  /// What the last advance has really released under the whole load, half of what its displacement has gained, beside what
  /// the energy release rates of its tips before and after it make of it.
  void calibrate(const LoadedPlate& plate) {
    double predicted = 0, length = 0;
    const auto moved = std::exchange(moved_, {});
    for (const auto& [crack, at_back, G, gone] : moved) {
      const auto now = std::ranges::find_if(plate.tips, [&](const auto& one) { return one.tip.crack == crack && one.tip.at_back == at_back; });
      if (now == plate.tips.end()) return;  // broken through
      predicted += gone * (G + *now->G) / 2;
      length += gone / double(moved.size());
    }
    if (length == 0) return;
    calibrated_ += length, predicted_ += predicted;
    measured_ += (plate.displacement - last_displacement_) / 2;
  }

  /// Energy released over the one predicted, of all advances.
  double calibration() const {
    return calibrated_ < least_calibrated * spacing_ * (1 - 1e-9) ? 1 : std::clamp(measured_ / predicted_, 1 / largest_calibration, largest_calibration);
  }

  std::string end_of_growth(const LoadedPlate& plate, bool can_grow, bool beyond_the_end) const {
    if (plate.tips.empty()) return "no tip is left";
    if (!can_grow) return "no tip can grow";
    if (beyond_the_end)
      return result_.advances == 0 ? "no growth under the whole load" : "arrested under the whole load";
    if (result_.advances >= growth_.max_advances) return "the largest number of advances";
    if (growth_.max_length)
      for (const auto& crack : result_.cracks)
        if (geometry::length(crack) >= *growth_.max_length * (1 - 1e-9)) return "the largest length of a crack";
    return "";
  }

  /// Tips without a ring; true where there were any.
  bool break_through(const LoadedPlate& plate) {
    bool found = false;
    for (const auto& [tip, factors, G] : plate.tips) {
      if (G) continue;
      extend(tip, fracture::break_through(outline_, result_.cracks, tip));
      moved_.clear();  // what the last advance released cannot be told from this
      found = true;
    }
    result_.advances += found;
    return found;
  }

  /// A piece that turns is laid twice: the path is curved, and its end tells by how much (theory.md, "Growth").
  void move(const LoadedPlate& plate, const Solve& solve) {
    const Grown before = result_;
    std::vector<double> angles(plate.tips.size(), 0);
    for (std::size_t i = 0; i < angles.size(); ++i)
      if (moves_[i]) angles[i] = kink_angle(plate.tips[i].factors, growth_.direction, section_);
    lay(plate, before.cracks, angles);
    if (std::ranges::any_of(angles, turns)) {
      auto trial = solve(result_.cracks);
      if (correct(plate, trial, angles)) {
        result_ = before;
        moved_.clear();
        lay(plate, before.cracks, angles);
      } else {
        solved_ = std::move(trial);
      }
    }
    last_displacement_ = plate.displacement;
    ++result_.advances;
  }

  void lay(const LoadedPlate& plate, const std::vector<geometry::Polyline>& before, const std::vector<double>& angles) {
    const bool long_leg = std::ranges::any_of(angles, turns);  // tips that move together go as far
    for (std::size_t i = 0; i < plate.tips.size(); ++i) {
      if (!moves_[i]) continue;
      const auto& [tip, factors, G] = plate.tips[i];
      const auto step = advance(growth_, outline_, before, spacing_, tip, angles[i], long_leg);
      extend(tip, step);
      moved_.push_back({tip.crack, tip.at_back, *G, step.length});
    }
  }

  /// Half of the turns that the ends of the pieces ask for; false where there are none to speak of.
  bool correct(const LoadedPlate& plate, const LoadedPlate& trial, std::vector<double>& angles) const {
    bool changed = false;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (!moves_[i]) continue;
      const auto& tip = plate.tips[i].tip;
      const auto end = std::ranges::find_if(
          trial.tips, [&](const auto& one) { return one.tip.crack == tip.crack && one.tip.at_back == tip.at_back; });
      if (end == trial.tips.end() || !end->G) continue;
      const double turn = kink_angle(end->factors, growth_.direction, section_);
      if (std::abs(turn) < least_correction) continue;
      angles[i] += turn / 2;
      changed = true;
    }
    return changed;
  }

  void extend(const geometry::Tip& tip, const TipAdvance& step) {
    geometry::extend(result_.cracks[tip.crack], tip.at_back, step.to);
    result_.ledger.fracture += toughness_ * step.length;
  }

  const Growth& growth_;
  const plate::Section& section_;
  const geometry::Outline& outline_;
  double spacing_, toughness_;
  RestLoad load_;
  struct Moved {
    std::size_t crack;
    bool at_back;
    double G, length;
  };
  std::vector<Moved> moved_;      // by the last advance
  double last_displacement_ = 0;  // before it
  double calibrated_ = 0, measured_ = 0, predicted_ = 0;  // length of a tip's way, energies of all advances
  double booked_ = 0;  // fracture energy at the last event
  std::vector<char> moves_;
  std::optional<LoadedPlate> solved_;  // with the cracks as they are
  Grown result_;
};

}  // namespace

Grown grow_at_rest(const Growth& growth, const plate::Section& section, const geometry::Outline& outline,
                   std::vector<geometry::Polyline> cracks, double spacing, const Solve& solve,
                   const std::function<void(const Event&)>& observe) {
  return RestGrowth(growth, section, outline, spacing, std::move(cracks))(solve, observe);
}

}  // namespace fracture
