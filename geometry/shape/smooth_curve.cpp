#include "geometry/shape/smooth_curve.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double finest_bend = 0.4 * degree;  // of a fine polyline

/// Turn from one piece to the next, positive to the left [rad].
double bend_at(const Polyline& line, std::size_t i) {
  const Point before = line[i] - line[i - 1], after = line[i + 1] - line[i];
  return std::atan2(cross(before, after), before.dot(after));
}

/// Vertices first ... last of a polyline between whose pieces all bends are slight.
struct Run {
  std::size_t first, last;
};

/// The longest runs of at least `least` bends of at most `most` [rad], between pieces of like length.
std::vector<Run> runs(const Polyline& line, std::size_t least, double most) {
  constexpr double alike = 4;  // times as long
  std::vector<Run> result;
  std::size_t first = 0;
  for (std::size_t i = 1; i + 1 <= line.size(); ++i) {
    bool goes_on = i + 1 < line.size();
    if (goes_on) {
      const double before = (line[i] - line[i - 1]).norm(), after = (line[i + 1] - line[i]).norm();
      goes_on = std::abs(bend_at(line, i)) <= most && before <= alike * after && after <= alike * before;
    }
    if (goes_on) continue;
    if (i - first > least) result.push_back({first, i});
    first = i;
  }
  return result;
}

/// The runs of a fine polyline.
std::vector<Run> fine_runs(const Polyline& line) {
  return runs(line, 8, 1.5 * finest_bend);
}

/// Tangent at `at` of the circle through three points in their order, along that order.
Point tangent(const Point& a, const Point& b, const Point& c, const Point& at) {
  const auto inverted = [&](const Point& x) -> Point { return (x - at) / (x - at).squaredNorm(); };
  if (at == a) return (inverted(b) - inverted(c)).normalized();
  if (at == c) return (inverted(a) - inverted(b)).normalized();
  return (inverted(c) - inverted(a)).normalized();
}

/// The smooth line through points, three at least: piece i goes from point i to the next. Pieces of a circle are met to
/// the sixth order of their angle (Hermite).
class LineThrough {
public:
  explicit LineThrough(Polyline points) : points_(std::move(points)) {
    const std::size_t last = points_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      const std::size_t from = i == 0 ? 0 : std::min(i - 1, last - 2);
      tangents_.push_back(tangent(points_[from], points_[from + 1], points_[from + 2], points_[i]));
    }
  }

  std::size_t pieces() const { return points_.size() - 1; }
  double length(std::size_t piece) const { return chord(piece).norm(); }
  /// Sum of the turns from tangent to chord and to tangent [rad].
  double bend(std::size_t piece) const {
    const auto turn = [&](const Point& t) { return std::abs(std::atan2(cross(t, chord(piece)), t.dot(chord(piece)))); };
    return turn(tangents_[piece]) + turn(tangents_[piece + 1]);
  }
  Point operator()(std::size_t piece, double t) const {
    if (t == 0) return points_[piece];
    if (t == 1) return points_[piece + 1];
    const Point d = chord(piece);
    const auto handle = [&](const Point& along) -> Point {
      return 2 * d.norm() / (1 + along.dot(d) / d.norm()) * along;
    };
    const double s = 1 - t;
    return s * s * (1 + 2 * t) * points_[piece] + t * t * (3 - 2 * t) * points_[piece + 1] +
           t * s * (s * handle(tangents_[piece]) - t * handle(tangents_[piece + 1]));
  }

  /// Unit vector along the line.
  Point along(std::size_t piece, double t) const {
    if (t == 0 || t == 1) return tangents_[piece + (t == 1 ? 1 : 0)];
    constexpr double step = 1e-3;  // fine pieces are arcs to far more digits
    return ((*this)(piece, std::min(1.0, t + step)) - (*this)(piece, std::max(0.0, t - step))).normalized();
  }

private:
  Point chord(std::size_t piece) const { return points_[piece + 1] - points_[piece]; }
  Polyline points_, tangents_;
};

/// Ends of other cracks within tolerance of a polyline, but for its own ends.
std::vector<Point> touching(const std::vector<Polyline>& cracks, std::size_t which, double tolerance) {
  std::vector<Point> result;
  const auto& own = cracks[which];
  for (std::size_t other = 0; other < cracks.size(); ++other) {
    if (other == which || cracks[other].size() < 2) continue;
    for (const Point& x : {cracks[other].front(), cracks[other].back()})
      if (std::min((x - own.front()).norm(), (x - own.back()).norm()) > tolerance && distance(own, x) <= tolerance)
        result.push_back(x);
  }
  return result;
}

/// The polyline with these places on it as vertices, but where it has a vertex.
Polyline with_vertices(Polyline line, const std::vector<Point>& places, double tolerance) {
  for (const Point& x : places) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (const double away = distance_to_segment(line[i], line[i + 1], x); away < least) least = away, nearest = i;
    if (std::min((x - line[nearest]).norm(), (x - line[nearest + 1]).norm()) > tolerance)
      line.insert(line.begin() + std::ptrdiff_t(nearest) + 1, x);
  }
  return line;
}

/// True where bends to both sides alternate more often than a curve does: a zigzag.
bool zigzags(const Polyline& line, const Run& run) {
  std::size_t changes = 0;
  for (std::size_t i = run.first + 2; i < run.last; ++i) changes += bend_at(line, i) * bend_at(line, i - 1) < 0;
  return 4 * changes > run.last - run.first;
}

/// Replaces runs of a polyline by what `part` makes of them, which begins and ends as they do.
template <typename Part>
Polyline replaced(const Polyline& line, const std::vector<Run>& runs, const Part& part) {
  Polyline result;
  std::size_t next = 0;
  for (const auto& run : runs) {
    result.insert(result.end(), line.begin() + std::ptrdiff_t(next), line.begin() + std::ptrdiff_t(run.first));
    const Polyline own =
        part(Polyline(line.begin() + std::ptrdiff_t(run.first), line.begin() + std::ptrdiff_t(run.last) + 1));
    result.insert(result.end(), own.begin(), own.end() - 1);
    next = run.last;
  }
  result.insert(result.end(), line.begin() + std::ptrdiff_t(next), line.end());
  return result;
}

Polyline fine(const Polyline& points) {
  constexpr double least = 16;  // pieces
  constexpr double even = 1.5;  // ratio of neighbouring pieces, before they are rounded
  const LineThrough line(points);
  std::vector<double> longest(line.pieces());
  for (std::size_t i = 0; i < longest.size(); ++i)
    longest[i] = line.length(i) / std::max({1.0, 2 * line.bend(i) / finest_bend, least / double(longest.size())});
  for (std::size_t i = 1; i < longest.size(); ++i) longest[i] = std::min(longest[i], even * longest[i - 1]);
  for (std::size_t i = longest.size() - 1; i > 0; --i) longest[i - 1] = std::min(longest[i - 1], even * longest[i]);
  Polyline result{points.front()};
  for (std::size_t i = 0; i < longest.size(); ++i) {
    const double count = std::ceil(line.length(i) / longest[i] * (1 - 1e-9));
    for (double k = 1; k <= count; ++k) result.push_back(line(i, k / count));
  }
  return result;
}

/// Part of a fine polyline between two of its vertices by pieces twice as long as `size` says, half of that at its
/// ends.
void draw(const LineThrough& line, std::size_t first, std::size_t last, const std::function<double(const Point&)>& size,
          Polyline& result) {
  struct Step {
    std::size_t piece;
    double from, to;  // along the piece, 0 to 1
    double sum;       // of length / size, up to its end
  };
  std::vector<Step> steps;
  double sum = 0;
  for (std::size_t i = first; i < last; ++i)
    for (double t = 0; t < 1;) {
      const double length = line.length(i), end = std::min(1.0, t + std::max(1e-3, size(line(i, t)) / (4 * length)));
      sum += (end - t) * length / size(line(i, (t + end) / 2));
      steps.push_back({i, t, end, sum});
      t = end;
    }
  // pieces touch the line in their middle, the first and the last one at its ends: tips have its direction
  const double count = std::max(1.0, std::ceil(sum / 2 - 0.2));
  Point before = line(first, 0), before_along = line.along(first, 0);
  std::size_t at = 0;
  for (double n = 1; n <= count; ++n) {
    const double wanted = sum * n / count;
    while (at + 1 < steps.size() && steps[at].sum < wanted) ++at;
    const auto& [piece, from, to, reached] = steps[at];
    const double start = at == 0 ? 0 : steps[at - 1].sum;
    const double t = n == count ? 1 : from + (wanted - start) / (reached - start) * (to - from);
    const Point here = line(piece, t), here_along = line.along(piece, t), d = here - before;
    const double leg = d.squaredNorm() / (d.dot(before_along) + d.dot(here_along));
    result.push_back((before + leg * before_along + here - leg * here_along) / 2);
    before = here, before_along = here_along;
  }
  result.push_back(before);
}

}  // namespace

Polyline curve_through(const Polyline& points) {
  return fine(points);
}

Polyline arc(const Point& centre, double radius, double from, double to) {
  constexpr double least = 16;  // pieces
  const double count = std::max(least, std::ceil(2 * std::abs(to - from) / finest_bend));
  Polyline result;
  for (double k = 0; k <= count; ++k) {
    const double angle = from + k / count * (to - from);
    result.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
  }
  return result;
}

namespace {

/// The four cubic B-splines that are not zero at t of `spans` equal spans over 0 to 1, and the first of them.
std::pair<std::size_t, std::array<double, 4>> splines_at(double t, std::size_t spans) {
  const double x = t * double(spans);
  const auto span = std::min(std::size_t(x), spans - 1);
  const double u = x - double(span), v = 1 - u;
  return {span,
          {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6}};
}

/// Places along a polyline, 0 to 1.
std::vector<double> places_along(const Polyline& points) {
  std::vector<double> result{0};
  for (std::size_t i = 1; i < points.size(); ++i) result.push_back(result.back() + (points[i] - points[i - 1]).norm());
  for (double& t : result) t /= length(points);
  return result;
}

/// Values of a sum of splines: at t.
Point value(const Eigen::MatrixX2d& sum, double t) {
  const auto [first, share] = splines_at(t, std::size_t(sum.rows()) - 3);
  Point result(0, 0);
  for (std::size_t i = 0; i < 4; ++i) result += share[i] * sum.row(Eigen::Index(first + i)).transpose();
  return result;
}

/// Splines by least squares, with the ends of the points by their weight.
Eigen::MatrixX2d splines_of(const Polyline& points, const std::vector<double>& t, std::size_t spans) {
  constexpr double of_ends = 1e4;
  const auto count = Eigen::Index(points.size());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(count, Eigen::Index(spans) + 3);
  Eigen::MatrixX2d wanted(count, 2);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double weight = k == 0 || k + 1 == count ? of_ends : 1;
    const auto [first, share] = splines_at(t[std::size_t(k)], spans);
    for (std::size_t i = 0; i < 4; ++i) basis(k, Eigen::Index(first + i)) = weight * share[i];
    wanted.row(k) = weight * points[std::size_t(k)].transpose();
  }
  return basis.completeOrthogonalDecomposition().solve(wanted);
}

}  // namespace

namespace {

struct Fit {
  Polyline points;  // of the curve
  double off, rms;  // distances of the given points from it [length]
};

Fit fit(const Polyline& given, const std::vector<double>& t, std::size_t spans) {
  const auto sum = splines_of(given, t, spans);
  const std::size_t pieces = 8 * spans;
  Fit result{{}, 0, 0};
  for (std::size_t i = 0; i <= pieces; ++i) result.points.push_back(value(sum, double(i) / double(pieces)));
  result.points.front() = given.front(), result.points.back() = given.back();
  const auto line = fine(result.points);
  for (const Point& x : given) {
    const double away = distance(line, x);
    result.off = std::max(result.off, away), result.rms += away * away / double(given.size());
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

}  // namespace

FittedCurve fitted_curve(const Polyline& points, double tolerance) {
  constexpr double much = 0.9;  // what twice the spans leave where fewer do not follow the curve yet
  const auto t = places_along(points);
  for (std::size_t spans = 1; 4 * spans <= points.size(); ++spans)
    if (const auto found = fit(points, t, spans); found.off <= tolerance)
      if (2 * spans + 3 > points.size() || fit(points, t, 2 * spans).rms >= much * found.rms)
        return {found.points, found.off, spans};
  return {points, 0, points.size()};
}

std::optional<SmoothCrack> smooth_crack(const std::vector<Polyline>& cracks, std::size_t which, double tolerance) {
  constexpr std::size_t least = 5;  // bends
  constexpr double most = 10.01 * degree;
  const Polyline& given = cracks[which];
  auto found = runs(given, least, most);
  std::erase_if(found, [&](const Run& run) {
    double turned = 0, largest = 0;
    for (std::size_t i = run.first + 1; i < run.last; ++i)
      turned += std::abs(bend_at(given, i)), largest = std::max(largest, std::abs(bend_at(given, i)));
    const bool is_fine = largest <= 1.5 * finest_bend && run.last - run.first > 8;
    return is_fine || turned < degree || zigzags(given, run);
  });
  if (found.empty()) return std::nullopt;
  SmoothCrack result;
  for (const auto& run : found) {
    result.pieces += run.last - run.first;
    for (std::size_t i = run.first + 1; i < run.last; ++i)
      result.largest_bend = std::max(result.largest_bend, std::abs(bend_at(given, i)));
  }
  const auto ends = touching(cracks, which, tolerance);
  result.vertices = replaced(given, found, [&](const Polyline& part) {
    std::vector<Point> on_it;
    for (const auto& x : ends)
      if (distance(part, x) <= tolerance) on_it.push_back(x);
    return fine(with_vertices(part, on_it, tolerance));
  });
  return result;
}

Polyline drawn(const std::vector<Polyline>& cracks, std::size_t which, double tolerance,
               const std::function<double(const Point&)>& size) {
  const Polyline& given = cracks[which];
  const auto found = fine_runs(given);
  if (found.empty()) return given;
  const auto ends = touching(cracks, which, tolerance);
  return replaced(given, found, [&](const Polyline& fine_part) {
    std::vector<Point> on_it;
    for (const Point& x : ends)
      if (distance(fine_part, x) <= tolerance) on_it.push_back(x);
    const Polyline part = with_vertices(fine_part, on_it, tolerance);
    const LineThrough line(part);
    Polyline result{part.front()};
    std::size_t first = 0;
    for (std::size_t i = 1; i < part.size(); ++i) {
      const bool stays = std::ranges::any_of(ends, [&](const Point& x) { return (x - part[i]).norm() <= tolerance; });
      if (i + 1 < part.size() && !stays) continue;
      draw(line, first, i, size, result);
      first = i;
    }
    return result;
  });
}

std::optional<TipCircle> tip_circle(const CrackPath& path, bool at_back, double spacing) {
  constexpr double longest = 4.9;  // spacings: pieces behind turns of cracks that grow are longer
  constexpr double most = 15 * degree;
  const auto& v = path.vertices;
  if (v.size() < 4) return std::nullopt;
  const auto from_tip = [&](std::size_t i) -> const Point& { return v[at_back ? v.size() - 1 - i : i]; };
  const Polyline last{from_tip(0), from_tip(1), from_tip(2), from_tip(3)};
  for (const std::size_t i : {1, 2})
    if ((last[i] - last[i - 1]).norm() > longest * spacing || std::abs(bend_at(last, i)) > most) return std::nullopt;
  // the last piece touches the curve at the tip, the one before in its middle
  const double curvature = std::tan(bend_at(last, 1) / 2) / (last[1] - last[0]).norm();
  if (curvature == 0) return std::nullopt;
  return TipCircle{(last[0] - last[1]).normalized(), -curvature};
}

double signed_distance(const Polyline& line, const Point& x) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (const double away = distance_to_segment(line[i], line[i + 1], x); away < least) least = away, nearest = i;
  const auto side_of = [&](std::size_t i) { return cross(line[i + 1] - line[i], x - line[i]); };
  double side = side_of(nearest);
  // next to a vertex, the piece that the place is farther beside tells the side
  for (const std::size_t i : {nearest - 1, nearest + 1})
    if (i < line.size() - 1 && distance_to_segment(line[i], line[i + 1], x) <= least * (1 + 1e-9) &&
        std::abs(side_of(i)) > std::abs(side))
      side = side_of(i);
  return std::copysign(least, side);
}

}  // namespace geometry
