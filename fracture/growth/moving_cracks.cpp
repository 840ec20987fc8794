#include "fracture/growth/moving_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/stretching.hpp"
#include "post/factors/plate_factors.hpp"

namespace fracture {
namespace {

constexpr std::size_t look_every = 4;  // steps, of a tip at rest: it can go a spacing in two
constexpr double first_speed = 0.3;    // of a tip that starts: of the limit
constexpr double least_speed = 0.02;   // of one that runs: of the limit
constexpr double recent_length = 3;    // spacings: a lattice's steps under an angle to it
constexpr double gain = 0.45, gain_of_all = 1.5;
constexpr double gauge_reach = 20;  // spacings: rings of 7.6 and two horizons about them, and more than that
constexpr double look_after = 5;    // spacings gone without a look at the direction
constexpr double settled_after = 10,
                 steady_length = 5;                    // spacings: a tip's speed is steady, and is judged over these
constexpr double least_taken = 0.6, most_taken = 1.6;  // of the fracture energy, of a tip whose speed is resolved
constexpr double equal_time = 1e-9;                    // of the time that a piece takes, the same
constexpr double alike = 1e-6;                         // of energies: what rounding leaves between mirror images

std::vector<geometry::Polyline> polylines(const std::vector<geometry::CrackPath>& paths) {
  std::vector<geometry::Polyline> result;
  for (const auto& path : paths) result.push_back(path.vertices);
  return result;
}

}  // namespace

MovingCracks::MovingCracks(const Growth& growth, const plate::Problem& problem, DamagedPlate& plate,
                           std::vector<geometry::CrackPath> paths, const plate::Problem* membrane)
    : growth_(growth),
      problem_(problem),
      membrane_(membrane),
      plate_(plate),
      paths_(std::move(paths)),
      spacing_(problem.discretization.spacing),
      toughness_(growth.fracture_energy * problem.section.thickness),
      speed_limit_(0.93 * problem.section.shear_wave_speed()) {
  for (const auto& tip : geometry::tips(paths_)) tips_.push_back({tip, first_speed * speed_limit_});
}

/// The energy release rate of a tip; none where no ring fits about it.
std::shared_ptr<const MovingCracks::Gauge> MovingCracks::gauge(const geometry::Tip& tip) const {
  post::SrifOptions options;
  options.methods = {post::SrifMethod::virtual_crack_extension};
  options.first_ring_only = true;
  const double near = 7.6 * spacing_;  // rings of 7 spacings: a quarter of the work of the usual 16
  auto found = post::tip_methods(plate_.tip_view(), problem_, paths_, tip, options, near);
  if (!found) return nullptr;
  if (!membrane_) return std::make_shared<const Gauge>(Gauge{std::move(*found), std::nullopt});
  auto in_plane = post::tip_methods(plate_.plane()->tip_view(), *membrane_, paths_, tip, options, near);
  return in_plane ? std::make_shared<const Gauge>(Gauge{std::move(*found), std::move(in_plane)}) : nullptr;
}

/// Evaluates a tip on the rank that has it and sends the result to all ranks.
MovingCracks::TipMeasurement MovingCracks::look(MovingTip& tip, const Strained& now) const {
  std::vector<TipMeasurement> seen;
  if (plate_.here(tip.tip.position)) {
    if (!tip.gauge) tip.gauge = gauge(tip.tip);
    if (tip.gauge) {
      const auto srif = tip.gauge->bending(now.state, now.force, false).front();
      const auto& [K1, K2, K3] = srif.errors;
      seen.push_back({true,
                      *srif.G,
                      {srif.K1, srif.K2, srif.K3},
                      {K1.value_or(INFINITY), K2.value_or(INFINITY), K3.value_or(INFINITY)}});
    } else {
      seen.emplace_back();
    }
    if (tip.gauge && membrane_) {
      const auto srif = (*tip.gauge->in_plane)(*now.in_plane, *now.force_in_plane, false).front();
      auto& [fits, G, factors, errors] = seen.back();
      G += *srif.G;
      factors.N1 = srif.K1, factors.N2 = srif.K2;
      errors.N1 = srif.errors[0].value_or(INFINITY), errors.N2 = srif.errors[1].value_or(INFINITY);
    }
  }
  return plate::gathered(plate_.map(), seen).at(0);
}

std::vector<std::pair<std::size_t, geometry::Tip>> MovingCracks::tips() const {
  std::vector<std::pair<std::size_t, geometry::Tip>> result;
  for (std::size_t i = 0; i < tips_.size(); ++i)
    if (!tips_[i].ended) result.emplace_back(i, tips_[i].tip);
  return result;
}

bool MovingCracks::stays(const MovingTip& tip, double G, const Factors& factors) const {
  const bool long_enough = growth_.reached(geometry::length(paths_[tip.tip.crack].vertices));
  const double h = problem_.section.thickness;
  return growth_.held(tip.tip.position) || long_enough || pieces_.size() >= growth_.max_advances || G < toughness_ ||
         (growth_.tension_only && factors.K1 + h / 6 * factors.N1 <= 0) || pressed(factors, h);
}

/// False: the tip stops, because its direction is not resolved.
bool MovingCracks::finds_direction(std::size_t tip, const TipMeasurement& seen, double time, double& angle) {
  const auto turn = turn_of(seen.factors, seen.errors, growth_.direction, problem_.section);
  angle = turn.angle;
  direction_unknown_ |= !turn.known() && turn.resolved();
  if (turn.resolved()) return true;
  tips_[tip].ended = true;
  stopped_.push_back({time, tip, tips_[tip].tip.position, turn.asked, turn.error});
  return false;
}

/// Ways of tips that go on together: every tip sees the cracks as they are before any of them does. A tip that stands
/// on what it would reach ends there, and has none.
std::vector<std::optional<TipAdvance>> MovingCracks::ways_of(const std::vector<Departure>& departures) {
  const auto before = polylines(paths_);
  std::vector<geometry::Tip> tips;
  std::vector<std::optional<TipAdvance>> result;
  for (const auto& [number, angle, time] : departures) {
    tips.push_back(tips_[number].tip);
    result.push_back(advance(growth_, problem_.outline, before, spacing_, tips.back(), angle, turns(angle)));
  }
  meet(tips, result);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!touches_at_once(*result[i], spacing_)) continue;
    const auto number = departures[i].tip;
    tips_[number].ended = true;
    const auto last =
        std::find_if(pieces_.rbegin(), pieces_.rend(), [&](const auto& one) { return one.tip == number; });
    if (last != pieces_.rend()) last->reached = name_of(*result[i]->reached);
    result[i].reset();
  }
  return result;
}

/// Tips whose pieces break bonds of the same points go on at the same share of them. A tip waits where a piece that
/// goes on breaks such bonds.
void MovingCracks::depart(const std::vector<Departure>& departures) {
  if (departures.empty()) return;
  const auto ways = ways_of(departures);
  std::vector<CrackPiece> pieces;
  std::vector<std::size_t> going;
  for (std::size_t i = 0; i < departures.size(); ++i) {
    if (!ways[i]) continue;
    const auto& tip = tips_[departures[i].tip].tip;
    auto path = paths_[tip.crack];
    geometry::extend(path.vertices, tip.at_back, ways[i]->to);
    if (const auto& reached = ways[i]->reached)
      (tip.at_back ? path.back : path.front) = reached->crack ? geometry::End::junction : geometry::End::mouth;
    pieces.push_back({std::move(path), tip.at_back, ways[i]->length});
    going.push_back(i);
  }
  const auto breakages = plate_.break_bonds(pieces);
  for (std::size_t n = 0; n < going.size(); ++n) {
    if (!breakages[n]) continue;
    double begin = 0, duration = 0;  // of all that go on with it
    for (std::size_t m = 0; m < going.size(); ++m)
      if (breakages[m] == breakages[n]) {
        begin = std::max(begin, departures[going[m]].time);
        duration = std::max(duration, pieces[m].length / tips_[departures[going[m]].tip].speed);
      }
    const auto& way = *ways[going[n]];
    auto& tip = tips_[departures[going[n]].tip];
    auto& vertices = paths_[tip.tip.crack].vertices;
    geometry::extend(vertices, tip.tip.at_back, way.to);
    (tip.tip.at_back ? paths_[tip.tip.crack].back : paths_[tip.tip.crack].front) =
        tip.tip.at_back ? pieces[n].path.back : pieces[n].path.front;
    tip.running = Running{*breakages[n], begin, duration, way.length, 0, tip.tip.position, way};
    tip.tip.direction = (way.to - tip.tip.position).normalized();
    tip.tip.position = way.to;
    tip.since_look += way.length;
    for (auto& other : tips_)  // bonds that break in the rings of another gauge make that wrong
      if ((other.tip.position - way.to).norm() <= way.length + gauge_reach * spacing_) other.gauge.reset();
    length_ += way.length, tip.length += way.length;
  }
}

double MovingCracks::taken_lately(std::size_t tip) const {
  double length = 0, spent = 0;
  for (auto piece = pieces_.rbegin(); piece != pieces_.rend() && length < steady_length * spacing_ * (1 - 1e-9);
       ++piece)
    if (piece->tip == tip) {
      const double gone = (piece->to - piece->from).norm();
      length += gone, spent += piece->spent * gone;
    }
  return spent / length;
}

bool MovingCracks::arrive(MovingTip& tip, const plate::Step& now) {
  const Running done = *tip.running;
  tip.running.reset();
  const double taken = done.spent / (toughness_ * done.length);
  tip.spent += done.spent;
  pieces_.push_back({done.begin, now.time, tip.tip.crack, tip.tip.at_back, done.from, tip.tip.position, taken,
                     done.way.reached ? name_of(*done.way.reached) : "", std::size_t(&tip - tips_.data()), 0});
  tip.ended = done.way.reached.has_value();
  pieces_.back().tips = tips().size();
  if (tip.ended) return false;
  const auto number = std::size_t(&tip - tips_.data());
  if (const double steady = taken_lately(number);
      tip.length >= settled_after * spacing_ && (steady < least_taken || steady > most_taken)) {
    tip.ended = true;
    stopped_.push_back({now.time, number, tip.tip.position, 0, 0, steady});
    return false;
  }
  tip.gauge.reset();
  tip.next_look = now.step;
  tip.recent.push_back({done.length, done.spent});
  double length = 0, spent = 0;
  for (const auto& [l, e] : tip.recent) length += l, spent += e;
  while (length - tip.recent.front().first >= recent_length * spacing_ * (1 - 1e-9))
    length -= tip.recent.front().first, spent -= tip.recent.front().second, tip.recent.pop_front();
  // faster where more than the fracture energy was taken, by the last pieces and by all
  const double lately = spent / (toughness_ * length), all = tip.spent / (toughness_ * tip.length);
  tip.speed = std::clamp(tip.speed * std::pow(lately, gain) * std::pow(all, gain_of_all), least_speed * speed_limit_,
                         speed_limit_);
  const bool straight = growth_.direction == Growth::Direction::straight || tip.since_look < look_after * spacing_;
  return lately >= 1 - alike && straight;
}

void MovingCracks::before_force(const plate::Step& now) {
  if (std::ranges::any_of(tips_, [](const auto& tip) { return tip.running.has_value(); }))
    plate_.constraints().fetch(now.velocity);
  std::map<std::size_t, double> lengths, spent;  // by breakage: of its pieces, and the energy of this step
  for (const auto& tip : tips_)
    if (tip.running) lengths[tip.running->breakage] += tip.running->length;
  std::vector<Departure> departures;
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    auto& tip = tips_[i];
    if (!tip.running) continue;
    auto& running = *tip.running;
    const double gone = (now.time - running.begin) / running.duration, share = gone < 1 - equal_time ? gone : 1;
    if (!spent.contains(running.breakage))
      spent[running.breakage] = plate_.carry_on(running.breakage, share, {now.state, now.velocity, now.time_step});
    const double own = spent[running.breakage] * (running.length / lengths[running.breakage]);
    running.spent += own, spent_ += own;
    const double end = running.begin + running.duration;
    if (share >= 1 && arrive(tip, now)) departures.push_back({i, 0, end});
  }
  std::erase_if(departures, [&](const auto& one) { return stays(tips_[one.tip], toughness_, {1, 0, 0}); });
  depart(departures);
}

void MovingCracks::after_force(const plate::Step& now, const plate::Forces& force) {
  const auto& elastic_supports = plate_.base().elastic_supports();
  // where there are elastic supports, without these; where the plate is distributed, with those of others
  plate::Forces own, in_plane;
  plate::State bent, plane;  // where loads act in the plane
  std::vector<std::pair<std::size_t, TipMeasurement>> looked;
  bool any = false;  // does one of them start?
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    auto& tip = tips_[i];
    if (tip.running || tip.ended || now.step < tip.next_look) continue;
    if (membrane_ && own.size() == 0) {
      bent = plate::of_plate(now.state), plane = plate::of_plane(now.state);
      own = plate::of_plate(force), in_plane = plate::of_plane(force);
      elastic_supports.take_force(bent, own);
    }
    if ((plate_.map().distributed() || !elastic_supports.parts().empty()) && own.size() == 0) {
      own = force;
      elastic_supports.take_force(now.state, own);
      plate_.constraints().fetch(own);
    }
    const TipMeasurement seen = look(
        tip, membrane_ ? Strained{bent, own, &plane, &in_plane} : Strained{now.state, own.size() > 0 ? own : force});
    tip.ended = !seen.fits;
    if (tip.ended) continue;
    tip.next_look = now.step + look_every;
    tip.since_look = 0;
    any |= !stays(tip, seen.G, seen.factors);
    looked.emplace_back(i, seen);
  }
  std::vector<Departure> departures;
  for (const auto& [i, seen] : looked) {
    double angle = 0;
    if (any && !stays(tips_[i], seen.G * (1 + alike), seen.factors) && finds_direction(i, seen, now.time, angle))
      departures.push_back({i, angle, now.time});
  }
  depart(departures);
}

}  // namespace fracture
