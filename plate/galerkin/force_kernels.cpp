#include "plate/galerkin/force_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plate/galerkin/stiffness.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/lanes.hpp"

namespace plate {
namespace {

constexpr int reach = 2, width = 5;
constexpr auto shortest_row = std::size_t(Lane<double>::size());
constexpr std::size_t longest_row = 256;  // pieces of work for threads

/// Neighbours of a point in the 25 places about it; nothing where one is missing or has another kind of family within
/// its own.
std::optional<std::array<std::int32_t, 5>> steps_about(const GalerkinFamilies& f, std::uint32_t k, double spacing) {
  if (f.kind[k] != 0) return std::nullopt;
  std::array<std::int32_t, 5> steps{};
  for (const auto [j, vector] : f.families[k]) {
    if (f.kind[j] != 0) return std::nullopt;
    const auto& x = f.families.vectors()[vector];
    const auto column = std::lround(x.x() / spacing), row = std::lround(x.y() / spacing);
    const auto step = std::int32_t(j - k);
    if (column == 0) steps[std::size_t(row + reach)] = step;
    if (column != 0 && row == 0 && step != column) return std::nullopt;
  }
  // the rows two away, from the points above and below, and every place by the step that its row has
  for (const int sign : {-1, 1}) {
    const auto middle = std::uint32_t(std::int64_t(k) + steps[std::size_t(reach + sign)]);
    for (const auto [j, vector] : f.families[middle]) {
      const auto& x = f.families.vectors()[vector];
      if (std::lround(x.x() / spacing) == 0 && std::lround(x.y() / spacing) == sign)
        steps[std::size_t(reach + 2 * sign)] = std::int32_t(j - k);
    }
  }
  for (const auto& bond : f.families[k])
    for (const auto& [other, next] : f.families[bond.neighbour]) {
      const geometry::Point x = f.families.vectors()[bond.vector_id] + f.families.vectors()[next];
      const auto column = std::lround(x.x() / spacing), row = std::lround(x.y() / spacing);
      if (std::int32_t(other - k) != steps[std::size_t(row + reach)] + column) return std::nullopt;
    }
  return steps;
}

}  // namespace

GalerkinRows::GalerkinRows(const GalerkinFamilies& families, const PointSections& sections,
                           const std::vector<std::uint32_t>& column_block, const std::vector<char>& pending) {
  const auto points = std::uint32_t(families.areas.size());
  const auto lattice = lattice_family(families);
  const double spacing = lattice ? std::sqrt(lattice->families->areas[lattice->point]) : 0;
  std::vector<std::optional<std::array<std::int32_t, 5>>> steps(points);
#pragma omp parallel for schedule(static)
  for (std::uint32_t k = 0; k < points; ++k) steps[k] = steps_about(families, k, spacing);
  const auto asked = [&](std::uint32_t k) { return column_block.empty() || column_block[k] > 0; };
  const auto goes_on = [&](std::uint32_t k, std::uint32_t end) {
    return steps[k] && steps[end] == steps[k] && (column_block.empty() || column_block[end] == column_block[k]);
  };
  for (std::uint32_t k = 0; k < points;) {
    std::uint32_t end = k + 1;
    if (!asked(k)) {
      k = end;
      continue;
    }
    while (end < points && end - k < longest_row && goes_on(k, end)) ++end;
    if (steps[k] && end - k >= shortest_row)
      rows_.push_back({k, end - k, *steps[k]});
    else
      for (auto i = k; i < end; ++i) others_.push_back(i);
    k = end;
  }
  const auto inside = [&](const Row& row) {
    return std::ranges::all_of(row.step, [&](std::int32_t step) {
      const auto from = pending.begin() + row.first + step - reach;
      return std::none_of(from, from + row.length + 2 * reach, [](char one) { return one; });
    });
  };
  const auto waiting =
      pending.empty() ? std::ranges::subrange(rows_.end(), rows_.end()) : std::ranges::stable_partition(rows_, inside);
  inside_ = std::size_t(waiting.begin() - rows_.begin());
  if (lattice) find_factors(*lattice, sections, spacing);
}

/// The force on a member of a family by all its members, at their places relative to it.
void GalerkinRows::find_factors(const LatticeFamily& lattice, const PointSections& sections, double spacing) {
  const auto& families = lattice.families->families;
  const Eigen::MatrixXd K = family_stiffness(*lattice.families, sections, lattice.point);
  std::vector<geometry::Point> place{{0, 0}};
  for (const auto& bond : families[lattice.point]) place.push_back(families.vectors()[bond.vector_id] / spacing);
  for (std::size_t a = 0; a < place.size(); ++a)
    for (std::size_t b = 0; b < place.size(); ++b) {
      const auto at =
          std::lround((place[b] - place[a]).y() + reach) * width + std::lround((place[b] - place[a]).x() + reach);
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 3; ++d)
          factors_[std::size_t(at) * 9 + 3 * c + d] -= K(Eigen::Index(3 * a + c), Eigen::Index(3 * b + d));
    }
}

template <typename Apply>
void GalerkinRows::apply(std::size_t begin, std::size_t end, const Apply& apply) const {
#pragma omp parallel for schedule(static)
  for (std::size_t i = begin; i < end; ++i)
    along<double>(std::ptrdiff_t(rows_[i].first), std::ptrdiff_t(rows_[i].length),
                  [&](const auto& points) { apply(rows_[i], points); });
}

void GalerkinRows::product(const Factors& factors, std::size_t begin, std::size_t end, const State& state,
                           Forces& forces) const {
  const double* const u[] = {state.row(0).data(), state.row(1).data(), state.row(2).data()};
  apply(begin, end, [&](const Row& row, const auto& points) {
    using Vector = typename std::remove_cvref_t<decltype(points)>::Vector;
    Vector sum[3] = {Vector::constant(0), Vector::constant(0), Vector::constant(0)};
    const double* factor = factors.data();
    for (const auto middle : row.step)
      for (int column = -reach; column <= reach; ++column, factor += 9)
        for (int d = 0; d < 3; ++d) {
          const auto value = points.load(u[d], middle + column);
          for (int c = 0; c < 3; ++c) sum[c] += factor[3 * c + d] * value;
        }
    for (int c = 0; c < 3; ++c) points.store(sum[c], forces.row(c).data());
  });
}

void GalerkinRows::internal_force(const State& state, Forces& forces) const {
  product(factors_, 0, rows_.size(), state, forces);
}

void GalerkinRows::internal_force_inside(const State& state, Forces& forces) const {
  product(factors_, 0, inside_, state, forces);
}

void GalerkinRows::internal_force_waiting(const State& state, Forces& forces) const {
  product(factors_, inside_, rows_.size(), state, forces);
}

void GalerkinRows::absolute_product(const State& state, Forces& forces) const {
  Factors absolute;
  for (std::size_t i = 0; i < factors_.size(); ++i) absolute[i] = std::abs(factors_[i]);
  product(absolute, 0, rows_.size(), state, forces);
}

void GalerkinRows::diagonal(Forces& diagonal) const {
  constexpr std::size_t middle = 12 * 9;
  for (const auto& row : rows_)
    for (auto k = row.first; k < row.first + row.length; ++k)
      for (std::size_t c = 0; c < 3; ++c) diagonal(Eigen::Index(c), k) = -factors_[middle + 4 * c];
}

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

/// A bond of every lane.
struct BondLanes {
  Vector x, y, inverse, Gx, Gy, share;

  BondLanes(const double* bonds, std::size_t b)
      : x(number(bonds, b, 0)),
        y(number(bonds, b, 1)),
        inverse(number(bonds, b, 2)),
        Gx(number(bonds, b, 3)),
        Gy(number(bonds, b, 4)),
        share(number(bonds, b, 5)) {}

private:
  static Vector number(const double* bonds, std::size_t b, std::size_t n) {
    return loaded(bonds + (b * bond_numbers + n) * lanes);
  }
};

/// Strains of the families of all lanes, and sums over their bonds that the residuals need.
struct Strains {
  Vector turn_x[most_bonds], turn_y[most_bonds], shear[most_bonds];  // (psi_i - psi_k) / length, bond shear angle
  Vector Hxx = 0, Hxy = 0, Hyx = 0, Hyy = 0, gamma_x = 0, gamma_y = 0;
  // sums of share (turn (x) n), of share (turn . n) n (x) n and of share shear n
  Vector Axx = 0, Axy = 0, Ayx = 0, Ayy = 0, Bxx = 0, Bxy = 0, Byy = 0, shear_x = 0, shear_y = 0;

  Strains(const State& state, const std::uint32_t* owners, const std::uint32_t* members, const double* bonds,
          std::size_t count) {
    const double* const w = state.row(0).data();
    const double* const theta_x = state.row(1).data();
    const double* const theta_y = state.row(2).data();
    const Vector own_w = gather(w, owners), own_x = -gather(theta_y, owners), own_y = gather(theta_x, owners);
    for (std::size_t b = 0; b < count; ++b, members += lanes) {
      const BondLanes n(bonds, b);
      const Vector x = -gather(theta_y, members), y = gather(theta_x, members);
      const Vector ux = (x - own_x) * n.inverse, uy = (y - own_y) * n.inverse;
      const Vector g = (gather(w, members) - own_w) * n.inverse - 0.5 * (n.x * (x + own_x) + n.y * (y + own_y));
      turn_x[b] = ux, turn_y[b] = uy, shear[b] = g;
      Hxx += ux * n.Gx, Hxy += ux * n.Gy, Hyx += uy * n.Gx, Hyy += uy * n.Gy;
      gamma_x += g * n.Gx, gamma_y += g * n.Gy;
      const Vector cx = n.share * n.x, cy = n.share * n.y, along = ux * n.x + uy * n.y;
      Axx += ux * cx, Axy += ux * cy, Ayx += uy * cx, Ayy += uy * cy;
      Bxx += along * n.x * cx, Bxy += along * n.x * cy, Byy += along * n.y * cy;
      shear_x += g * cx, shear_y += g * cy;
    }
  }
};

/// Moments times area less the sum of t (x) n, shear force times area less the sum of tau n.
struct CellResultants {
  Vector Mxx, Mxy, Myx, Myy, Qx, Qy;

  CellResultants(const Strains& e, const double* own, double nu) {
    const auto sum = [&](std::size_t n) { return loaded(own + n * lanes); };
    const double less = (1 - nu) / 2, more = (1 + nu) / 2;
    const Vector VD = sum(0), VS = sum(1), bending = sum(2), residual = sum(3);
    const Vector xx = sum(4), xy = sum(5), yy = sum(6), xxxx = sum(7), xxxy = sum(8), xxyy = sum(9), xyyy = sum(10),
                 yyyy = sum(11);
    const Vector both = e.Hxy + e.Hyx, twist = VD * less * both;
    const Vector along_xx = more * (e.Bxx - e.Hxx * xxxx - both * xxxy - e.Hyy * xxyy);
    const Vector along_xy = more * (e.Bxy - e.Hxx * xxxy - both * xxyy - e.Hyy * xyyy);
    const Vector along_yy = more * (e.Byy - e.Hxx * xxyy - both * xyyy - e.Hyy * yyyy);
    Mxx = VD * (e.Hxx + nu * e.Hyy) - bending * (less * (e.Axx - e.Hxx * xx - e.Hxy * xy) + along_xx);
    Mxy = twist - bending * (less * (e.Axy - e.Hxx * xy - e.Hxy * yy) + along_xy);
    Myx = twist - bending * (less * (e.Ayx - e.Hyx * xx - e.Hyy * xy) + along_xy);
    Myy = VD * (e.Hyy + nu * e.Hxx) - bending * (less * (e.Ayy - e.Hyx * xy - e.Hyy * yy) + along_yy);
    Qx = VS * e.gamma_x - residual * (e.shear_x - xx * e.gamma_x - xy * e.gamma_y);
    Qy = VS * e.gamma_y - residual * (e.shear_y - xy * e.gamma_x - yy * e.gamma_y);
  }
};

}  // namespace

GalerkinLists::GalerkinLists(const GalerkinFamilies& families, const PointSections& sections,
                             const std::vector<std::uint32_t>& points, const std::vector<char>& pending)
    : points_(points), poisson_(sections[0].bending(0, 1) / sections[0].bending(0, 0)) {
  std::vector<char> acts(families.areas.size(), 0);
  for (const auto i : points) {
    acts[i] = 1;
    for (const auto& bond : families.families[i]) acts[bond.neighbour] = 1;
  }
  for (std::uint32_t k = 0; k < acts.size(); ++k)
    if (acts[k]) kept_.push_back(k);
  const auto waits = [&](std::uint32_t k) { return !pending.empty() && pending[k]; };
  const auto waiting = std::ranges::stable_partition(kept_, [&](std::uint32_t k) {
    bool goes_ahead = !waits(k);
    for (const auto& bond : families.families[k]) goes_ahead = goes_ahead && !waits(bond.neighbour);
    return goes_ahead;
  });
  const auto inside = waiting.begin() - kept_.begin();
  inside_ = waiting.empty() ? (kept_.size() + lanes - 1) / lanes : std::size_t(inside) / lanes;
  // by size within pieces that stay in the cache
  constexpr std::ptrdiff_t piece = 2048;
  const auto sort = [&](std::ptrdiff_t first, std::ptrdiff_t last) {
    for (auto begin = first; begin < last; begin += piece)
      std::stable_sort(kept_.begin() + begin, kept_.begin() + std::min(last, begin + piece),
                       [&](auto a, auto b) { return families.families[a].size() < families.families[b].size(); });
  };
  sort(0, inside), sort(inside, std::ptrdiff_t(kept_.size()));
  for (std::size_t first = 0; first < kept_.size(); first += lanes) add_block(families, sections, first);
  find_slots(families, points);
  given_.assign(3 * lanes * (members_.size() / lanes + blocks_.size()), 0);
}

/// Families kept_[first] and those after it; lanes that are left over repeat the last one.
void GalerkinLists::add_block(const GalerkinFamilies& families, const PointSections& sections, std::size_t first) {
  const auto of_lane = [&](std::size_t lane) { return kept_[std::min(first + lane, kept_.size() - 1)]; };
  std::size_t most = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) most = std::max(most, families.families[of_lane(lane)].size());
  if (most > most_bonds) throw Refused({{Subject::geometry, 0, "a point has more than 32 neighbours"}});
  blocks_.push_back({members_.size() / lanes, std::uint32_t(most)});
  members_.resize(members_.size() + most * lanes);
  bonds_.resize(bonds_.size() + most * lanes * bond_numbers, 0);
  families_.resize(families_.size() + lanes * family_numbers, 0);
  double* const own = families_.data() + (blocks_.size() - 1) * lanes * family_numbers;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto k = of_lane(lane);
    kept_lanes_.push_back(k);
    const auto family = families.families[k];
    const GalerkinStiffness s(sections[k], families.square(k));
    const double D = s.bending(0, 0), V = families.areas[k];
    std::array<double, family_numbers> sums{V * D, V * s.shear(0, 0), s.bending_residual * D, s.shear_residual(0, 0)};
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

/// Adds the forces of one block of families: strains, then what each bond leaves at its member and at its owner:
/// gradients of the energy, phi on w of the member, m on its psi; the owner takes the opposite, and both the lever of
/// phi.
void GalerkinLists::act(std::size_t block, const State& state) const {
  const auto [first, count] = blocks_[block];
  const double* const bonds = bonds_.data() + first * bond_numbers * lanes;
  const double* const own = families_.data() + block * lanes * family_numbers;
  const Strains e(state, kept_lanes_.data() + block * lanes, members_.data() + first * lanes, bonds, count);
  const CellResultants r(e, own, poisson_);
  const Vector bending = loaded(own + 2 * lanes), residual = loaded(own + 3 * lanes);
  const double less = (1 - poisson_) / 2, more = (1 + poisson_) / 2;
  Vector sum_w = 0, sum_x = 0, sum_y = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const BondLanes n(bonds, b);
    const Vector rx = e.turn_x[b] - e.Hxx * n.x - e.Hxy * n.y, ry = e.turn_y[b] - e.Hyx * n.x - e.Hyy * n.y;
    const Vector along = more * (rx * n.x + ry * n.y), weight = n.share * bending;
    const Vector tau = n.share * residual * (e.shear[b] - n.x * e.gamma_x - n.y * e.gamma_y);
    const Vector phi_length = r.Qx * n.Gx + r.Qy * n.Gy + tau;
    const Vector mx = (r.Mxx * n.Gx + r.Mxy * n.Gy + weight * (less * rx + along * n.x)) * n.inverse;
    const Vector my = (r.Myx * n.Gx + r.Myy * n.Gy + weight * (less * ry + along * n.y)) * n.inverse;
    const Vector phi = phi_length * n.inverse, lever = 0.5 * phi_length;
    double* const to = given_.data() + 3 * lanes * (first + b);
    // force on w; couples on theta_x = psi_y and theta_y = -psi_x
    store(-phi, to), store(lever * n.y - my, to + lanes), store(mx - lever * n.x, to + 2 * lanes);
    sum_w += phi, sum_x += mx + lever * n.x, sum_y += my + lever * n.y;
  }
  double* const to = given_.data() + 3 * lanes * (members_.size() / lanes + block);
  store(sum_w, to), store(sum_y, to + lanes), store(-sum_x, to + 2 * lanes);
}

void GalerkinLists::begin_force(const State& state) const {
#pragma omp parallel for schedule(static)
  for (std::size_t block = 0; block < inside_; ++block) act(block, state);
}

/// Blocks from one on, and the forces that all have left.
void GalerkinLists::internal_force_from(std::size_t first, const State& state, Forces& forces) const {
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::size_t block = first; block < blocks_.size(); ++block) act(block, state);
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
