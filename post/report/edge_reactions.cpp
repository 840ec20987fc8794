#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "plate/formulation/boundary.hpp"
#include "plate/model/reduction.hpp"
#include "post/report/reactions.hpp"

namespace post {
namespace {

using geometry::Point;

/// Straight edge or circle by the distance s along it [length], with the outward normal n to the right of the way.
class EdgeLine {
public:
  EdgeLine(const plate::Side& side, const geometry::LatticeUnits& units)
      : closed(side.circle),
        length(units.spacing * (closed ? 2 * std::numbers::pi * side.radius : (side.edge.to - side.edge.from).norm())),
        side_(side),
        units_(units) {}

  const bool closed;
  const double length;

  /// Distance of the foot of a place in lattice units, of straight edges also beyond their ends.
  double along(const Point& u) const {
    if (!closed) return units_.spacing * (u - side_.edge.from).dot((side_.edge.to - side_.edge.from).normalized());
    const double angle = -std::atan2(u.y() - side_.centre.y(), u.x() - side_.centre.x());
    return length * (angle < 0 ? 1 + angle / (2 * std::numbers::pi) : angle / (2 * std::numbers::pi));
  }
  Point place(double s) const {
    if (closed) return units_.from_lattice(side_.centre - side_.radius * normal(s));
    return units_.from_lattice(side_.edge.from + s / length * (side_.edge.to - side_.edge.from));
  }
  Point normal(double s) const {
    if (!closed) return side_.outward(side_.edge.from);
    const double angle = 2 * std::numbers::pi * s / length;
    return {-std::cos(angle), std::sin(angle)};
  }

private:
  const plate::Side& side_;
  const geometry::LatticeUnits& units_;
};

/// Part of a line that each of its places stands for: half of the way to the next place on either side.
class Cells {
public:
  /// `near`: places no farther apart are the same.
  Cells(const EdgeLine& line, std::vector<double> places, double near) : line_(line), near_(near) {
    std::ranges::sort(places);
    for (const double s : places)
      if (inside(s) && (places_.empty() || s - places_.back() > near)) places_.push_back(s);
    if (line.closed && places_.size() > 1 && places_.front() + line.length - places_.back() < near) places_.pop_back();
  }

  /// False beyond the ends of a line.
  bool inside(double s) const { return line_.closed || (s > -near_ && s < line_.length + near_); }

  /// Begin and end of the part of a place inside, on a closed line not within [0, length].
  std::array<double, 2> operator()(double s) const {
    const auto count = places_.size();
    const auto next = std::size_t(std::ranges::upper_bound(places_, s + near_) - places_.begin());
    const std::size_t i = next > 0 ? next - 1 : 0;
    const double own = places_[i], length = line_.length;
    const double before = i > 0 ? places_[i - 1] : line_.closed ? places_.back() - length : -own;
    const double after = i + 1 < count ? places_[i + 1] : line_.closed ? places_.front() + length : 2 * length - own;
    return {(before + own) / 2, (own + after) / 2};
  }

  double largest() const {
    double result = 0;
    for (const double s : places_) {
      const auto [begin, end] = (*this)(s);
      result = std::max(result, end - begin);
    }
    return result;
  }

private:
  const EdgeLine& line_;
  double near_;
  std::vector<double> places_;
};

Wrench scaled(double factor, const Wrench& w) {
  return {factor * w.force, factor * w.moment_x, factor * w.moment_y};
}

/// Wrench on a piece of an edge by a unit force on a degree of freedom that is held.
struct PieceShare {
  std::uint32_t held;
  Wrench unit;
};

/// Adds a share at s to the pieces that its cell meets. Each piece takes a part of the force at its own place, so that
/// the wrench of all pieces is that of the share.
void spread(const EdgeLine& line, const Cells& cells, double s, const PieceShare& share,
            std::vector<std::vector<PieceShare>>& pieces) {
  const auto count = long(pieces.size());
  if (!cells.inside(s)) return pieces[s < 0 ? 0 : pieces.size() - 1].push_back(share);
  const auto [begin, end] = cells(s);
  const double length = line.length / double(count);
  const Point n = line.normal(s);
  const long first = long(std::floor(begin / length)), last = long(std::ceil(end / length));
  for (long i = line.closed ? first : std::max(first, 0L); i < (line.closed ? last : std::min(last, count)); ++i) {
    const double from = std::max(begin, double(i) * length), to = std::min(end, double(i + 1) * length);
    if (to <= from) continue;
    Wrench unit = scaled((to - from) / (end - begin), share.unit);
    const double couple = (from + to - begin - end) / 2 * unit.force;
    unit.moment_x += couple * n.x(), unit.moment_y += couple * n.y();
    pieces[std::size_t((i % count + count) % count)].push_back({share.held, unit});
  }
}

/// Replaces the values of the first `width` pieces by a + b s + c s log s, which fits the next three times as many
/// best, none of them in the other half. So does V run to a right-angled corner of simply supported edges under
/// pressure. Returns the sum of what they had more.
double smoothed_end(std::vector<double>& values, std::size_t width) {
  const auto terms = [width](std::size_t piece) -> Eigen::RowVector3d {
    const double s = (double(piece) + 0.5) / double(width);
    return {1, s, s * std::log(s)};
  };
  const auto fitted = Eigen::Index(std::min(3 * width, values.size() / 2 - width));
  Eigen::MatrixX3d matrix(fitted, 3);
  for (Eigen::Index i = 0; i < fitted; ++i) matrix.row(i) = terms(width + std::size_t(i));
  const Eigen::Map<const Eigen::VectorXd> next(&values[width], fitted);
  const Eigen::Vector3d smooth = matrix.colPivHouseholderQr().solve(next);
  double more = 0;
  for (std::size_t i = 0; i < width; ++i) {
    const double value = terms(i).dot(smooth);
    more += values[i] - value, values[i] = value;
  }
  return more;
}

/// Values of a piece about the middle of it.
EdgeValue value_on(const EdgeLine& line, double s, double length, const Wrench& w) {
  const Point x = line.place(s), n = line.normal(s), t(-n.y(), n.x());
  const Point about(w.moment_x - x.y() * w.force, w.moment_y + x.x() * w.force);
  return {.s = s,
          .position = x,
          .length = length,
          .force = w.force / length,
          .moment = about.dot(t) / length,
          .twist = -about.dot(n) / length,
          .kirchhoff_force = 0};
}

bool ends_at(const plate::Side& side, const Point& vertex) {
  return !side.circle && (side.edge.from == vertex || side.edge.to == vertex);
}

/// True where Kirchhoff's theory has a corner force: none of the edges that meet there holds the rotation along its
/// normal, as clamps and mirror planes do.
bool is_corner(const std::vector<plate::Side>& sides, const Point& vertex) {
  return std::ranges::none_of(
      sides, [&](const plate::Side& side) { return plate::held_by(side.kind).normal && ends_at(side, vertex); });
}

/// The names of the edges that meet at a corner.
std::string corner_name(const std::vector<plate::Side>& sides, const Point& vertex) {
  std::string result;
  for (const auto& side : sides)
    if (ends_at(side, vertex)) result += (result.empty() ? "" : " and ") + side.name;
  return result;
}

/// Sums of the reactions on every piece, over all ranks.
std::vector<Wrench> sums(const plate::Boundary& boundary, const std::vector<std::vector<PieceShare>>& pieces,
                         const Eigen::VectorXd& reaction) {
  std::vector<Wrench> result;
  for (const auto& shares : pieces) {
    const auto [force, moment_x, moment_y] =
        plate::sum_of_items<3>(boundary.map, shares.size(), [&](std::size_t k, const auto& add) {
          const auto& [held, unit] = shares[k];
          if (!boundary.owns(boundary.constraints.held()[held].point)) return;
          add(0, reaction[held] * unit.force);
          add(1, reaction[held] * unit.moment_x), add(2, reaction[held] * unit.moment_y);
        });
    result.push_back({force, moment_x, moment_y});
  }
  return result;
}

/// Force per length with twist as forces, of each piece: V = Q + dM_ns/ds, with the ends' forces in the end pieces.
std::vector<double> kirchhoff_forces(const std::vector<EdgeValue>& values, bool closed) {
  const auto count = values.size();
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) {
    const auto border = [&](std::size_t k) {  // twist between piece k - 1 and piece k
      if (!closed && (k == 0 || k == count)) return 0.0;
      return (values[(k + count - 1) % count].twist + values[k % count].twist) / 2;
    };
    result.push_back(values[i].force + (border(i + 1) - border(i)) / values[i].length);
  }
  return result;
}

/// Reactions on the fine pieces of an edge, and the length of its ends where a corner force acts.
struct FineEdge {
  const EdgeLine& line;
  std::vector<Wrench> sums;
  double end;
};

/// Adds the force at a corner to that of the other edge there.
void add_corner(EdgeReactions& result, const CornerForce& corner) {
  const auto found = std::ranges::find(result.corners, corner.position, &CornerForce::position);
  if (found == result.corners.end()) return result.corners.push_back(corner);
  found->force += corner.force;
}

/// Smooths both ends of the forces of an edge, and adds what they had more to the forces at corners.
void take_corners(EdgeReactions& result, const FineEdge& fine, const std::vector<plate::Side>& sides, std::size_t side,
                  std::vector<double>& forces) {
  if (fine.line.closed) return;
  const double length = fine.line.length / double(forces.size());
  const auto width = std::size_t(std::ceil(fine.end / length - 1e-9));
  const std::array vertices{sides[side].edge.from, sides[side].edge.to};
  for (const int at : {0, 1}) {
    const auto& vertex = vertices[std::size_t(at)];
    if (!is_corner(sides, vertex)) continue;
    if (at == 1) std::ranges::reverse(forces);
    const double more = length * smoothed_end(forces, width);
    if (at == 1) std::ranges::reverse(forces);
    add_corner(result, {corner_name(sides, vertex), fine.line.place(at == 0 ? 0 : fine.line.length), more});
  }
}

/// Pieces that are wanted of an edge, and where s begins.
struct WantedPieces {
  std::size_t count;
  double begin;
};

/// Adds the values of an edge and the forces at its corners.
void add_edge(EdgeReactions& result, const FineEdge& fine, const std::vector<plate::Side>& sides, std::size_t side,
              const WantedPieces& wanted) {
  const auto& line = fine.line;
  const auto finer = fine.sums.size() / wanted.count;
  const double length = line.length / double(fine.sums.size());
  std::vector<EdgeValue> values;
  for (std::size_t i = 0; i < fine.sums.size(); ++i)
    values.push_back(value_on(line, (double(i) + 0.5) * length, length, fine.sums[i]));
  auto forces = kirchhoff_forces(values, line.closed);
  take_corners(result, fine, sides, side, forces);
  EdgeCurve curve{sides[side].name, {}};
  for (std::size_t i = 0; i < wanted.count; ++i) {
    Wrench sum;
    double force = 0;
    for (std::size_t k = i * finer; k < (i + 1) * finer; ++k) sum += fine.sums[k], force += forces[k] / double(finer);
    const double piece = double(finer) * length;
    curve.values.push_back(value_on(line, (double(i) + 0.5) * piece, piece, sum));
    curve.values.back().kirchhoff_force = force, curve.values.back().s += wanted.begin;
  }
  result.curves.push_back(std::move(curve));
}

}  // namespace

/// Sides that a share acts at: of a fictitious point its own, else the nearest of the support's.
std::vector<std::size_t> Supports::sides_of(const Share& share) const {
  constexpr double near = 1e-6;  // spacings
  const auto& sides = boundary_->sides;
  const auto& name = boundary_->holders[share.holder].name;
  const auto point = boundary_->constraints.held()[share.held].point;
  std::vector<std::size_t> result;
  if (!boundary_->is_plate(point))
    for (const int s : boundary_->fictitious[point - boundary_->cloud.plate_points].sides)
      if (s >= 0 && sides[std::size_t(s)].name == name) result.push_back(std::size_t(s));
  if (!result.empty()) return result;
  const auto& u = boundary_->lattice[point];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (sides[s].name != name) continue;
    const double away =
        sides[s].circle ? std::abs(sides[s].inside(u)) : geometry::distance({sides[s].edge.from, sides[s].edge.to}, u);
    if (away < least - near) result.clear();
    if (away <= least + near) result.push_back(s);
    least = std::min(least, away);
  }
  return result;
}

EdgeReactions Supports::along_edges(const Eigen::VectorXd& reaction, std::size_t pieces, double layer) const {
  const auto& sides = boundary_->sides;
  const auto& units = boundary_->cloud.units;
  const double near = 1e-6 * units.spacing;
  std::vector<std::vector<std::pair<double, PieceShare>>> of_side(sides.size());  // with the place of each
  for (const auto& share : shares_) {
    if (boundary_->holders[share.holder].place != plate::Holder::Place::edge) continue;
    const auto own = sides_of(share);
    const auto& u = boundary_->lattice[boundary_->constraints.held()[share.held].point];
    for (const auto s : own)
      of_side[s].emplace_back(EdgeLine(sides[s], units).along(u),
                              PieceShare{share.held, scaled(1.0 / double(own.size()), share.unit)});
  }
  EdgeReactions result;
  std::map<std::string, double> lengths;  // of the sides of a name so far
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (plate::holder(boundary_->holders, sides[s].name) == boundary_->holders.size()) continue;
    const EdgeLine line(sides[s], units);
    std::vector<double> places;
    for (const auto& [place, share] : of_side[s]) places.push_back(place);
    const Cells cells(line, plate::gathered(boundary_->map, places), near);
    const double end = std::min(line.length / 8, std::max(layer, 3 * cells.largest()));
    const auto finer = std::size_t(std::ceil(2 * line.length / (double(pieces) * end)));
    std::vector<std::vector<PieceShare>> shares(pieces * finer);
    for (const auto& [place, share] : of_side[s]) spread(line, cells, place, share, shares);
    const FineEdge fine{line, sums(*boundary_, shares, reaction), end};
    add_edge(result, fine, sides, s, {pieces, lengths[sides[s].name]});
    lengths[sides[s].name] += line.length;
  }
  return result;
}

}  // namespace post
