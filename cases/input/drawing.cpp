#include "cases/input/drawing.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "plate/model/wording.hpp"

namespace cases {
namespace {

using geometry::Point;
using geometry::Polyline;

/// Pieces one after another, each along the chain; closed where the last ends at the begin of the first.
struct Chain {
  std::vector<DrawnPiece> pieces;
  bool closed = false;
};

double turn_at(const Polyline& line, std::size_t i) {
  const Point a = line[i] - line[i - 1], b = line[i + 1] - line[i];
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// Joins pieces at nodes, the places of their ends.
class Joiner {
public:
  Joiner(std::vector<DrawnPiece> pieces, double join) : pieces_(std::move(pieces)), join_(join) {
    std::erase_if(pieces_, [&](const DrawnPiece& piece) {
      return std::ranges::all_of(piece.points,
                                 [&](const Point& x) { return (x - piece.points.front()).norm() <= join; });
    });
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      ends_.push_back({node(pieces_[i].points.front()), node(pieces_[i].points.back())});
      for (const auto k : ends_.back()) at_[k].push_back(i);
    }
    used_.assign(pieces_.size(), false);
  }

  /// Chains of all pieces; they go on through nodes where two ends meet.
  std::vector<Chain> chains() {
    std::vector<Chain> result;
    for (const bool from_ends : {true, false})
      for (std::size_t i = 0; i < pieces_.size(); ++i)
        for (const bool reversed : {false, true})
          if (!used_[i] && (!from_ends || at_.at(begin_of(i, reversed)).size() != 2))
            result.push_back(chain(i, reversed));
    return result;
  }

  /// Places where one end is alone, with the distance of the nearest other such end, and where more than two meet.
  std::vector<std::string> errors() const {
    std::vector<std::string> result;
    for (const auto& [k, pieces] : at_) {
      const auto where = plate::text_of(nodes_[k]);
      if (pieces.size() > 2) result.push_back(fmt::format("{} lines meet at {}: two must", pieces.size(), where));
      if (pieces.size() != 1) continue;
      double gap = INFINITY;
      for (const auto& [other, others] : at_)
        if (other != k && others.size() == 1) gap = std::min(gap, (nodes_[other] - nodes_[k]).norm());
      result.push_back(fmt::format("is open at {}, line {} of the file: the nearest other end is {:.3g} away", where,
                                   pieces_[pieces.front()].line, gap));
    }
    return result;
  }

private:
  std::size_t node(const Point& x) {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if ((nodes_[k] - x).norm() <= join_) return k;
    nodes_.push_back(x);
    return nodes_.size() - 1;
  }
  std::size_t begin_of(std::size_t piece, bool reversed) const { return ends_[piece][reversed ? 1 : 0]; }

  Chain chain(std::size_t piece, bool reversed) {
    Chain result;
    const std::size_t start = begin_of(piece, reversed);
    while (true) {
      used_[piece] = true;
      auto& added = result.pieces.emplace_back(pieces_[piece]);
      if (reversed) std::ranges::reverse(added.points);
      if (result.pieces.size() > 1) added.points.front() = result.pieces[result.pieces.size() - 2].points.back();
      const std::size_t end = begin_of(piece, !reversed);
      const auto& next = at_.at(end);
      result.closed = end == start && next.size() == 2;
      if (result.closed) added.points.back() = result.pieces.front().points.front();
      if (end == start || next.size() != 2) return result;
      const std::size_t other = next[0] == piece ? next[1] : next[0];
      if (used_[other]) return result;
      reversed = begin_of(other, false) != end;
      piece = other;
    }
  }

  std::vector<DrawnPiece> pieces_;
  double join_;
  std::vector<Point> nodes_;
  std::vector<std::array<std::size_t, 2>> ends_;        // of pieces: nodes
  std::map<std::size_t, std::vector<std::size_t>> at_;  // node: pieces, one that closes itself twice
  std::vector<char> used_;
};

double area_of(const Chain& loop) {
  double twice = 0;
  for (const auto& piece : loop.pieces)
    for (std::size_t i = 0; i + 1 < piece.points.size(); ++i)
      twice += piece.points[i].x() * piece.points[i + 1].y() - piece.points[i].y() * piece.points[i + 1].x();
  return twice / 2;
}

void turn_counter_clockwise(Chain& loop) {
  if (area_of(loop) >= 0) return;
  std::ranges::reverse(loop.pieces);
  for (auto& piece : loop.pieces) std::ranges::reverse(piece.points);
}

/// Begins the loop at its lowest corner, of several the left one.
void begin_lowest(Chain& loop, double join) {
  const auto begin = [](const DrawnPiece& piece) -> const Point& { return piece.points.front(); };
  double low = INFINITY;
  for (const auto& piece : loop.pieces) low = std::min(low, begin(piece).y());
  auto first = loop.pieces.end();
  for (auto piece = loop.pieces.begin(); piece != loop.pieces.end(); ++piece)
    if (begin(*piece).y() <= low + join && (first == loop.pieces.end() || begin(*piece).x() < begin(*first).x()))
      first = piece;
  std::ranges::rotate(loop.pieces, first);
}

/// The circle that all pieces of a loop are arcs of.
std::optional<geometry::Circle> circle_of(const Chain& loop, double join) {
  const auto& first = loop.pieces.front().circle;
  for (const auto& piece : loop.pieces)
    if (!piece.circle ||
        (piece.circle->centre - first->centre).norm() + std::abs(piece.circle->radius - first->radius) > join)
      return std::nullopt;
  return first;
}

/// The piece as chords: its first point, and others but for the last. Notes how far they are off.
Polyline chords(const DrawnPiece& piece, double chord, double& off) {
  constexpr double most = std::numbers::pi / 12;
  const auto& line = piece.points;
  if (piece.straight()) return {line.front()};
  std::vector<double> turned{0}, gone{0};
  for (std::size_t i = 1; i < line.size(); ++i) {
    turned.push_back(turned.back() + (i + 1 < line.size() ? turn_at(line, i) : 0));
    gone.push_back(gone.back() + (line[i] - line[i - 1]).norm());
  }
  const double wanted = std::max(turned.back() / most, chord > 0 ? gone.back() / chord : 0);
  const double least = line.front() == line.back() ? 8 : 1;
  const auto count = std::min(line.size() - 1, std::size_t(std::max(least, std::ceil(wanted - 1e-9))));
  Polyline result;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = double(i + 1) / double(count);
    const std::size_t from = at;
    while (at + 1 < line.size() && gone[at] < share * gone.back() * (1 - 1e-12)) ++at;
    if (at == from) continue;
    result.push_back(line[from]);
    for (std::size_t k = from; k <= at; ++k) off = std::max(off, geometry::distance({line[from], line[at]}, line[k]));
  }
  return result;
}

/// The rectangle along the axes that a loop is, where its edges have no names of their own.
std::optional<geometry::Polygon> rectangle_of(const Chain& loop, const std::string& layer, double join) {
  if (loop.pieces.size() != 4) return std::nullopt;
  for (const auto& piece : loop.pieces)
    if (!piece.straight() || piece.layer != layer) return std::nullopt;
  const Point a = loop.pieces[0].points.front(), b = loop.pieces[2].points.front();
  auto result = geometry::rectangle(a.x(), a.y(), b.x(), b.y()).outer;
  for (std::size_t i = 0; i < 4; ++i)
    if ((result.vertices[i] - loop.pieces[i].points.front()).norm() > join) return std::nullopt;
  return result;
}

geometry::Polygon polygon_of(const Chain& loop, const DrawingLayers& layers, double chord, double& off) {
  geometry::Polygon result;
  std::size_t number = 0;
  for (const auto& piece : loop.pieces) {
    std::string name;
    for (const auto& edge : layers.edges)
      if (layer_key(edge) == piece.layer) name = edge;
    const bool own = name.empty();
    if (own) name = fmt::format("edge{}", number++);
    for (const auto& x : chords(piece, chord, off)) result.vertices.push_back(x), result.edge_names.push_back(name);
  }
  return result;
}

/// Closed loops of some layers; the others are problems.
std::vector<Chain> loops(const std::vector<DrawnPiece>& all, const std::set<std::string>& of, const std::string& layer,
                         double join, std::vector<std::string>& problems) {
  std::vector<DrawnPiece> pieces;
  for (const auto& piece : all)
    if (of.contains(piece.layer)) pieces.push_back(piece);
  Joiner joiner(std::move(pieces), join);
  const auto errors = joiner.errors();
  for (const auto& error : errors) problems.push_back(fmt::format("layer {} {}", layer, error));
  auto result = errors.empty() ? joiner.chains() : std::vector<Chain>();
  for (auto& loop : result) turn_counter_clockwise(loop), begin_lowest(loop, join);
  return result;
}

/// The ends of cracks that lie on a curve, put onto its chords.
void put_onto_chords(JoinedDrawing& drawing, double join) {
  const double near = 1.01 * drawing.off + join;
  for (auto& crack : drawing.cracks)
    for (Point* x : {&crack.front(), &crack.back()}) {
      Point nearest = *x;
      double least = near;
      for (const auto& [name, from, to] : geometry::straight_edges(drawing.outline)) {
        const Point along = to - from;
        const Point foot = from + std::clamp(along.dot(*x - from) / along.squaredNorm(), 0.0, 1.0) * along;
        if ((foot - *x).norm() <= least) nearest = foot, least = (foot - *x).norm();
      }
      *x = nearest;
    }
}

/// Says what is wrong with the shape by layers and places.
void check_shape(const JoinedDrawing& drawing, const DrawingLayers& layers, std::vector<std::string>& problems) {
  const auto first_of = [](const geometry::Hole& hole) {
    const auto* circle = std::get_if<geometry::Circle>(&hole);
    return circle ? circle->centre : std::get<geometry::Polygon>(hole).vertices.front();
  };
  for (const auto& [where, what] : geometry::errors(drawing.outline)) {
    std::string place = "layer " + layers.outline;
    if (std::size_t i = 0; std::sscanf(where.c_str(), "holes[%zu]", &i) == 1)
      place =
          fmt::format("layer {}, {} at {},", layers.holes, where, plate::text_of(first_of(drawing.outline.holes[i])));
    problems.push_back(place + " " + what);
  }
}

}  // namespace

std::set<std::string> DrawingLayers::all() const {
  std::set<std::string> result{layer_key(outline), layer_key(holes), layer_key(cracks)};
  for (const auto& edge : edges) result.insert(layer_key(edge));
  return result;
}

JoinedDrawing joined(std::vector<DrawnPiece> pieces, const DrawingLayers& layers, double join, double chord) {
  JoinedDrawing result;
  std::set<std::string> of_outline{layer_key(layers.outline)};
  for (const auto& edge : layers.edges) of_outline.insert(layer_key(edge));
  const auto outlines = loops(pieces, of_outline, layers.outline, join, result.problems);
  if (outlines.size() > 1) {
    std::string places;
    for (const auto& loop : outlines)
      places += (places.empty() ? "" : " and ") + plate::text_of(loop.pieces.front().points.front());
    result.problems.push_back(
        fmt::format("layer {} has {} closed loops, at {}: the outline is one, holes have the layer {}", layers.outline,
                    outlines.size(), places, layers.holes));
  }
  for (const auto& loop : loops(pieces, {layer_key(layers.holes)}, layers.holes, join, result.problems)) {
    if (const auto circle = circle_of(loop, join))
      result.outline.holes.emplace_back(*circle);
    else
      result.outline.holes.emplace_back(polygon_of(loop, {}, chord, result.off));
  }
  if (outlines.size() == 1) {
    const auto& loop = outlines.front();
    const auto rectangle = rectangle_of(loop, layer_key(layers.outline), join);
    result.outline.outer = rectangle ? *rectangle : polygon_of(loop, layers, chord, result.off);
    if (result.problems.empty()) check_shape(result, layers, result.problems);
  }
  std::erase_if(pieces, [&](const DrawnPiece& piece) { return piece.layer != layer_key(layers.cracks); });
  for (const auto& chain : Joiner(std::move(pieces), join).chains()) {
    auto& crack = result.cracks.emplace_back(chain.pieces.front().points);
    for (std::size_t i = 1; i < chain.pieces.size(); ++i)
      crack.insert(crack.end(), chain.pieces[i].points.begin() + 1, chain.pieces[i].points.end());
  }
  if (result.off > 0 && result.problems.empty() && outlines.size() == 1) put_onto_chords(result, join);
  return result;
}

std::optional<std::pair<double, std::string>> metres_of(int unit) {
  static const std::map<int, std::pair<double, std::string>> units{{1, {0.0254, "inches"}},
                                                                   {2, {0.3048, "feet"}},
                                                                   {4, {1e-3, "mm"}},
                                                                   {5, {1e-2, "cm"}},
                                                                   {6, {1, "m"}},
                                                                   {7, {1e3, "km"}},
                                                                   {8, {2.54e-8, "microinches"}},
                                                                   {9, {2.54e-5, "mils"}},
                                                                   {10, {0.9144, "yards"}},
                                                                   {13, {1e-6, "micrometres"}},
                                                                   {14, {0.1, "dm"}}};
  const auto found = units.find(unit);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace cases
