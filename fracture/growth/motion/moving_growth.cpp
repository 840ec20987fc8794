#include "fracture/growth/motion/moving_growth.hpp"

#include <algorithm>

#include "fracture/growth/motion/moving_bonds.hpp"
#include "fracture/growth/motion/moving_tips.hpp"
#include "fracture/severing/shared_points.hpp"
#include "plate/formulation/parts/pieces.hpp"
#include "post/factors/plate_factors.hpp"

namespace fracture {

MovingGrowth::MovingGrowth(const Growth& growth, const plate::Formulation& start,
                           std::optional<post::SrifOptions> factors, double rotary_inertia)
    : growth_(growth),
      start_(start),
      plate_(*start.breaking(), start.boundary(), {start.section(), start.discretization()},
             seen_by_growth(start, factors || !growth.by_bonds())),
      options_(std::move(factors)),
      rotary_inertia_(rotary_inertia) {
  record_.in_motion = true;
  if (!options_) return;
  const auto by_energy = std::ranges::count_if(
      options_->methods, [](const auto& m) { return m == "virtual_crack_extension" || m == "domain_integral"; });
  options_->first_ring_only = by_energy == 2;  // one estimates the error of the other
}

plate::Changes& MovingGrowth::changes() {
  if (growth_.fallen == Growth::Fallen::move) return severing();
  if (!fallen_) fallen_.emplace(severing(), plate_, start_.boundary(), start_.mass(rotary_inertia_));
  return *fallen_;
}

std::vector<post::Srif> MovingGrowth::factors(const plate::State& state) const {
  std::vector<post::Srif> result;
  if (!options_) return result;
  plate::Forces force;
  plate_.internal_force(state, force);
  start_.boundary().attached.take_force(state, force);
  plate_.constraints().fetch(force);
  const auto now = paths();
  const auto view = plate_.tip_view();
  for (const auto& [number, tip] : tips()) {
    if (!plate_.here(tip.position)) continue;
    const auto methods = post::tip_methods(view, start_.problem(), now, tip, *options_);
    if (!methods) continue;  // an edge or another crack is too near
    for (auto& srif : (*methods)(state, force, false)) {
      srif.tip = number;
      post::normalize(srif, *options_, start_.section().thickness);
      result.push_back(std::move(srif));
    }
  }
  return result;
}

Moved MovingGrowth::moved_so_far() const {
  Moved result;
  result.parts = plate::pieces(start_.boundary(), plate_.families()).size();
  result.parts_before = plate::pieces(start_.boundary(), start_.families()).size();
  result.frozen = growth_.fallen == Growth::Fallen::freeze;
  return result;
}

std::unique_ptr<MovingGrowth> moving_growth(const Growth& growth, const plate::Formulation& start,
                                            std::optional<post::SrifOptions> factors, double rotary_inertia) {
  if (growth.by_bonds()) return std::make_unique<MovingBonds>(growth, start, std::move(factors), rotary_inertia);
  return std::make_unique<MovingTips>(growth, start, std::move(factors), rotary_inertia);
}

}  // namespace fracture
