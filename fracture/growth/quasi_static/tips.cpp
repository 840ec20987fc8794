#include "fracture/growth/quasi_static/tips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fracture/growth/archive.hpp"

namespace fracture {
namespace {

constexpr double least_calibrated = 10;       // spacings of a tip: the lattice's steps are half of one
constexpr double largest_calibration = 1.15;  // what is further off is wrong in another way
constexpr double least_correction = 0.009;    // of a turn: half a degree
constexpr double together = 0.01;  // of the largest energy release rate: twice what integrals scatter with the lattice

}  // namespace

QuasiStaticTips::QuasiStaticTips(const Growth& growth, const plate::Section& section, const geometry::Outline& outline,
                                 double spacing, std::vector<geometry::Polyline> cracks)
    : growth_(growth),
      section_(section),
      outline_(outline),
      spacing_(spacing),
      toughness_(growth.fracture_energy * section.thickness),
      cracks_(std::move(cracks)) {
  for (const auto& crack : cracks_) record_.cracks.lines.push_back({crack, std::vector<double>(crack.size(), 0)});
}

bool QuasiStaticTips::may_grow(const LoadedTip& tip) const {
  return *tip.G > 0 && !(growth_.tension_only && tip.factors.K1 <= 0) && !growth_.held(tip.tip.position);
}

Loaded QuasiStaticTips::solve() {
  do {
    plate_ = solved_ ? *std::exchange(solved_, {}) : whole_load(cracks_);
    if (!plate_.split.empty()) return {plate_.split, 0, 0, {}};
  } while (break_through());
  most_ = 0;
  for (const auto& tip : plate_.tips)
    if (may_grow(tip)) most_ = std::max(most_, *tip.G);
  calibrate();
  Loaded result{"", plate_.displacement, INFINITY, {}, plate_.held};
  if (plate_.tips.empty())
    result.end = End::no_tip_left;
  else if (most_ == 0)
    result.end = End::cannot_grow;
  if (most_ > 0) result.critical = std::sqrt(toughness_ / (calibration() * most_));
  return result;
}

/// What the last advance has really released under the whole load, of loads half of what its displacement has gained,
/// beside what the energy release rates of its tips before and after it make of it.
void QuasiStaticTips::calibrate() {
  double predicted = 0, length = 0;
  const auto moved = std::exchange(moved_, {});
  for (const auto& [crack, at_back, G, gone] : moved) {
    const auto now = std::ranges::find_if(plate_.tips, [tip = crack, back = at_back](const auto& one) {
      return one.tip.crack == tip && one.tip.at_back == back;
    });
    if (now == plate_.tips.end()) return;  // broken through
    predicted += gone * (G + *now->G) / 2;
    length += gone / double(moved.size());
  }
  if (length == 0) return;
  calibrated_ += length, predicted_ += predicted;
  measured_ += (plate_.given() - last_given_) / 2;
}

/// Energy released over the one predicted, of all advances.
double QuasiStaticTips::calibration() const {
  return calibrated_ < least_calibrated * spacing_ * (1 - 1e-9)
             ? 1
             : std::clamp(measured_ / predicted_, 1 / largest_calibration, largest_calibration);
}

bool QuasiStaticTips::longest() const {
  return std::ranges::any_of(cracks_, [&](const auto& crack) { return growth_.reached(geometry::length(crack)); });
}

std::vector<double> QuasiStaticTips::lengths() const {
  std::vector<double> result;
  for (const auto& crack : cracks_) result.push_back(geometry::length(crack));
  return result;
}

void QuasiStaticTips::choose(const Equilibrium& state) {
  moves_.clear();
  for (const auto& tip : plate_.tips)
    moves_.push_back(!state.ends && may_grow(tip) && *tip.G >= (1 - together) * most_);
  const auto advance = double(state.advance);
  draw_cracks(advance);
  GrowthRow row{advance, {}, state.factor, state.displacement, {}, double(state.stable)};
  if (std::isfinite(state.critical)) row.critical_load_factor = state.critical;
  for (const double length : lengths()) row.crack_length += length;
  row.tips = plate_.tips.size();
  row.external_work = state.ledger.external_work, row.strain_energy = state.ledger.strain;
  row.fracture_energy = state.ledger.fracture, row.released_energy = state.ledger.released();
  record_.add(row);
  for (std::size_t i = 0; i < plate_.tips.size(); ++i) {
    const auto& [tip, K, G] = plate_.tips[i];
    TipRow one{advance, {}, double(i), double(tip.crack), tip.position.x(), tip.position.y()};
    one.angle = std::atan2(tip.direction.y(), tip.direction.x()) * 180 / std::numbers::pi;
    one.length = geometry::length(cracks_[tip.crack]);
    one.moves = double(moves_[i]), one.G = state.factor * state.factor * G.value_or(0);
    one.K1 = state.factor * K.K1, one.K2 = state.factor * K.K2, one.K3 = state.factor * K.K3;
    record_.add(one);
  }
}

/// Puts what the ends have gone since the last state before and behind the lines. Of pieces straight on, a crack keeps
/// their end alone, a line all ends.
void QuasiStaticTips::draw_cracks(double advance) {
  const double tolerance = geometry::tolerance(outline_);
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    auto& [vertices, advances] = record_.cracks.lines[c];
    auto crack = cracks_[c];
    for (int end = 0; end < 2; ++end) {  // back, then front
      auto next = crack.size() - 1;      // the first vertex beyond the line
      while (next > 0 && geometry::distance({crack[next - 1], crack[next]}, vertices.back()) > tolerance) --next;
      if ((crack[next] - vertices.back()).norm() <= tolerance) ++next;
      advances.insert(advances.end(), crack.size() - next, advance);
      vertices.insert(vertices.end(), crack.begin() + std::ptrdiff_t(next), crack.end());
      for (auto* list : {&crack, &vertices}) std::ranges::reverse(*list);
      std::ranges::reverse(advances);
    }
  }
  record_.cracks.tips = post::given_cracks(geometry::crack_paths(outline_, cracks_, tolerance)).tips;
}

const Record& QuasiStaticTips::record() {
  draw_cracks(double(advances_));
  return record_;
}

/// Tips without a ring; true where there were any.
bool QuasiStaticTips::break_through() {
  bool found = false;
  for (const auto& [tip, factors, G] : plate_.tips) {
    if (G) continue;
    extend(tip, fracture::break_through(outline_, cracks_, tip));
    moved_.clear();  // what the last advance released cannot be told from this
    found = true;
  }
  advances_ += found;
  return found;
}

/// A piece that turns is laid twice: the path is curved, and its end tells by how much (theory.md, "Growth").
void QuasiStaticTips::advance(double) {
  const auto before = cracks_;
  const double spent = fracture_;
  std::vector<double> angles(plate_.tips.size(), 0);
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (moves_[i]) angles[i] = kink_angle(plate_.tips[i].factors, growth_.direction, section_);
  lay(before, angles);
  if (std::ranges::any_of(angles, turns)) {
    auto trial = whole_load(cracks_);
    if (correct(trial, angles)) {
      cracks_ = before, fracture_ = spent;
      moved_.clear();
      lay(before, angles);
    } else {
      solved_ = std::move(trial);
    }
  }
  last_given_ = plate_.given();
  ++advances_;
}

void QuasiStaticTips::lay(const std::vector<geometry::Polyline>& before, const std::vector<double>& angles) {
  const bool long_leg = std::ranges::any_of(angles, turns);  // tips that move together go as far
  for (std::size_t i = 0; i < plate_.tips.size(); ++i) {
    if (!moves_[i]) continue;
    const auto& [tip, factors, G] = plate_.tips[i];
    const auto step = fracture::advance(growth_, outline_, before, spacing_, tip, angles[i], long_leg);
    extend(tip, step);
    moved_.push_back({tip.crack, tip.at_back, *G, step.length});
  }
}

/// Half of the turns that the ends of the pieces ask for; false where there are none to speak of.
bool QuasiStaticTips::correct(const LoadedPlate& trial, std::vector<double>& angles) const {
  bool changed = false;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!moves_[i]) continue;
    const auto& tip = plate_.tips[i].tip;
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

void QuasiStaticTips::extend(const geometry::Tip& tip, const TipAdvance& step) {
  geometry::extend(cracks_[tip.crack], tip.at_back, step.to);
  fracture_ += toughness_ * step.length;
}

/// Nothing has moved since the plate was solved, and no trial waits.
template <typename Archive, typename Self>
void QuasiStaticTips::memory(Archive& archive, Self& self) {
  archive(self.record_, self.warnings_, self.cracks_, self.most_, self.moves_, self.last_given_, self.calibrated_,
          self.measured_, self.predicted_, self.fracture_, self.advances_);
}

void QuasiStaticTips::remember(plate::OutArchive& archive) const {
  memory(archive, *this);
}

void QuasiStaticTips::recall(plate::InArchive& archive) {
  memory(archive, *this);
  const auto warnings = warnings_;
  plate_ = whole_load(cracks_);
  warnings_ = warnings;  // those of the solution have been said
}

}  // namespace fracture
