#include "plate/model/load_integration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/cells/tessellation.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"

namespace plate {

using geometry::Point;

struct Cubature::Triangle {
  Point a, b, c;
  double area() const { return ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2; }
};

Integral& Integral::operator+=(const Integral& other) {
  value += other.value, first += other.first, size += other.size, error += other.error;
  return *this;
}

/// Integrates by the middles of the sides: exact to the second order.
Integral Cubature::rule(const Triangle& triangle, const Point& about) {
  Integral result;
  const auto& [a, b, c] = triangle;
  for (const Point& x : {Point((a + b) / 2), Point((b + c) / 2), Point((c + a) / 2)}) {
    const double f = f_(x), share = f * triangle.area() / 3;
    largest_ = std::max(largest_, std::abs(f));
    result.value += share, result.first += share * (x - about), result.size += std::abs(share);
  }
  return result;
}

Integral Cubature::refined(const Triangle& triangle, const Integral& coarse, const Point& about, int depth) {
  constexpr double tolerance = 1e-4;
  constexpr int deepest = 5;
  const auto& [a, b, c] = triangle;
  const Point ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
  const std::array<Triangle, 4> parts{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
  std::array<Integral, 4> fine;
  Integral result;
  for (std::size_t i = 0; i < 4; ++i) result += fine[i] = rule(parts[i], about);
  const double change = std::abs(result.value - coarse.value);
  if (change <= tolerance * largest_ * std::abs(triangle.area())) return result;
  if (depth == deepest) {
    result.error = change;
    return result;
  }
  result = {};
  for (std::size_t i = 0; i < 4; ++i) result += refined(parts[i], fine[i], about, depth + 1);
  return result;
}

Integral Cubature::operator()(const std::vector<Point>& ring, const Point& about) {
  Point middle(0, 0);
  for (const Point& x : ring) middle += x / double(ring.size());
  largest_ = 0;
  std::vector<std::pair<Triangle, Integral>> parts;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Triangle triangle{middle, ring[i], ring[(i + 1) % ring.size()]};
    parts.emplace_back(triangle, rule(triangle, about));
  }
  Integral result;
  for (const auto& [triangle, coarse] : parts) result += refined(triangle, coarse, about, 0);
  return result;
}

namespace {

std::vector<EdgePiece> pieces_of(const geometry::Edge& edge, double spacing) {
  const Point along = edge.to - edge.from;
  const auto count = static_cast<int>(std::ceil(8 * along.norm() / spacing - 1e-6));
  const Point step = along / count;
  std::vector<EdgePiece> pieces;
  for (int i = 0; i < count; ++i) pieces.push_back({edge.from + (i + 0.5) * step, {step.y(), -step.x()}});
  return pieces;
}

std::vector<EdgePiece> pieces_of(const geometry::Circle& hole, double spacing) {
  const auto count = static_cast<int>(std::ceil(16 * std::numbers::pi * hole.radius / spacing));
  const double angle = 2 * std::numbers::pi / count;
  std::vector<EdgePiece> pieces;
  for (int i = 0; i < count; ++i) {
    const Point radial(std::cos((i + 0.5) * angle), std::sin((i + 0.5) * angle));
    pieces.push_back({hole.centre + hole.radius * radial, -hole.radius * angle * radial});
  }
  return pieces;
}

}  // namespace

std::vector<EdgeBorder> edge_borders(const std::string& name, const geometry::Cloud& cloud,
                                     const geometry::Outline& outline, double reach) {
  const double spacing = cloud.units.spacing;
  std::vector<EdgeBorder> result;
  const auto near = [&](const auto& away) {
    std::vector<std::uint32_t> points;
    for (std::uint32_t k = 0; k < cloud.plate_points; ++k)
      if (away(cloud.positions[k]) < reach * spacing) points.push_back(k);
    return points;
  };
  for (const auto& edge : geometry::straight_edges(outline))
    if (edge.name == name)
      result.push_back({pieces_of(edge, spacing), near([&](const Point& x) {
                          return geometry::distance(geometry::Polyline{edge.from, edge.to}, x);
                        })});
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole); circle && circle->name == name)
      result.push_back({pieces_of(*circle, spacing),
                        near([&](const Point& x) { return std::abs((x - circle->centre).norm() - circle->radius); })});
  if (cloud.part) std::erase_if(result, [](const EdgeBorder& border) { return border.near.empty(); });  // elsewhere
  for (const auto& border : result)
    if (border.near.empty())
      throw std::invalid_argument("edge '" + name + "' has no point of the plate within two spacings");
  return result;
}

std::uint32_t nearest(const std::vector<std::uint32_t>& points, const geometry::Cloud& cloud, const Point& x) {
  std::uint32_t best = points.front();
  for (const auto k : points)
    if ((cloud.positions[k] - x).squaredNorm() < (cloud.positions[best] - x).squaredNorm()) best = k;
  return best;
}

namespace {

using Ring = std::vector<Point>;

/// Throws where a formula has no value: where it is not finite, and where only rounding makes a number of what has no
/// limit, so that what is next to it, a millionth of `size` away, is smaller by orders.
void require_value(const Formula& formula, const Point& x, double usual, double size) {
  constexpr double near = 1e-6, orders = 1e-3;
  const double value = std::abs(formula(x));
  if (!std::isfinite(value)) throw FormulaError(formula, x);
  if (!(usual < near * value)) return;
  const auto beside = [&](double dx, double dy) { return std::abs(formula(x + near * size * Point(dx, dy))); };
  const double most = std::max({beside(1, 0.7), beside(-1, 0.7), beside(1, -0.7), beside(-1, -0.7)});
  if (most < orders * value) throw FormulaError(formula, x);
}

/// Resultants of a pressure on pieces of the plate: its force, and the moment of it, int p (x - about) dA.
class Thrust {
public:
  Thrust(const Pressure& load, const PointMap& map)
      : load_(load),
        map_(map),
        patch_(load.patch ? std::optional<geometry::Patch>(*load.patch) : std::nullopt),
        cubature_([&](const Point& x) {
          const double value = load.at(x);
          if (!std::isfinite(value)) throw FormulaError(load.formula, x);
          return value;
        }) {
    if (patch_)
      for (const Point& x : patch_->ring()) low_ = low_.cwiseMin(x), high_ = high_.cwiseMax(x);
  }

  /// `counts`: towards what is known of all.
  Integral operator()(const Ring& cell, const Point& about, bool counts = true) {
    if (misses(cell)) return {};
    Ring piece = patch_ ? patch_->common(cell) : cell;
    if (load_.level) piece = below(piece, *load_.level);
    if (piece.empty()) return {};
    if (load_.evaluated()) {
      const auto found = load_.formula.given() ? of_formula(piece, about) : cubature_(piece, about);
      if (counts) all_ += found;
      return found;
    }
    const auto [area, first, second] = geometry::moments(piece, about);
    const Point gradient = load_.level ? Point(0, -load_.value) : load_.gradient;
    const double p = load_.level ? load_.value * (*load_.level - about.y()) : load_.at(about);
    return {p * area + gradient.dot(first), p * first + second * gradient};
  }

  /// Looks at some of so many cells first, all over the plate: a formula that is noise takes long at each of them.
  template <typename RingOf>
  void require_tame(std::size_t cells, const RingOf& ring_of) {
    constexpr std::size_t some = 64;
    constexpr double noise = 0.2;
    if (!load_.formula.given() || map_.distributed()) return;
    const std::size_t stride = std::max<std::size_t>(1, cells / some);
    Integral all;
    for (std::size_t k = stride / 2; k < cells; k += stride) {
      const Ring ring = ring_of(k);
      all += (*this)(ring, ring.front(), false);
    }
    if (all.error > noise * all.size) throw FormulaError(load_.formula, all.error / all.size);
  }

  /// Throws where a formula varies so much within pieces that its forces are not known.
  void require_known() const {
    constexpr double known = 0.01;
    if (!load_.formula.given()) return;
    const auto [error, size] =
        sum_of_items<2>(map_, 1, [&](std::size_t, const auto& add) { add(0, all_.error), add(1, all_.size); });
    if (error > known * size) throw FormulaError(load_.formula, error / size);
  }

private:
  /// True where the cell lies beside the patch, by their boxes.
  bool misses(const Ring& cell) const {
    if (!patch_) return false;
    Point low = cell.front(), high = low;
    for (const Point& x : cell) low = low.cwiseMin(x), high = high.cwiseMax(x);
    return (low.array() > high_.array()).any() || (high.array() < low_.array()).any();
  }

  /// Part of a ring that lies below a level of y.
  static Ring below(const Ring& ring, double level) {
    Ring result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (a.y() <= level) result.push_back(a);
      if ((a.y() < level) != (b.y() < level) && a.y() != level && b.y() != level)
        result.push_back(a + (level - a.y()) / (b.y() - a.y()) * (b - a));
    }
    return result.size() < 3 ? Ring{} : result;
  }

  Integral of_formula(const Ring& piece, const Point& about) {
    Point middle(0, 0);
    for (const Point& x : piece) middle += x / double(piece.size());
    const double size = (piece.front() - middle).norm();
    require_value(load_.formula, middle, std::abs(load_.formula(piece.front())), size);
    const double usual = std::abs(load_.formula(middle));
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Point &a = piece[i], &b = piece[(i + 1) % piece.size()];
      require_value(load_.formula, (a + b) / 2, usual, size);
      require_value(load_.formula, (a + middle) / 2, usual, size);
    }
    return cubature_(piece, about);
  }

  const Pressure& load_;
  const PointMap& map_;
  std::optional<geometry::Patch> patch_;
  Point low_{INFINITY, INFINITY}, high_{-INFINITY, -INFINITY};  // of the patch
  Cubature cubature_;
  Integral all_;
};

template <std::size_t N>
void add_cell(Thrust& thrust, const std::array<std::uint32_t, N>& cell, const std::vector<Point>& positions,
              bool counts, Forces& forces) {
  Ring ring;
  Point middle(0, 0);
  for (const auto k : cell) ring.push_back(positions[k]), middle += positions[k] / double(N);
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Point& x : ring) spread += (x - middle) * (x - middle).transpose();
  const auto found = thrust(ring, middle, counts);
  const Point slope = spread.inverse() * found.first;
  for (std::size_t i = 0; i < N; ++i)
    forces(0, Eigen::Index(cell[i])) += found.value / double(N) + slope.dot(ring[i] - middle);
}

}  // namespace

PointValues moved_force(double force, const Point& lever) {
  return {force, force * lever.y(), -force * lever.x()};
}

void add_pressure(const Pressure& load, const geometry::Cloud& cloud, const PointMap& map, Forces& forces) {
  Thrust thrust(load, map);
  const double side = cloud.units.spacing, half = side / 2;
  const auto cell = [&](std::size_t k) -> Ring {
    const Point& x = cloud.positions[k];
    return {x + Point(-half, -half), x + Point(half, -half), x + Point(half, half), x + Point(-half, half)};
  };
  thrust.require_tame(cloud.plate_points, cell);
  for (std::size_t k = 0; k < cloud.plate_points; ++k) {
    const auto found = thrust(cell(k), cloud.positions[k], map.owns(k));
    const double share = cloud.areas[k] / (side * side);
    forces.col(Eigen::Index(k)) += share * PointValues(found.value, found.first.y(), -found.first.x());
  }
  thrust.require_known();
}

void add_pressure(const Pressure& load, const geometry::Tessellation& cells, const PointMap& map, Forces& forces) {
  Thrust thrust(load, map);
  const auto add = [&](const auto& cell) { add_cell(thrust, cell, cells.positions, map.owns(cell[0]), forces); };
  thrust.require_tame(cells.squares.size(), [&](std::size_t i) {
    Ring ring;
    for (const auto k : cells.squares[i]) ring.push_back(cells.positions[k]);
    return ring;
  });
  for (const auto& square : cells.squares) add(square);
  for (const auto& triangle : cells.triangles) add(triangle);
  thrust.require_known();
}

namespace {

using Segment = std::pair<Point, Point>;

/// The line in pieces of an eighth of a spacing at most, none of which crosses a crack.
std::vector<Segment> pieces_beside(const std::vector<Segment>& cracks, const Point& from, const Point& to,
                                   double spacing) {
  std::vector<double> ends{0, 1};
  const Point way = to - from;
  for (const auto& [a, b] : cracks) {
    const Point along = b - a, off = a - from;
    const double turn = way.x() * along.y() - way.y() * along.x();
    if (turn == 0) continue;
    const double at = (off.x() * along.y() - off.y() * along.x()) / turn,
                 on_crack = (off.x() * way.y() - off.y() * way.x()) / turn;
    if (at > 0 && at < 1 && on_crack >= 0 && on_crack <= 1) ends.push_back(at);
  }
  std::ranges::sort(ends);
  std::vector<Segment> result;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double share = ends[i + 1] - ends[i];
    const int pieces = std::max(1, int(std::ceil(8 * share * way.norm() / spacing - 1e-6)));
    for (int n = 0; share > 0 && n < pieces; ++n)
      result.emplace_back(from + (ends[i] + share * n / pieces) * way,
                          from + (ends[i] + share * (n + 1) / pieces) * way);
  }
  return result;
}

/// Pieces of a line. `positions`: of `count` points of the plate and maybe of others, those on a face of a crack moved
/// off it; `seeded`: true where the points about a place are discretised; `parted(x, k)`: true where a crack lies
/// between a place and point k.
template <typename Seeded, typename Parted>
std::vector<LinePiece> pieces_of(const geometry::Polyline& line, const std::vector<Segment>& cracks,
                                 const Ring& positions, std::size_t count, double spacing, const Seeded& seeded,
                                 const Parted& parted) {
  std::vector<LinePiece> result;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point &from = line[i], &to = line[i + 1];
    std::vector<std::size_t> near;
    for (std::size_t k = 0; k < count; ++k)
      if (geometry::distance(geometry::Polyline{from, to}, positions[k]) < 2 * spacing) near.push_back(k);
    for (const auto& [begin, end] : pieces_beside(cracks, from, to, spacing)) {
      const Point middle = (begin + end) / 2;
      if (!seeded(middle)) continue;
      const auto away = [&](std::size_t k) { return (positions[k] - middle).squaredNorm(); };
      const auto closer = [&](std::size_t a, std::size_t b) { return away(a) < away(b); };
      auto next = near.begin();
      for (; next != near.end(); ++next) {  // the nearest first, as far as it takes
        std::iter_swap(next, std::min_element(next, near.end(), closer));
        if (!parted(middle, *next)) break;
      }
      if (next == near.end())
        throw Refused({{Subject::spacing, 0, "a line has no point of the plate within two spacings"}});
      result.push_back({*next, middle, end - begin});
    }
  }
  return result;
}

void add_pieces(const LineLoad& load, const std::vector<LinePiece>& pieces, const Ring& positions, Forces& forces) {
  for (const auto& [k, middle, way] : pieces)
    forces.col(Eigen::Index(k)) += moved_force(load.value * way.norm(), middle - positions[k]);
}

}  // namespace

std::vector<LinePiece> line_pieces(const geometry::Polyline& line, const geometry::Cloud& cloud,
                                   const std::vector<geometry::CrackPath>& cracks) {
  std::vector<Segment> segments;
  for (const auto& crack : cracks)
    for (std::size_t i = 0; i + 1 < crack.vertices.size(); ++i)
      segments.emplace_back(crack.vertices[i], crack.vertices[i + 1]);
  return pieces_of(
      line, segments, cloud.positions, cloud.plate_points, cloud.units.spacing,
      [&](const Point& x) { return cloud.seeded(x); },
      [&](const Point& x, std::size_t k) {
        return std::ranges::any_of(
            cracks, [&](const auto& crack) { return geometry::separates(crack, x, cloud.positions[k]); });
      });
}

std::vector<LinePiece> line_pieces(const geometry::Polyline& line, const geometry::Tessellation& cells) {
  std::vector<Segment> segments;
  for (const auto& border : cells.borders)
    if (border.edge == geometry::Curves::crack)
      segments.emplace_back(cells.positions[border.from], cells.positions[border.to]);
  // points on the faces are nearer than any beyond the crack, and know their side
  return pieces_of(
      line, segments, geometry::positions_inside_faces(cells), cells.positions.size(), cells.units.spacing,
      [&](const Point& x) { return cells.sees(x); }, [](const Point&, std::size_t) { return false; });
}

void add_line_load(const LineLoad& load, const geometry::Cloud& cloud, const std::vector<geometry::CrackPath>& cracks,
                   Forces& forces) {
  add_pieces(load, line_pieces(load.along, cloud, cracks), cloud.positions, forces);
}

void add_line_load(const LineLoad& load, const geometry::Tessellation& cells, Forces& forces) {
  add_pieces(load, line_pieces(load.along, cells), cells.positions, forces);
}

}  // namespace plate
