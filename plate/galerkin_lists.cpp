#include "plate/galerkin_lists.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "plate/lanes.hpp"

namespace plate {
namespace {

using geometry::Point;
using Vector = Lane<double>;
constexpr std::size_t lanes = Vector::size();

// numbers of a bond: direction, 1 / length, gradient times length, share
constexpr std::size_t bond_numbers = 6;
// numbers of a family: V D, V f S, t_b D, t_s e S, sums of share n n (3) and share n n n n (5)
constexpr std::size_t family_numbers = 12;
constexpr std::size_t most_bonds = 32;  // that are kept between the two loops over a family

Vector loaded(const double* from) {
  return Vector(from, simd::element_aligned);
}

void store(const Vector& value, double* to) {
  value.copy_to(to, simd::element_aligned);
}

}  // namespace

GalerkinLists::GalerkinLists(const GalerkinFamilies& families, const Section& section,
                             const std::vector<std::uint32_t>& points)
    : points_(points), poisson_(section.poisson) {
  std::vector<char> acts(families.areas.size(), 0);
  for (const auto i : points) {
    acts[i] = 1;
    for (const auto& bond : families.families[i]) acts[bond.neighbour] = 1;
  }
  for (std::uint32_t k = 0; k < acts.size(); ++k)
    if (acts[k]) kept_.push_back(k);
  // by size within pieces that stay in the cache
  constexpr std::size_t piece = 2048;
  for (std::size_t begin = 0; begin < kept_.size(); begin += piece)
    std::stable_sort(kept_.begin() + std::ptrdiff_t(begin),
                     kept_.begin() + std::ptrdiff_t(std::min(kept_.size(), begin + piece)),
                     [&](auto a, auto b) { return families.families[a].size() < families.families[b].size(); });
  for (std::size_t first = 0; first < kept_.size(); first += lanes) add_block(families, section, first);
  find_slots(families, points);
  given_.assign(3 * lanes * (members_.size() / lanes + blocks_.size()), 0);
}

/// Families kept_[first] and those after it; lanes that are left over repeat the last one.
void GalerkinLists::add_block(const GalerkinFamilies& families, const Section& section, std::size_t first) {
  const auto of_lane = [&](std::size_t lane) { return kept_[std::min(first + lane, kept_.size() - 1)]; };
  std::size_t most = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) most = std::max(most, families.families[of_lane(lane)].size());
  if (most > most_bonds) throw std::invalid_argument("a point has more than 32 neighbours");
  blocks_.push_back({members_.size() / lanes, std::uint32_t(most)});
  members_.resize(members_.size() + most * lanes);
  bonds_.resize(bonds_.size() + most * lanes * bond_numbers, 0);
  families_.resize(families_.size() + lanes * family_numbers, 0);
  double* const own = families_.data() + (blocks_.size() - 1) * lanes * family_numbers;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto k = of_lane(lane);
    kept_lanes_.push_back(k);
    const auto family = families.families[k];
    const GalerkinStiffness s(section, families.square(k));
    std::array<double, family_numbers> sums{families.areas[k] * s.D, families.areas[k] * s.shear, s.bending_residual,
                                            s.shear_residual};
    for (std::size_t b = 0; b < most; ++b) {
      const auto at = blocks_.back().first_bond + b;
      members_[at * lanes + lane] = b < family.size() ? family[b].neighbour : k;
      if (b >= family.size()) continue;
      const Point& x = families.families.vectors()[family[b].vector_id];
      const auto& bond = families.of(k)[b];
      const double length = x.norm(), nx = x.x() / length, ny = x.y() / length, c = bond.share;
      const std::array<double, bond_numbers> numbers{
          nx, ny, 1 / length, bond.gradient.x() * length, bond.gradient.y() * length, c};
      for (std::size_t n = 0; n < bond_numbers; ++n) bonds_[(at * bond_numbers + n) * lanes + lane] = numbers[n];
      const std::array<double, 8> products{nx * nx,           nx * ny,           ny * ny,           nx * nx * nx * nx,
                                           nx * nx * nx * ny, nx * nx * ny * ny, nx * ny * ny * ny, ny * ny * ny * ny};
      for (std::size_t n = 0; n < products.size(); ++n) sums[4 + n] += c * products[n];
    }
    for (std::size_t n = 0; n < family_numbers; ++n) own[n * lanes + lane] = sums[n];
  }
}

/// Every point takes what its own family and those of its neighbours leave for it.
void GalerkinLists::find_slots(const GalerkinFamilies& families, const std::vector<std::uint32_t>& points) {
  std::vector<std::uint32_t> place(families.areas.size());
  for (std::uint32_t n = 0; n < kept_.size(); ++n) place[kept_[n]] = n;
  const auto bond_slots = members_.size() / lanes;
  // three rows of lanes for every bond, then for every block
  const auto slot = [&](std::size_t row, std::size_t lane) { return std::uint32_t(3 * lanes * row + lane); };
  first_slot_.push_back(0);
  for (const auto i : points) {
    slots_.push_back(slot(bond_slots + place[i] / lanes, place[i] % lanes));
    for (const auto& bond : families.families[i]) {
      const auto n = place[bond.neighbour];
      const auto b = families.families[bond.neighbour].find(i);
      slots_.push_back(slot(blocks_[n / lanes].first_bond + b, n % lanes));
    }
    first_slot_.push_back(slots_.size());
  }
}

/// One block of families: strains, then what each bond leaves at its member and at its owner.
void GalerkinLists::act(std::size_t block, const State& state) const {
  const double* const w = state.row(0).data();
  const double* const theta_x = state.row(1).data();
  const double* const theta_y = state.row(2).data();
  const auto [first, count] = blocks_[block];
  const std::uint32_t* const owners = kept_lanes_.data() + block * lanes;
  const Vector own_w = gather(w, owners), own_x = -gather(theta_y, owners), own_y = gather(theta_x, owners);
  const auto number = [&](std::size_t b, std::size_t n) {
    return loaded(bonds_.data() + ((first + b) * bond_numbers + n) * lanes);
  };

  Vector turn_x[most_bonds], turn_y[most_bonds], shear[most_bonds];  // (psi_i - psi_k) / length, bond shear angle
  Vector Hxx = 0, Hxy = 0, Hyx = 0, Hyy = 0, gamma_x = 0, gamma_y = 0;
  Vector Axx = 0, Axy = 0, Ayx = 0, Ayy = 0, Bxx = 0, Bxy = 0, Byy = 0, shear_x = 0, shear_y = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const std::uint32_t* const members = members_.data() + (first + b) * lanes;
    const Vector x = -gather(theta_y, members), y = gather(theta_x, members);
    const Vector nx = number(b, 0), ny = number(b, 1), inverse = number(b, 2), Gx = number(b, 3), Gy = number(b, 4),
                 c = number(b, 5);
    const Vector ux = (x - own_x) * inverse, uy = (y - own_y) * inverse;
    const Vector g = (gather(w, members) - own_w) * inverse - 0.5 * (nx * (x + own_x) + ny * (y + own_y));
    turn_x[b] = ux, turn_y[b] = uy, shear[b] = g;
    Hxx += ux * Gx, Hxy += ux * Gy, Hyx += uy * Gx, Hyy += uy * Gy;
    gamma_x += g * Gx, gamma_y += g * Gy;
    const Vector cx = c * nx, cy = c * ny, along = ux * nx + uy * ny;
    Axx += ux * cx, Axy += ux * cy, Ayx += uy * cx, Ayy += uy * cy;
    Bxx += along * nx * cx, Bxy += along * nx * cy, Byy += along * ny * cy;
    shear_x += g * cx, shear_y += g * cy;
  }

  const double* const own = families_.data() + block * lanes * family_numbers;
  const auto sum = [&](std::size_t n) { return loaded(own + n * lanes); };
  const double less = (1 - poisson_) / 2, more = (1 + poisson_) / 2;
  const Vector VD = sum(0), VS = sum(1), bending = sum(2), residual = sum(3);
  const Vector xx = sum(4), xy = sum(5), yy = sum(6), xxxx = sum(7), xxxy = sum(8), xxyy = sum(9), xyyy = sum(10),
               yyyy = sum(11);
  // moments less the sum of t (x) n, shear force less the sum of tau n
  const Vector twist = VD * less * (Hxy + Hyx);
  const Vector Mxx =
      VD * (Hxx + poisson_ * Hyy) -
      bending * (less * (Axx - Hxx * xx - Hxy * xy) + more * (Bxx - Hxx * xxxx - (Hxy + Hyx) * xxxy - Hyy * xxyy));
  const Vector cross = more * (Bxy - Hxx * xxxy - (Hxy + Hyx) * xxyy - Hyy * xyyy);
  const Vector Mxy = twist - bending * (less * (Axy - Hxx * xy - Hxy * yy) + cross);
  const Vector Myx = twist - bending * (less * (Ayx - Hyx * xx - Hyy * xy) + cross);
  const Vector Myy =
      VD * (Hyy + poisson_ * Hxx) -
      bending * (less * (Ayy - Hyx * xy - Hyy * yy) + more * (Byy - Hxx * xxyy - (Hxy + Hyx) * xyyy - Hyy * yyyy));
  const Vector Qx = VS * gamma_x - residual * (shear_x - xx * gamma_x - xy * gamma_y);
  const Vector Qy = VS * gamma_y - residual * (shear_y - xy * gamma_x - yy * gamma_y);

  // gradients of the energy: phi on w of the member, m on its psi; the owner takes the opposite, and both the lever
  Vector sum_w = 0, sum_x = 0, sum_y = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const Vector nx = number(b, 0), ny = number(b, 1), inverse = number(b, 2), Gx = number(b, 3), Gy = number(b, 4),
                 c = number(b, 5);
    const Vector rx = turn_x[b] - Hxx * nx - Hxy * ny, ry = turn_y[b] - Hyx * nx - Hyy * ny;
    const Vector along = more * (rx * nx + ry * ny), weight = c * bending;
    const Vector tau = c * residual * (shear[b] - nx * gamma_x - ny * gamma_y);
    const Vector phi = (Qx * Gx + Qy * Gy + tau) * inverse;
    const Vector mx = (Mxx * Gx + Mxy * Gy + weight * (less * rx + along * nx)) * inverse;
    const Vector my = (Myx * Gx + Myy * Gy + weight * (less * ry + along * ny)) * inverse;
    const Vector lever = 0.5 * (Qx * Gx + Qy * Gy + tau);  // phi length / 2
    double* const to = given_.data() + 3 * lanes * (first + b);
    // force -phi; couples -(psi_y), +(psi_x)
    store(-phi, to), store(lever * ny - my, to + lanes), store(mx - lever * nx, to + 2 * lanes);
    sum_w += phi, sum_x += mx + lever * nx, sum_y += my + lever * ny;
  }
  double* const to = given_.data() + 3 * lanes * (members_.size() / lanes + block);
  store(sum_w, to), store(sum_y, to + lanes), store(-sum_x, to + 2 * lanes);
}

void GalerkinLists::internal_force(const State& state, Forces& forces) const {
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::size_t block = 0; block < blocks_.size(); ++block) act(block, state);
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Eigen::Vector3d sum(0, 0, 0);
      for (auto s = first_slot_[i]; s < first_slot_[i + 1]; ++s) {
        const double* const given = given_.data() + slots_[s];
        sum += Eigen::Vector3d(given[0], given[lanes], given[2 * lanes]);
      }
      forces.col(points_[i]) = sum;
    }
  }
}

std::size_t GalerkinLists::bytes() const {
  return sizeof(std::uint32_t) *
             (kept_.size() + kept_lanes_.size() + members_.size() + points_.size() + slots_.size()) +
         sizeof(double) * (bonds_.size() + families_.size() + given_.size()) + sizeof(Block) * blocks_.size() +
         sizeof(std::size_t) * first_slot_.size();
}

}  // namespace plate
