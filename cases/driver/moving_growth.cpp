#include "cases/driver/moving_growth.hpp"

#include <fmt/format.h>

#include "cases/driver/moving_bonds.hpp"
#include "cases/driver/moving_tips.hpp"
#include "cases/driver/severed_frame.hpp"
#include "plate/solve/pieces.hpp"

namespace cases {

MovingGrowth::MovingGrowth(const CaseFile& file, const Assembly& assembly)
    : case_(file.content), assembly_(assembly),
      plate_(*assembly.ordinary(), assembly.boundary, {case_.section, case_.discretization}) {}

plate::Changes& MovingGrowth::changes() {
  if (case_.growth->fallen == fracture::Growth::Fallen::move) return severing();
  if (!fallen_) fallen_.emplace(severing(), plate_, assembly_.boundary, mass_of(case_, assembly_));
  return *fallen_;
}

std::vector<post::Srif> MovingGrowth::sample(double time, const plate::State& state) {
  look(time);
  std::vector<post::Srif> result;
  if (!case_.srif) return result;
  plate::Forces force;
  plate_.internal_force(state, force);
  const auto now = paths();
  auto options = *case_.srif;
  const auto by_energy = std::ranges::count_if(options.methods, [](const auto& m) { return m == "virtual_crack_extension" || m == "domain_integral"; });
  options.first_ring_only = by_energy == 2;  // one estimates the error of the other
  for (const auto& [number, tip] : tips()) try {
      for (auto& srif : severed_tip_methods(case_, assembly_, plate_.families(), now, tip, options)(state, force, false)) {
        srif.tip = number;
        post::normalize(srif, *case_.srif, case_.section.thickness);
        result.push_back(std::move(srif));
      }
    } catch (const std::invalid_argument&) {
      continue;  // an edge or another crack is too near
    }
  return result;
}

post::Mesh MovingGrowth::draw(post::Frame& frame, const plate::State& state) const {
  return severed_frame(case_, assembly_, plate_.families(), frame, state);
}

std::string MovingGrowth::parts() const {
  const auto now = plate::pieces(assembly_.boundary, plate_.families()).size();
  if (now <= plate::pieces(assembly_.boundary, assembly_.families()).size()) return "";
  const bool frozen = case_.growth->fallen == fracture::Growth::Fallen::freeze;
  return fmt::format("; the plate split in {} parts{}", now, frozen ? "" : ", which move on");
}

std::unique_ptr<MovingGrowth> moving_growth(const CaseFile& file, const Assembly& assembly) {
  if (file.content.growth->by_bonds()) return std::make_unique<MovingBonds>(file, assembly);
  return std::make_unique<MovingTips>(file, assembly);
}

}  // namespace cases
