#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/growth/quasi_static/tips.hpp"

/// How well the next advance of tips at rest is known: its load, and where it goes.
namespace fracture {
namespace {

constexpr double least_correction = 0.009;              // of a turn: half a degree
constexpr double contradiction = std::numbers::pi / 4;  // a turn that the end of a piece asks for after its own turn
constexpr double alike = 1e-6;  // of an energy release rate or a turn: what solvers leave between mirror images

std::string at(const geometry::Tip& tip) {
  return fmt::format("the tip at ({:g}, {:g})", tip.position.x(), tip.position.y());
}

double in_degrees(double angle) {
  return angle * 180 / std::numbers::pi;
}

}  // namespace

/// Of the next load factor, relative to it: within their errors another tip may be the first.
double QuasiStaticTips::load_error() const {
  double high = 0, low = 0;  // of the square root of the largest energy release rate
  for (const auto& tip : plate_.tips) {
    if (!may_grow(tip)) continue;
    const double root = std::sqrt(*tip.G / most_);
    high = std::max(high, root * (1 + tip.release_error)), low = std::max(low, root * (1 - tip.release_error));
  }
  return std::max(high - 1, 1 - low);
}

/// Why it is not known how the tips that move go on; empty: it is. Says once that some go straight on unseen.
std::string QuasiStaticTips::unresolved() {
  constexpr const char* straight = "directions of tips are not known within 30 degrees";
  const auto found = turns_of(moves_);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!moves_[i]) continue;
    const auto& [tip, K, G, errors, release_error] = plate_.tips[i];
    if (release_error >= 1)
      return fmt::format("the energy release rate at {} is not known within its own size; {}", at(tip), remedy());
    if (!found[i].resolved())
      return fmt::format(
          "{} would turn by {:.0f} degrees, which is not known within {:.0f}; {}, or growth.direction = "
          "\"straight\"",
          at(tip), in_degrees(found[i].asked), in_degrees(found[i].error), remedy());
    if (!found[i].known() &&
        std::ranges::none_of(warnings_, [&](const auto& one) { return one.starts_with(straight); }))
      warnings_.push_back(fmt::format("{}: they go straight on, first {}; {}", straight, at(tip), remedy()));
  }
  return {};
}

/// Of the tips that move. Where one turns, turns of others that exceed their errors but for rounding are made too.
std::vector<Turn> QuasiStaticTips::turns_of(const std::vector<char>& moves) const {
  const auto find = [&](double share) {
    std::vector<Turn> result(plate_.tips.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      if (const auto& tip = plate_.tips[i]; moves[i])
        result[i] = turn_of(tip.factors, tip.errors, growth_.direction, section_, share);
    return result;
  };
  const auto result = find(1);
  const bool any = std::ranges::any_of(result, [](const auto& one) { return turns(one.angle); });
  return any ? find(1 - alike) : result;
}

const LoadedTip* QuasiStaticTips::end_of(const LoadedPlate& trial, std::size_t mover) const {
  const auto& tip = plate_.tips[mover].tip;
  const auto end = std::ranges::find_if(
      trial.tips, [&](const auto& one) { return one.tip.crack == tip.crack && one.tip.at_back == tip.at_back; });
  return end == trial.tips.end() || !end->G ? nullptr : &*end;
}

/// After a turn a crack goes on smoothly: an end of a piece that asks for another large turn says that the first one
/// was wrong.
std::string QuasiStaticTips::contradicted(const LoadedPlate& trial, const std::vector<double>& angles) const {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto* end = moves_[i] ? end_of(trial, i) : nullptr;
    if (!end || !turns(angles[i])) continue;
    const double further = kink_angle(end->factors, growth_.direction, section_);
    if (std::abs(further) > contradiction)
      return fmt::format("{} would turn by {:.0f} degrees, and five spacings on by {:.0f} more; {}",
                         at(plate_.tips[i].tip), in_degrees(angles[i]), in_degrees(further), remedy());
  }
  return {};
}

/// Half of the turns that the ends of the pieces ask for; false where there are none to speak of.
bool QuasiStaticTips::correct(const LoadedPlate& trial, std::vector<double>& angles) const {
  bool changed = false;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto* end = moves_[i] ? end_of(trial, i) : nullptr;
    if (!end) continue;
    const double turn = turn_of(end->factors, end->errors, growth_.direction, section_).angle;
    if (std::abs(turn) < least_correction) continue;
    angles[i] += turn / 2;
    changed = true;
  }
  return changed;
}

}  // namespace fracture
