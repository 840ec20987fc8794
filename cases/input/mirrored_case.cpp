#include "cases/input/mirrored_case.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "cases/input/case_file.hpp"
#include "cases/input/keys.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/problem.hpp"

namespace cases {
namespace {

using geometry::Point;
using geometry::Polyline;

/// The line of a symmetry edge that cracks lie on.
struct MirrorLine {
  Point at, along;
  std::string edge;
  std::vector<std::size_t> cracks;  // their numbers

  double side(const Point& x) const { return along.x() * (x.y() - at.y()) - along.y() * (x.x() - at.x()); }
  Point image(const Point& x) const {
    const Point left(-along.y(), along.x());
    Point result = x - 2 * side(x) * left;
    for (const int axis : {0, 1})  // exact about lines along the axes
      if (std::abs(left[axis]) == 0) result[axis] = x[axis];
    return result;
  }
};

std::set<std::string> symmetry_edges(const plate::Problem& content) {
  std::set<std::string> names;
  for (const auto& support : content.supports)
    if (support.kind == plate::SupportKind::symmetry) names.insert(support.edges.begin(), support.edges.end());
  return names;
}

std::optional<MirrorLine> mirror_line(const plate::Problem& content) {
  const auto names = symmetry_edges(content);
  const double near = geometry::tolerance(content.outline);
  for (const auto& edge : geometry::straight_edges(content.outline)) {
    if (!names.contains(edge.name) || edge.from == edge.to) continue;
    MirrorLine line{edge.from, (edge.to - edge.from).normalized(), edge.name, {}};
    for (std::size_t i = 0; i < content.cracks.size(); ++i) {
      const auto& crack = content.cracks[i];
      const auto on_edge = [&](const Point& x) {
        const double s = line.along.dot(x - line.at);
        return std::abs(line.side(x)) <= near && s >= -near && s <= (edge.to - edge.from).norm() + near;
      };
      if (crack.size() > 1 && std::ranges::all_of(crack, on_edge)) line.cracks.push_back(i);
    }
    if (!line.cracks.empty()) return line;
  }
  return std::nullopt;
}

/// Parts of a case that have no image here, by their keys.
std::vector<std::string> without_image(const Case& content) {
  std::vector<std::string> keys;
  const auto add = [&](bool present, const std::string& key) {
    if (present) keys.push_back(key);
  };
  const auto& s = content.section;
  add(s.orthotropic.has_value(), "section.orthotropic"), add(!s.plies.empty(), "section.plies");
  add(!s.regions.empty(), "section.regions"), add(s.thickness_factor.given(), "section.thickness_factor");
  add(s.young_factor.given(), "section.young_factor");
  add(!content.stiffeners.empty(), "stiffener"), add(!content.springs.empty(), "spring");
  add(bool(content.initial), "initial"), add(bool(content.impact), "impact");
  for (std::size_t i = 0; i < content.foundations.size(); ++i)
    add(bool(content.foundations[i].patch), fmt::format("foundation[{}].on", i));
  for (std::size_t i = 0; i < content.supports.size(); ++i)
    add(content.supports[i].edges.empty() || content.supports[i].kind == plate::SupportKind::hub,
        fmt::format("support[{}]", i));
  const auto symmetric = [](const plate::Load& load) {
    if (const auto* p = load.as<plate::Pressure>()) return p->uniform() && p->path.empty();
    if (const auto* m = load.as<plate::EdgeMoment>()) return m->twist == 0 && !m->tensor;
    if (const auto* n = load.as<plate::EdgeTraction>()) return n->shear == 0 && !n->tensor;
    if (const auto* t = load.as<plate::Temperature>()) return !t->formula.given() && !t->mean_formula.given();
    return load.as<plate::EdgeShear>() != nullptr;
  };
  for (std::size_t i = 0; i < content.loads.size(); ++i) add(!symmetric(content.loads[i]), key_of_load(content, i));
  return keys;
}

/// The ring without vertices between two pieces of one straight line and name.
geometry::Polygon without_needless(const geometry::Polygon& ring, double near) {
  geometry::Polygon result;
  const std::size_t n = ring.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point &before = ring.vertices[(i + n - 1) % n], &x = ring.vertices[i], &after = ring.vertices[(i + 1) % n];
    const Point chord = (after - before).normalized();
    const bool straight = std::abs(chord.x() * (x.y() - before.y()) - chord.y() * (x.x() - before.x())) <= near &&
                          (x - before).dot(after - x) > 0;
    if (straight && ring.edge_names[i] == ring.edge_names[(i + n - 1) % n]) continue;
    result.vertices.push_back(x), result.edge_names.push_back(ring.edge_names[i]);
  }
  return result;
}

/// The outline with its image, without the edges on the line; nothing where these are not one run of symmetry edges.
std::optional<geometry::Polygon> with_image(const geometry::Polygon& half, const MirrorLine& line,
                                            const std::set<std::string>& symmetric, double near) {
  const std::size_t n = half.vertices.size();
  const auto on_line = [&](std::size_t i) { return std::abs(line.side(half.vertices[i % n])) <= near; };
  std::size_t first = n, count = 0;  // the run: edges on the line
  for (std::size_t i = 0; i < n; ++i) {
    if (line.side(half.vertices[i]) < -near) return std::nullopt;
    if (!on_line(i) || !on_line(i + 1)) continue;
    if (!symmetric.contains(half.edge_names[i])) return std::nullopt;
    ++count;
    if (!on_line(i + n - 1)) {
      if (first != n) return std::nullopt;
      first = i;
    }
  }
  if (first == n || count + 2 > n) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i)  // it touches the line nowhere else
    if (on_line(i) && (i + n - first) % n > count) return std::nullopt;
  geometry::Polygon whole;
  const std::size_t begin = first + count, others = n - count;  // from the end of the run to its begin
  for (std::size_t k = 0; k < others; ++k)
    whole.vertices.push_back(half.vertices[(begin + k) % n]),
        whole.edge_names.push_back(half.edge_names[(begin + k) % n]);
  for (std::size_t k = others; k > 0; --k)
    whole.vertices.push_back(line.image(half.vertices[(begin + k) % n])),
        whole.edge_names.push_back(half.edge_names[(begin + k - 1) % n]);
  return without_needless(whole, near);
}

void add_images_of_holes(plate::Problem& content, const MirrorLine& line) {
  const std::size_t count = content.outline.holes.size();
  for (std::size_t i = 0; i < count; ++i) {
    auto hole = content.outline.holes[i];
    if (auto* circle = std::get_if<geometry::Circle>(&hole)) {
      circle->centre = line.image(circle->centre);
    } else {
      auto& polygon = std::get<geometry::Polygon>(hole);
      for (auto& x : polygon.vertices) x = line.image(x);
      std::ranges::reverse(polygon.vertices);
    }
    content.outline.holes.push_back(std::move(hole));
  }
  name_holes(content);
  const auto name_images = [&](std::vector<std::string>& edges) {
    const auto given = edges;
    for (std::size_t i = 0; i < count; ++i)
      if (std::ranges::find(given, fmt::format("hole{}", i)) != given.end())
        edges.push_back(fmt::format("hole{}", count + i));
  };
  for (auto& support : content.supports) name_images(support.edges);
  const auto of_load = [&](plate::Load& load) {
    std::visit(
        [&](auto& action) {
          if constexpr (requires { action.edges; }) name_images(action.edges);
        },
        load.action);
  };
  for (auto& load : content.loads) of_load(load);
  for (auto& one : content.load_cases) std::ranges::for_each(one.loads, of_load);
}

void add_images_of_cracks(plate::Problem& content, const MirrorLine& line) {
  const std::size_t count = content.cracks.size();
  for (std::size_t i = 0; i < count; ++i) {
    auto& crack = content.cracks[i];
    if (std::ranges::find(line.cracks, i) != line.cracks.end()) {
      for (auto& x : crack) x = (x + line.image(x)) / 2;
      continue;
    }
    Polyline image;
    for (const auto& x : crack) image.push_back(line.image(x));
    content.cracks.push_back(std::move(image));
  }
}

}  // namespace

void add_images(Case& content, Reading& reading) {
  if (!reading.sound("geometry") || !reading.sound("support") || content.outline.outer.vertices.size() < 3) return;
  for (int lines = 0; lines < 2; ++lines) {
    if (!geometry::errors(content.outline).empty()) return;
    const auto line = mirror_line(content);
    if (!line) return;
    const auto key = fmt::format("geometry.cracks[{}]", line->cracks.front());
    const double near = geometry::tolerance(content.outline);
    const auto whole = with_image(content.outline.outer, *line, symmetry_edges(content), near);
    auto lacking = without_image(content);
    if (!whole) {
      reading.report_error(key,
                           fmt::format("lies on the symmetry edge \"{}\", whose line meets the outline elsewhere or "
                                       "on another kind of edge: give the whole plate",
                                       line->edge));
      return;
    }
    if (!lacking.empty()) {
      reading.report_error(key, fmt::format("lies on the symmetry edge \"{}\", and these have no image beyond it here: "
                                            "{}; give the whole plate",
                                            line->edge, fmt::join(lacking, ", ")));
      return;
    }
    std::set<std::string> gone;
    for (const auto& name : content.outline.outer.edge_names)
      if (std::ranges::find(whole->edge_names, name) == whole->edge_names.end()) gone.insert(name);
    content.outline.outer = *whole;
    for (auto& support : content.supports)
      std::erase_if(support.edges, [&](const std::string& name) { return gone.contains(name); });
    std::erase_if(content.supports, [](const plate::Support& support) {
      return support.kind == plate::SupportKind::symmetry && support.edges.empty();
    });
    add_images_of_holes(content, *line);
    add_images_of_cracks(content, *line);
    reading.found().notes.push_back(fmt::format(
        "{} lies on the symmetry edge \"{}\": the plate is computed with its image, and forces and energies "
        "are those of both halves",
        key, line->edge));
  }
}

}  // namespace cases
