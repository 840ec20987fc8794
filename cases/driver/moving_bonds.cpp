#include "cases/driver/moving_bonds.hpp"

#include <fmt/format.h>

namespace cases {

MovingBonds::MovingBonds(const CaseFile& file, const Assembly& assembly)
    : MovingGrowth(file, assembly), limits_(*case_.growth, case_.section, case_.discretization),
      check_(*case_.growth, limits_, plate_, assembly.boundary), cracks_(assembly, case_.section.shear_wave_speed()),
      bonds_(plate_, check_, [this](const auto& bonds, double time) { return broke(bonds, time); }) {
  growth_.columns = {"time", "broken_bonds", "crack_length", "tips", "fracture_energy"};
}

/// May more bonds break?
bool MovingBonds::broke(const std::vector<fracture::LoadedBond>& bonds, double time) {
  const bool new_lines = cracks_.broke(bonds, time);
  const auto& growth = *case_.growth;
  if (++advances_ >= growth.max_advances) return false;
  return !growth.max_length || !new_lines || cracks_.length_now() < *growth.max_length * (1 - 1e-9);
}

void MovingBonds::look(double time) {
  cracks_.look(time);
  for (const auto& tip : cracks_.tips()) largest_speed_ = std::max(largest_speed_, tip.speed);
  growth_.rows.push_back({time, double(cracks_.broken()), cracks_.length(), double(cracks_.tips().size()), bonds_.fracture_energy()});
}

void MovingBonds::write(const std::filesystem::path& folder, bool lines) const {
  post::write_csv(folder / "growth.csv", growth_);
  cracks_.write(folder, "time", lines);
}

post::GrowthSummary MovingBonds::summary() const {
  post::GrowthSummary result;
  result.broken_bonds = cracks_.broken();
  result.advances = advances_;
  result.outcome = cracks_.broken() == 0 ? "no bond broke" : fmt::format("{} bonds broken", cracks_.broken());
  result.outcome += parts();
  result.largest_speed = largest_speed_;
  if (cracks_.growth() > 0 && case_.growth->fracture_energy > 0)
    result.spent = bonds_.fracture_energy() / (case_.growth->fracture_energy * case_.section.thickness * cracks_.growth());
  for (const auto& line : cracks_.lines()) result.lengths.push_back(line.length);
  return result;
}

}  // namespace cases
