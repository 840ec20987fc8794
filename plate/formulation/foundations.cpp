#include "plate/formulation/foundations.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/cells/tessellation.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/model/space.hpp"
#include "plate/model/supports.hpp"

namespace plate {
namespace {

constexpr std::size_t many = 2000;

}  // namespace

Contact::Contact(const std::vector<Place>& places) {
  struct Entry {
    std::uint32_t row, place;
    double factor;
  };
  std::vector<Entry> entries;
  first_.push_back(0);
  for (const auto& [stiffness, form] : places) {
    for (const auto& [dof, factor] : form)
      if (factor != 0)
        terms_.emplace_back(dof, factor), entries.push_back({dof, std::uint32_t(stiffness_.size()), factor});
    stiffness_.push_back(stiffness);
    first_.push_back(terms_.size());
  }
  std::ranges::stable_sort(entries, {}, &Entry::row);
  for (const auto& [row, place, factor] : entries) {
    if (row_.empty() || row_.back() != row) row_.push_back(row), first_of_row_.push_back(of_row_.size());
    of_row_.emplace_back(place, factor);
  }
  first_of_row_.push_back(of_row_.size());
}

Contact::Place Contact::place(std::size_t number) const {
  return {stiffness_[number],
          {terms_.begin() + std::ptrdiff_t(first_[number]), terms_.begin() + std::ptrdiff_t(first_[number + 1])}};
}

template <typename Real, typename Acts>
std::vector<double> Contact::pressures(const Values<Real>& state, const Acts& acts) const {
  std::vector<double> result(places());
  const Real* const u = state.data();
#pragma omp parallel for schedule(static) if (places() > many)
  for (std::size_t p = 0; p < stiffness_.size(); ++p) {
    double w = 0;
    for (auto i = first_[p]; i < first_[p + 1]; ++i) w += terms_[i].second * double(u[terms_[i].first]);
    result[p] = acts(p, w) ? stiffness_[p] * w : 0;
  }
  return result;
}

template <typename Real>
void Contact::add(double factor, const std::vector<double>& pressures, Values<Real>& forces) const {
  Real* const f = forces.data();
#pragma omp parallel for schedule(static) if (row_.size() > many)
  for (std::size_t r = 0; r < row_.size(); ++r) {
    double sum = 0;
    for (auto i = first_of_row_[r]; i < first_of_row_[r + 1]; ++i)
      sum += of_row_[i].second * pressures[of_row_[i].first];
    f[row_[r]] += Real(factor * sum);
  }
}

namespace {

constexpr auto below = [](std::size_t, double w) { return w < 0; };

}  // namespace

std::vector<char> Contact::touching(const State& state) const {
  const auto pressed = pressures(state, below);
  std::vector<char> result(places());
  for (std::size_t p = 0; p < result.size(); ++p) result[p] = pressed[p] < 0;
  return result;
}

template <typename Real>
void Contact::add_force(double factor, const Values<Real>& state, Values<Real>& forces) const {
  add(-factor, pressures(state, below), forces);
}

template void Contact::add_force(double, const Values<double>&, Values<double>&) const;
template void Contact::add_force(double, const Values<float>&, Values<float>&) const;

void Contact::add_force(double factor, const State& state, const std::vector<char>& touching, Forces& forces) const {
  add(-factor, pressures(state, [&](std::size_t p, double) { return touching[p] != 0; }), forces);
}

double Contact::energy(const State& state) const {
  const auto pressed = pressures(state, below);
  double sum = 0;
  for (std::size_t p = 0; p < pressed.size(); ++p)
    if (pressed[p] < 0) sum += pressed[p] * pressed[p] / stiffness_[p] / 2;
  return sum;
}

std::size_t Contact::bytes() const {
  return stiffness_.size() * (sizeof(double) + sizeof(std::size_t)) +
         row_.size() * (sizeof(row_[0]) + sizeof(std::size_t)) + (terms_.size() + of_row_.size()) * sizeof(terms_[0]);
}

namespace {

using geometry::Point;
using CellRing = std::vector<Point>;
using Shape = std::optional<geometry::Patch>;

Shape patch_of(const Foundation& foundation) {
  return foundation.patch ? Shape(*foundation.patch) : std::nullopt;
}

/// Integrals of 1, x and x x^T over what the foundation has of a cell. A sliver that rounding leaves along a boundary
/// is nothing: it would seem to hold a piece.
geometry::AreaMoments moments_of(const Shape& patch, const CellRing& cell, const Point& about) {
  constexpr double sliver = 1e-9;
  if (!patch) return geometry::moments(cell, about);
  const CellRing piece = patch->common(cell);
  if (piece.empty()) return {};
  const auto found = geometry::moments(piece, about);
  return found.area > sliver * geometry::moments(cell, about).area ? found : geometry::AreaMoments{};
}

/// Gram matrix of (1, x, y): the integral of (1, x, y) (1, x, y)^T, from area moments.
Eigen::Matrix3d gram(const geometry::AreaMoments& m) {
  Eigen::Matrix3d result;
  result << m.area, m.first.transpose(), m.first, m.second;
  return result;
}

/// Places and areas of a rule that is exact for squares: middles of the sides of the triangles about the middle.
template <typename Visit>
void for_each_place(const Shape& patch, const CellRing& cell, const Visit& visit) {
  const CellRing piece = patch ? patch->common(cell) : cell;
  if (piece.empty()) return;
  Point middle(0, 0);
  for (const Point& x : piece) middle += x / double(piece.size());
  const auto area = [&](std::size_t i) {
    const Point a = piece[i] - middle, b = piece[(i + 1) % piece.size()] - middle;
    return (a.x() * b.y() - a.y() * b.x()) / 2;
  };
  for (std::size_t i = 0; i < piece.size(); ++i)
    if (area(i) < 0) {  // seen as a whole from nowhere: beside an inner corner of the part
      const auto whole = geometry::moments(piece, middle);
      return visit(middle + whole.first / whole.area, whole.area);
    }
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const auto before = (i + piece.size() - 1) % piece.size();
    const double outside = area(i), inside = area(i) + area(before);
    if (outside > 0) visit(Point((piece[i] + piece[(i + 1) % piece.size()]) / 2), outside / 3);
    if (inside > 0) visit(Point((piece[i] + middle) / 2), inside / 3);  // of both triangles beside it
  }
}

/// The function x y of a cell with four corners, scaled to 1 and -1 in turn at these: the only one of their values that
/// the linear function of the cell does not see.
class Hourglass {
public:
  explicit Hourglass(const CellRing& ring) : middle_((ring[0] + ring[1] + ring[2] + ring[3]) / 4) {
    Eigen::Matrix2d sides;
    sides << (ring[1] - ring[0]) / 2, (ring[3] - ring[0]) / 2;
    inverse_ = sides.inverse();
    slopes_ = (inverse_ * inverse_.transpose()).trace() / 3;
  }

  double at(const Point& x) const { return (inverse_ * (x - middle_)).prod(); }
  /// Mean over a whole cell of the square of its slope.
  double square_of_slope() const { return slopes_; }

private:
  Point middle_;
  Eigen::Matrix2d inverse_;
  double slopes_;
};

template <std::size_t N>
void add_cell(const Foundation& foundation, const Shape& patch, const std::array<std::uint32_t, N>& cell,
              const std::vector<Point>& positions, ElasticSupportSum& sum) {
  CellRing ring;
  Point middle(0, 0);
  for (const auto k : cell) ring.push_back(positions[k]), middle += positions[k] / double(N);
  const auto moments = moments_of(patch, ring, middle);
  if (!(moments.area > 0)) return;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Point& x : ring) spread += (x - middle) * (x - middle).transpose();
  const Eigen::Matrix2d inverse = spread.inverse();
  Eigen::Matrix<double, N, 3> linear;  // value in the middle and slopes, of every corner
  std::vector<Dof> dofs;
  for (std::size_t i = 0; i < N; ++i) {
    linear.row(Eigen::Index(i)) << 1 / double(N), (inverse * (ring[i] - middle)).transpose();
    dofs.push_back(dof(cell[i], 0));
  }
  using Values = Eigen::Matrix<double, N, 1>;
  const auto linear_at = [&](const Point& x) -> Values {
    return linear.col(0) + linear.template rightCols<2>() * (x - middle);
  };
  std::optional<Hourglass> hourglass;
  Values beside = Values::Zero();
  if constexpr (N == 4)  // of whole cells: in a part it is not orthogonal to the linear function
    if (moments.area > (1 - 1e-9) * geometry::moments(ring, middle).area)
      hourglass.emplace(ring), beside << 0.25, -0.25, 0.25, -0.25;
  const auto hourglass_at = [&](const Point& x) -> Values { return (hourglass ? hourglass->at(x) : 0) * beside; };
  if (foundation.unilateral) {
    for_each_place(patch, ring, [&](const Point& x, double area) {
      const Values values = linear_at(x) + hourglass_at(x);
      std::vector<FormTerm> form;
      for (std::size_t i = 0; i < N; ++i) form.push_back({dofs[i], values[Eigen::Index(i)]});
      sum.add_unilateral(foundation.modulus * area, form);
    });
    return;
  }
  const auto slopes = linear.template rightCols<2>();
  Eigen::MatrixXd K = foundation.modulus * linear * gram(moments) * linear.transpose() +
                      foundation.shear * moments.area * slopes * slopes.transpose();
  if (hourglass) {  // by the places of a unilateral foundation: pressed everywhere it is this one
    for_each_place(patch, ring, [&](const Point& x, double area) {
      const Values line = linear_at(x), more = hourglass_at(x);
      K += foundation.modulus * area * ((line + more) * (line + more).transpose() - line * line.transpose());
    });
    K += foundation.shear * hourglass->square_of_slope() * moments.area * beside * beside.transpose();
  }
  sum.add(dofs, (K + K.transpose()) / 2);
}

constexpr double share_of_jump = 1.0 / 64;

using Corner = std::pair<double, double>;

Corner corner_at(const Point& x) {
  return {x.x(), x.y()};
}

/// The soil goes on beneath a crack: between its faces it is sheared over a share of what parts the points of a face
/// (theory (73)). Over all of it the faces part by the first order of that.
void add_below_cracks(const Foundation& foundation, const geometry::Tessellation& cells, ElasticSupportSum& sum) {
  geometry::Outline outline;
  if (const auto patch = patch_of(foundation))
    outline.outer = {patch->ring(), std::vector<std::string>(patch->ring().size())};
  const auto covered = [&](const Point& x) { return !foundation.patch || geometry::contains(outline, x); };
  std::map<std::pair<Corner, Corner>, const geometry::Tessellation::Border*> faces;
  for (const auto& border : cells.borders) {
    if (border.edge != geometry::Curves::crack) continue;
    const Point &from = cells.positions[border.from], &to = cells.positions[border.to];
    const auto twin = faces.find({corner_at(to), corner_at(from)});
    faces[{corner_at(from), corner_at(to)}] = &border;
    if (twin == faces.end() || !covered((from + to) / 2)) continue;
    const double stiffness = foundation.shear / share_of_jump / 2;
    for (const auto& [k, j] : {std::pair{border.from, twin->second->to}, {border.to, twin->second->from}})
      if (k != j) sum.add(stiffness, {{dof(k, 0), 1}, {dof(j, 0), -1}});
  }
}

/// Points of the plate by the columns and rows of their cells.
class Cells {
public:
  explicit Cells(const geometry::Cloud& cloud) : cloud_(cloud) {
    for (std::uint32_t k = 0; k < cloud.plate_points; ++k) point_[cell(k)] = k;
  }
  /// The neighbour `step` columns and rows away.
  std::optional<std::uint32_t> beside(std::uint32_t k, int columns, int rows) const {
    const auto [column, row] = cell(k);
    const auto found = point_.find({column + columns, row + rows});
    return found == point_.end() ? std::nullopt : std::optional(found->second);
  }

private:
  std::pair<int, int> cell(std::uint32_t k) const {
    const Point u = cloud_.units.to_lattice(cloud_.positions[k]);
    return {int(std::floor(u.x())), int(std::floor(u.y()))};
  }
  const geometry::Cloud& cloud_;
  std::map<std::pair<int, int>, std::uint32_t> point_;
};

/// Half of a cell has the slope to the neighbour on its side, and that of the other half where there is none.
void add_shear(double stiffness, const Cells& cells, std::uint32_t k, double spacing, ElasticSupportSum& sum) {
  for (const bool along_x : {true, false}) {
    const auto beside = [&](int step) { return cells.beside(k, along_x ? step : 0, along_x ? 0 : step); };
    const auto before = beside(-1), after = beside(1);
    const double share = before && after ? 0.5 : 1;
    for (const auto& j : {before, after})
      if (j) sum.add(share * stiffness / (spacing * spacing), {{dof(k, 0), -1}, {dof(*j, 0), 1}});
  }
}

}  // namespace

void add_foundation(const Foundation& foundation, const geometry::Cloud& cloud, ElasticSupportSum& sum) {
  const auto patch = patch_of(foundation);
  const double side = cloud.units.spacing, half = side / 2;
  const auto cells = foundation.shear > 0 ? std::optional<Cells>(cloud) : std::nullopt;
  Eigen::Matrix3d linear;  // deflection and slopes of w, theta_x, theta_y: psi = (-theta_y, theta_x)
  linear << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  for (std::uint32_t k = 0; k < cloud.plate_points; ++k) {
    const Point& x = cloud.positions[k];
    const CellRing cell{x + Point(-half, -half), x + Point(half, -half), x + Point(half, half), x + Point(-half, half)};
    const auto moments = moments_of(patch, cell, x);
    if (!(moments.area > 0)) continue;
    const double share = cloud.areas[k] / (side * side);
    if (foundation.unilateral) {  // w + (x - x_k) . psi
      for_each_place(patch, cell, [&](const Point& at, double area) {
        sum.add_unilateral(share * foundation.modulus * area,
                           {{dof(k, 0), 1}, {dof(k, 1), (at - x).y()}, {dof(k, 2), -(at - x).x()}});
      });
      continue;
    }
    const Eigen::Matrix3d K = share * foundation.modulus * linear * gram(moments) * linear.transpose();
    sum.add({dof(k, 0), dof(k, 1), dof(k, 2)}, (K + K.transpose()) / 2);
    if (cells) add_shear(share * moments.area * foundation.shear, *cells, k, side, sum);
  }
}

void add_foundation(const Foundation& foundation, const geometry::Tessellation& cells, ElasticSupportSum& sum) {
  const auto patch = patch_of(foundation);
  for (const auto& square : cells.squares) add_cell(foundation, patch, square, cells.positions, sum);
  for (const auto& triangle : cells.triangles) add_cell(foundation, patch, triangle, cells.positions, sum);
  if (foundation.shear > 0) add_below_cracks(foundation, cells, sum);
}

}  // namespace plate
