#include "fracture/growth/motion/moving_bonds.hpp"

#include <algorithm>

#include "fracture/growth/archive.hpp"

namespace fracture {

MovingBonds::MovingBonds(const Growth& growth, const plate::Formulation& start,
                         std::optional<post::SrifOptions> factors, double rotary_inertia)
    : MovingGrowth(growth, start, std::move(factors), rotary_inertia),
      limits_(growth, start.section(), start.discretization()),
      check_(growth, limits_, plate_, start.boundary()),
      cracks_(start, start.section().shear_wave_speed()),
      bonds_(plate_, check_, [this](const auto& bonds, double time) { return broke(bonds, time); }) {}

/// May more bonds break?
bool MovingBonds::broke(const std::vector<LoadedBond>& bonds, double time) {
  const bool new_lines = cracks_.broke(bonds, time);
  if (++advances_ >= growth_.max_advances) return false;
  return !growth_.max_length || !new_lines || !growth_.reached(cracks_.length_now());
}

/// A row of the history is an advance of the record.
void MovingBonds::look(double time) {
  const auto advance = double(record_.growth.rows.size());
  cracks_.look(time, record_, advance);
  for (const auto& tip : cracks_.tips()) largest_speed_ = std::max(largest_speed_, tip.speed);
  GrowthRow row{advance, time};
  row.broken_bonds = double(cracks_.broken()), row.crack_length = cracks_.length(), row.tips = cracks_.tips().size();
  row.fracture_energy = bonds_.fracture_energy();
  record_.add(row);
}

const Record& MovingBonds::record() {
  record_.cracks = cracks_.drawn();
  return record_;
}

Moved MovingBonds::moved() const {
  auto result = moved_so_far();
  result.broken = cracks_.broken();
  result.advances = advances_;
  result.largest_speed = largest_speed_;
  result.spent = growth_.spent(bonds_.fracture_energy(), start_.section().thickness, cracks_.growth());
  for (const auto& line : cracks_.lines()) result.lengths.push_back(line.length);
  return result;
}

void MovingBonds::remember(plate::OutArchive& archive) const {
  memory(archive, *this);
  archive(cracks_, bonds_, advances_, largest_speed_);
}

void MovingBonds::recall(plate::InArchive& archive) {
  memory(archive, *this);
  archive(cracks_, bonds_, advances_, largest_speed_);
}

}  // namespace fracture
