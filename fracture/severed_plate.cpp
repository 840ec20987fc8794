#include "fracture/severed_plate.hpp"

#include <algorithm>

#include "plate/position_aware.hpp"

namespace fracture {

SeveredPlate::SeveredPlate(const plate::FamilyOperator& base, const plate::Boundary& boundary, const plate::Section& section)
    : base_(base), boundary_(boundary), section_(section), families_(base.families()), change_of_(base.points(), -1) {
  for (const auto& shape : base.shapes()) reach_ = std::max(reach_, shape.length / boundary.cloud.units.spacing);
}

plate::OwnFamily SeveredPlate::base_family(std::uint32_t k) const {
  const auto& weights = base_.weights();
  plate::OwnFamily result{k, boundary_.cloud.areas[k], weights.a[weights.kind[k]], {}};
  const auto family = base_.families()[k];
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto& shape = base_.shapes()[family[i].vector_id];
    result.bonds.push_back({family[i].neighbour, shape.mx, shape.my, shape.length, weights.of(k, i)});
  }
  return result;
}

plate::OwnFamily SeveredPlate::family(std::uint32_t k) const {
  plate::OwnFamily result{k, boundary_.cloud.areas[k], 0, {}};
  std::vector<plate::FamilyBond> bonds;
  for (const auto [j, id] : families_[k])
    bonds.push_back({families_.vectors()[id], base_.shapes()[id].weight * boundary_.cloud.areas[j]});
  auto own = boundary_.active[k] ? plate::position_aware(section_, bonds) : plate::FamilyWeights{};
  own.bonds.resize(bonds.size());
  result.a = own.a;
  std::size_t i = 0;
  for (const auto [j, id] : families_[k]) {
    const auto& shape = base_.shapes()[id];
    result.bonds.push_back({j, shape.mx, shape.my, shape.length, own.bonds[i++]});
  }
  return result;
}

std::optional<std::size_t> SeveredPlate::sever(const geometry::CrackPath& path, bool at_back, double piece) {
  const auto& units = boundary_.cloud.units;
  const auto lattice = geometry::to_lattice({path}, units).front();
  const auto& v = lattice.vertices;
  const geometry::Point end = at_back ? v.back() : v.front(), before = at_back ? v[v.size() - 2] : v[1];
  const geometry::Point begin = end + std::min(1.0, piece / units.spacing / (before - end).norm()) * (before - end);
  const auto cut = [&](const geometry::Point& p, const geometry::Point& q) { return geometry::severs(lattice, p, q); };

  std::vector<std::pair<std::uint32_t, std::vector<geometry::Families::Step>>> touched;
  std::vector<geometry::Families::Step> kept;
  for (std::uint32_t k = 0; k < points(); ++k) {
    // a horizon beside the piece, or beside its image behind an edge that is within one
    if (geometry::distance({begin, end}, boundary_.lattice[k]) > 3 * reach_) continue;
    kept.clear();
    const auto family = families_[k];
    for (const auto bond : family)
      if (!boundary_.any_image(std::min(k, bond.neighbour), std::max(k, bond.neighbour), cut))
        kept.push_back({std::int32_t(std::int64_t(bond.neighbour) - std::int64_t(k)), bond.vector_id});
    if (kept.size() == family.size()) continue;
    if (is_going(k)) return std::nullopt;
    touched.emplace_back(k, kept);
  }
  Severing result{severings_++, {}, {}};
  for (const auto& [k, steps] : touched) {
    if (change_of_[k] < 0) {
      change_of_[k] = std::int32_t(changed_.size());
      changed_.push_back({base_family(k), base_family(k)});
      differences_.resize(differences_.size() + changed_.back().base.bonds.size());
      first_difference_.push_back(differences_.size());
      settle(changed_.back().now);
    }
    result.before.push_back(changed_[std::size_t(change_of_[k])].now);
    families_.set(k, steps);
  }
  for (const auto& one : result.before) result.after.push_back(family(one.point));
  going_.push_back(std::move(result));
  return going_.back().number;
}

bool SeveredPlate::is_going(std::uint32_t k) const {
  for (const auto& one : going_)
    for (const auto& family : one.before)
      if (family.point == k) return true;
  return false;
}

double SeveredPlate::carry_on(std::size_t number, double share, const plate::State& state, const plate::State& velocity,
                              double time_step) {
  const auto found = std::ranges::find(going_, number, &Severing::number);
  auto& one = *found;
  double drop = 0;
  for (std::size_t i = 0; i < one.before.size(); ++i)
    for (const auto& [family, sign] : {std::pair{&one.before[i], 1.0}, {&one.after[i], -1.0}})
      drop += sign * (plate::energy(*family, state, state) - time_step * plate::energy(*family, state, velocity));
  const double spent = (share - one.share) * drop;
  one.share = share;
  if (share < 1) return spent;
  for (const auto& after : one.after) settle(after);
  going_.erase(found);
  return spent;
}

void SeveredPlate::settle(const plate::OwnFamily& now) {
  const auto number = std::size_t(change_of_[now.point]);
  changed_[number].now = now;
  const auto& base = changed_[number].base;
  std::size_t n = 0;  // bonds of the family now are among those of the base, in the same order
  for (std::size_t i = 0; i < base.bonds.size(); ++i) {
    const auto& bond = base.bonds[i];
    plate::BondWeights left;
    if (n < now.bonds.size() && now.bonds[n].neighbour == bond.neighbour) left = now.bonds[n++].weights;
    differences_[first_difference_[number] + i] = {bond.neighbour,      bond.mx, bond.my,
                                                   bond.length,         bond.weights.D, left.D,
                                                   2 * base.area * (left.B - bond.weights.B),
                                                   2 * base.area * (left.S - bond.weights.S)};
  }
}

void SeveredPlate::internal_force(const plate::State& state, plate::Forces& forces) const {
  base_.internal_force(state, forces);
  const auto kinematics = [&](std::uint32_t k) { return plate::Kinematics<>{state(0, k), state(1, k), state(2, k)}; };
  given_.resize(2 * differences_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < changed_.size(); ++c) {
    const auto own = kinematics(changed_[c].base.point);
    double base = 0, now = 0;
    for (auto i = first_difference_[c]; i < first_difference_[c + 1]; ++i) {
      const double curvature = curvature_difference(differences_[i], own, kinematics(differences_[i].neighbour));
      base += differences_[i].D_base * curvature, now += differences_[i].D_now * curvature;
    }
    const double twice = 2 * changed_[c].base.area;
    base *= twice * changed_[c].base.a, now *= twice * changed_[c].now.a;
    for (auto i = first_difference_[c]; i < first_difference_[c + 1]; ++i) {
      const auto& d = differences_[i];
      const auto other = kinematics(d.neighbour);
      const double bend = d.D_now * now - d.D_base * base + d.curvature * curvature_difference(d, own, other);
      const double shear = d.shear * shear_difference(d, own, other), lever = shear * d.length / 2;
      given_[2 * i] = {shear, d.mx * (bend + lever), d.my * (bend + lever)};
      given_[2 * i + 1] = {-shear, d.mx * (lever - bend), d.my * (lever - bend)};
    }
  }
  for (std::size_t c = 0; c < changed_.size(); ++c)
    for (auto i = first_difference_[c]; i < first_difference_[c + 1]; ++i) {
      forces.col(changed_[c].base.point) += given_[2 * i];
      forces.col(differences_[i].neighbour) += given_[2 * i + 1];
    }
  for (const auto& one : going_)
    for (std::size_t i = 0; i < one.before.size(); ++i) {
      add_force(one.before[i], state, -one.share, forces);
      add_force(one.after[i], state, one.share, forces);
    }
}

void SeveredPlate::absolute_product(const plate::State& state, plate::Forces& forces) const {
  base_.absolute_product(state, forces);
}

plate::Forces SeveredPlate::diagonal() const { return base_.diagonal(); }

}  // namespace fracture
