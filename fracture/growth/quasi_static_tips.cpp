#include "fracture/growth/quasi_static_tips.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "plate/model/errors.hpp"
#include "post/files/archive.hpp"

namespace fracture {
namespace {

constexpr double least_calibrated = 10;       // spacings of a tip: the lattice's steps are half of one
constexpr double largest_calibration = 1.15;  // what is further off is wrong in another way
constexpr double least_correction = 0.009;    // of a turn: half a degree
constexpr double together = 0.01;  // of the largest energy release rate: twice what integrals scatter with the lattice
constexpr double equal_release = 1e-6;  // of an energy release rate or a turn: what solvers leave between mirror images
constexpr double longest_leg = 10, leg_step = 2.5;  // spacings: of a piece whose end does not tell how it goes on
constexpr double thinnest_of_longer = 2;            // spacings: in thinner plates no length shows the mode mix
constexpr double contradiction =
    std::numbers::pi / 4;  // a turn that the end of a shortest piece asks for after its own

double in_degrees(double angle) {
  return angle * 180 / std::numbers::pi;
}

/// Says where K3, on which the largest moment across the crack does not depend, is known and more than twice the
/// others: their direction turns with every small change of them.
std::string governed_by_shear(const Growth& growth, const plate::Section& section, const Factors& K,
                              const Factors& errors) {
  const double others = size_of({.K1 = K.K1, .K2 = K.K2, .K3 = 0, .N1 = K.N1, .N2 = K.N2}, section.thickness);
  const double shear = std::abs(K.K3) * section.thickness;
  if (growth.direction != Growth::Direction::tangential_moment || !(errors.K3 < std::abs(K.K3) / 2) ||
      shear <= 2 * others)
    return "";
  return fmt::format(
      "; K3 times the thickness is {:.2g} times K1 and K2 there: `direction` = \"energy_release\" counts it",
      shear / others);
}

/// Names the face of the plate whose stress turns a tip, as tips.csv has it; empty where both have the same.
std::string name_of_face(const Factors& factors, Growth::Direction direction, double thickness) {
  if (direction != Growth::Direction::tangential_moment || (factors.K1 == 0 && factors.K2 == 0)) return "";
  return governing_face(factors, thickness) > 0 ? "z>0" : "z<0";
}

}  // namespace

std::string name_of(const geometry::Tip& tip) {
  return fmt::format("the tip at ({:g}, {:g})", tip.position.x(), tip.position.y());
}

QuasiStaticTips::QuasiStaticTips(const Growth& growth, const plate::Section& section, const geometry::Outline& outline,
                                 double spacing, std::vector<geometry::Polyline> cracks)
    : growth_(growth),
      section_(section),
      outline_(outline),
      spacing_(spacing),
      toughness_(growth.fracture_energy * section.thickness),
      cracks_(std::move(cracks)) {
  for (const auto& crack : cracks_) record_.cracks.lines.push_back({crack, std::vector<double>(crack.size(), 0)});
  for (const auto& tip : geometry::tips(geometry::crack_paths(outline_, cracks_, geometry::tolerance(outline_))))
    numbers_.emplace_back(tip.crack, tip.at_back);
}

std::size_t QuasiStaticTips::number_of(const geometry::Tip& tip) const {
  return std::size_t(std::ranges::find(numbers_, std::pair(tip.crack, tip.at_back)) - numbers_.begin());
}

bool QuasiStaticTips::may_grow(const LoadedTip& tip) const {
  const auto& K = tip.factors;
  const double h = section_at(tip.tip).thickness;
  const bool closed = growth_.tension_only && K.K1 + h / 6 * K.N1 <= 0;  // at z > 0
  return tip.G && *tip.G > 0 && !closed && !pressed(K, h) && !growth_.held(tip.tip.position);
}

double QuasiStaticTips::demand(const LoadedTip& tip) const {
  return *tip.G * (section_.thickness / section_at(tip.tip).thickness);
}

/// Mean thickness along a straight way, over that of the section without its regions.
double QuasiStaticTips::mean_thickness(const geometry::Point& from, const geometry::Point& to) const {
  if (section_.uniform()) return 1;
  constexpr int parts = 64;
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += section_.at(from + (i + 0.5) / parts * (to - from)).thickness;
  return sum / (parts * section_.thickness);
}

Loaded QuasiStaticTips::solve() {
  do {
    plate_ = solved_ ? *std::exchange(solved_, {}) : full_load(cracks_);
    if (!plate_.split.empty()) return {plate_.split, 0, 0, {}};
  } while (break_through());
  most_ = 0;
  for (const auto& tip : plate_.tips)
    if (may_grow(tip)) most_ = std::max(most_, demand(tip));
  calibrate();
  Loaded result{"", plate_.displacement, INFINITY, {}, plate_.held};
  for (const auto& one : plate_.tips)
    if (!one.G) result.unresolved = stays(one.tip);
  moves_ = movers();
  if (plate_.tips.empty())
    result.end = End::no_tip_left;
  else if (most_ == 0)
    result.end = result.unresolved.empty() ? End::cannot_grow : End::not_resolved;
  if (most_ == 0) return result;
  result.critical = std::sqrt(toughness_ / (calibration() * most_));
  result.error = load_error();
  result.unresolved = unresolved();
  return result;
}

/// Says once that a tip has no room for a ring, and nothing ahead of it to break through to.
std::string QuasiStaticTips::stays(const geometry::Tip& tip) {
  const auto why = fmt::format("{} has no room for an energy release rate", name_of(tip));
  if (std::ranges::none_of(warnings_, [&](const auto& one) { return one.starts_with(why); }))
    warnings_.push_back(fmt::format("{}: it stays there; {}", why, remedy()));
  return why;
}

/// Marks the tips that move: those within a percent of the largest energy release rate.
std::vector<char> QuasiStaticTips::movers() const {
  double least = most_;
  for (const auto& tip : plate_.tips)
    if (may_grow(tip) && demand(tip) >= (1 - together) * most_) least = std::min(least, demand(tip));
  std::vector<char> result;
  for (const auto& tip : plate_.tips) result.push_back(may_grow(tip) && demand(tip) >= (1 - equal_release) * least);
  return result;
}

/// Relative error of the next load factor. Another tip may be the first within the errors of the release rates.
double QuasiStaticTips::load_error() const {
  double high = 0, low = 0;  // of the square root of the largest energy release rate
  for (const auto& tip : plate_.tips) {
    if (!may_grow(tip)) continue;
    const double root = std::sqrt(demand(tip) / most_);
    high = std::max(high, root * (1 + tip.release_error)), low = std::max(low, root * (1 - tip.release_error));
  }
  return std::max(high - 1, 1 - low);
}

/// Reason why it is not known how the tips that move go on; empty: it is. Warns once that some go straight on
/// unresolved.
std::string QuasiStaticTips::unresolved() {
  constexpr const char* straight = "directions of tips are not known within 30 degrees";
  const auto found = turns_of(moves_);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!moves_[i]) continue;
    const auto& [tip, K, G, errors, release_error] = plate_.tips[i];
    if (release_error >= 1)
      return fmt::format("the energy release rate at {} is not known within its own size; {}", name_of(tip), remedy());
    if (!found[i].resolved())
      return fmt::format("{} would turn by {:.0f} degrees, known to {:.0f} only; {}, or `direction` = \"straight\"{}",
                         name_of(tip), in_degrees(found[i].asked), in_degrees(found[i].error), remedy(),
                         governed_by_shear(growth_, section_at(tip), K, errors));
    if (!found[i].known() &&
        std::ranges::none_of(warnings_, [&](const auto& one) { return one.starts_with(straight); }))
      warnings_.push_back(fmt::format("{}: {} goes straight on; {}", straight, name_of(tip), remedy()));
  }
  return {};
}

/// Turns of the tips that move. If one tip turns, the others turn too where their turn equals its error up to rounding.
std::vector<Turn> QuasiStaticTips::turns_of(const std::vector<char>& moves) const {
  const auto find = [&](double share) {
    std::vector<Turn> result(plate_.tips.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      if (const auto& tip = plate_.tips[i]; moves[i])
        result[i] = turn_of(tip.factors, tip.errors, growth_.direction, section_at(tip.tip), share);
    return result;
  };
  const auto result = find(1);
  const bool any = std::ranges::any_of(result, [](const auto& one) { return turns(one.angle); });
  return any ? find(1 - equal_release) : result;
}

/// Adds the energy that the last advance has released under the whole load (the work of the loads on half of the gain
/// in displacement) and the energy predicted from the energy release rates of its tips before and after it.
void QuasiStaticTips::calibrate() {
  double predicted = 0, length = 0;
  const auto advanced = std::exchange(advanced_, {});
  for (const auto& [crack, at_back, G, gone] : advanced) {
    const auto now = std::ranges::find_if(plate_.tips, [tip = crack, back = at_back](const auto& one) {
      return one.tip.crack == tip && one.tip.at_back == back;
    });
    if (now == plate_.tips.end()) return;  // broken through
    predicted += gone * (G + *now->G) / 2;
    length += gone / double(advanced.size());
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
  if (state.ends) moves_.assign(plate_.tips.size(), 0);
  const auto advance = double(state.advance);
  draw_cracks(advance);
  auto row = row_of(state);
  if (std::isfinite(state.critical) && std::isfinite(state.critical_error))
    row.critical_load_factor_error = state.critical_error;
  for (const double length : lengths()) row.crack_length += length;
  row.tips = plate_.tips.size();
  record_.add(row);
  for (std::size_t i = 0; i < plate_.tips.size(); ++i) {
    const auto& [tip, K, G, errors, release_error] = plate_.tips[i];
    TipRow one{advance, {}, double(number_of(tip)), double(tip.crack), tip.position.x(), tip.position.y()};
    one.angle = in_degrees(std::atan2(tip.direction.y(), tip.direction.x()));
    one.length = geometry::length(cracks_[tip.crack]);
    one.moves = double(moves_[i]);
    if (G) {
      one.G = state.factor * state.factor * *G;
      one.K1 = state.factor * K.K1, one.K2 = state.factor * K.K2, one.K3 = state.factor * K.K3;
      one.N1 = state.factor * K.N1, one.N2 = state.factor * K.N2;
      one.face = name_of_face(K, growth_.direction, section_at(tip).thickness);
    }
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
  const auto paths = geometry::crack_paths(outline_, cracks_, tolerance);
  const auto tips = geometry::tips(paths);
  record_.cracks.tips = post::given_cracks(paths).tips;
  for (std::size_t i = 0; i < tips.size(); ++i) record_.cracks.tips[i].number = number_of(tips[i]);
}

const Record& QuasiStaticTips::record() {
  draw_cracks(double(advances_));
  return record_;
}

/// Tips without a ring that have something ahead; true where there were any.
bool QuasiStaticTips::break_through() {
  std::vector<geometry::Tip> tips;
  std::vector<std::optional<TipAdvance>> ways;
  for (const auto& one : plate_.tips) {
    if (one.G) continue;
    if (auto way = way_through(cracks_, one.tip)) tips.push_back(one.tip), ways.push_back(std::move(way));
  }
  if (tips.empty()) return false;
  meet(tips, ways);
  for (std::size_t i = 0; i < tips.size(); ++i) extend(tips[i], *ways[i]);
  advanced_.clear();  // what the last advance released cannot be told from this
  ++advances_;
  return true;
}

/// Pieces that turn are laid longer until their ends tell how they go on; where no length serves, as short as they may
/// be.
void QuasiStaticTips::advance(double) {
  std::vector<double> angles;
  for (const auto& turn : turns_of(moves_)) angles.push_back(turn.angle);
  const Start start{cracks_, fracture_};
  if (std::ranges::none_of(angles, turns)) {
    lay(start, angles, shortest_leg);
  } else {
    const double first = least_leg();
    bool known = lay_twice(start, angles, first);
    if (section_.thickness >= thinnest_of_longer * spacing_)
      for (double leg = first + leg_step; leg <= longest_leg && !known && stuck_.empty(); leg += leg_step) try {
          known = lay_twice(start, angles, leg);
        } catch (const plate::NumericalError&) {
          known = false;  // a longer piece that cannot be computed tells no more than the shortest
        }
    if (!known && stuck_.empty()) lay_twice(start, angles, first, true);
    if (!stuck_.empty()) return;
  }
  last_given_ = plate_.given();
  ++advances_;
}

/// Lays pieces that turn twice: the path is curved, and its end tells by how much (theory.md, "Growth"). Returns false
/// where the ends do not tell how they go on, which counts unless `anyhow`.
bool QuasiStaticTips::lay_twice(const Start& start, std::vector<double> angles, double leg, bool anyhow) {
  lay(start, angles, leg);
  auto trial = full_load(cracks_);
  if (!anyhow && !shows_directions(trial)) return false;
  if (auto why = contradicted(trial, angles); !why.empty()) {
    stay(start, std::move(why));
    return true;
  }
  if (correct(trial, angles)) {
    lay(start, angles, leg);
    trial = full_load(cracks_);
  }
  if (!anyhow && !shows_directions(trial)) return false;
  solved_ = std::move(trial);
  return true;
}

/// True where the directions of the tips that have moved are known within 30 degrees. A fit of the mode mix needs more
/// room beside the bend than a ring, the more the fewer spacings the plate is thick.
bool QuasiStaticTips::shows_directions(const LoadedPlate& trial) const {
  for (std::size_t i = 0; i < moves_.size(); ++i)
    if (const auto* end = moves_[i] ? end_of(trial, i) : nullptr)
      if (!turn_of(end->factors, end->errors, growth_.direction, section_at(end->tip)).known()) return false;
  return true;
}

void QuasiStaticTips::lay(const Start& start, const std::vector<double>& angles, double leg) {
  cracks_ = start.cracks, fracture_ = start.fracture;
  advanced_.clear();
  const bool long_leg = std::ranges::any_of(angles, turns);  // tips that move together go as far
  std::vector<geometry::Tip> tips;
  std::vector<std::optional<TipAdvance>> ways(plate_.tips.size());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    tips.push_back(plate_.tips[i].tip);
    if (moves_[i])
      ways[i] = fracture::advance(growth_, outline_, start.cracks, spacing_, tips[i], angles[i], long_leg, leg);
  }
  end_at_longest(growth_, start.cracks, spacing_, tips, ways);
  meet(tips, ways);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (!ways[i]) continue;
    extend(tips[i], *ways[i]);
    advanced_.push_back({tips[i].crack, tips[i].at_back, *plate_.tips[i].G, ways[i]->length});
  }
}

/// Undoes the advance and stores the reason: no tip has moved.
void QuasiStaticTips::stay(const Start& start, std::string why) {
  cracks_ = start.cracks, fracture_ = start.fracture, stuck_ = std::move(why);
  advanced_.clear();
  auto& [columns, rows] = record_.tips;
  const auto moves = record_.tips.column("moves");
  for (auto row = rows.end() - std::ptrdiff_t(plate_.tips.size()); row != rows.end(); ++row) (*row)[moves] = 0.0;
}

const LoadedTip* QuasiStaticTips::end_of(const LoadedPlate& trial, std::size_t mover) const {
  const auto& tip = plate_.tips[mover].tip;
  const auto end = std::ranges::find_if(
      trial.tips, [&](const auto& one) { return one.tip.crack == tip.crack && one.tip.at_back == tip.at_back; });
  return end == trial.tips.end() || !end->G ? nullptr : &*end;
}

/// Reason why a direction was wrong: after a turn a crack goes on smoothly, so an end of a piece that asks for another
/// large turn contradicts the first one.
std::string QuasiStaticTips::contradicted(const LoadedPlate& trial, const std::vector<double>& angles) const {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto* end = moves_[i] ? end_of(trial, i) : nullptr;
    if (!end || !turns(angles[i])) continue;
    const double further = kink_angle(end->factors, growth_.direction, section_at(end->tip));
    const double length = (end->tip.position - plate_.tips[i].tip.position).norm() / spacing_;
    if (std::abs(further) > contradiction * std::min(1.0, least_leg() / length))
      return fmt::format("{} would turn by {:.0f} degrees, and {:.2g} spacings on by {:.0f} more; {}{}",
                         name_of(plate_.tips[i].tip), in_degrees(angles[i]), length, in_degrees(further), remedy(),
                         governed_by_shear(growth_, section_at(end->tip), end->factors, end->errors));
  }
  return {};
}

/// Half of the turns that the ends of the pieces ask for; false where there are none to speak of.
bool QuasiStaticTips::correct(const LoadedPlate& trial, std::vector<double>& angles) const {
  bool changed = false;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto* end = moves_[i] ? end_of(trial, i) : nullptr;
    if (!end) continue;
    const double turn = turn_of(end->factors, end->errors, growth_.direction, section_at(end->tip)).angle;
    if (std::abs(turn) < least_correction) continue;
    angles[i] += turn / 2;
    changed = true;
  }
  return changed;
}

void QuasiStaticTips::extend(const geometry::Tip& tip, const TipAdvance& step) {
  if (touches_at_once(step, spacing_)) return;
  geometry::extend(cracks_[tip.crack], tip.at_back, step.to);
  fracture_ += toughness_ * mean_thickness(tip.position, step.to) * step.length;
}

/// Serialises a growth in which nothing has moved since the plate was solved, and no trial waits.
template <typename Archive, typename Self>
void QuasiStaticTips::memory(Archive& archive, Self& self) {
  archive(self.record_, self.warnings_, self.cracks_, self.most_, self.moves_, self.last_given_, self.calibrated_,
          self.measured_, self.predicted_, self.fracture_, self.advances_);
}

void QuasiStaticTips::save(plate::OutArchive& archive) const {
  memory(archive, *this);
}

void QuasiStaticTips::restore(plate::InArchive& archive) {
  memory(archive, *this);
  const auto warnings = warnings_;
  plate_ = full_load(cracks_);
  warnings_ = warnings;  // those of the solution have been said
}

}  // namespace fracture
