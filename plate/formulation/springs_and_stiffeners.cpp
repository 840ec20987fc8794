#include "plate/formulation/springs_and_stiffeners.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "geometry/cells/tessellation.hpp"
#include "plate/formulation/crack_springs.hpp"
#include "plate/formulation/foundations.hpp"
#include "plate/formulation/hubs.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/load_integration.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Point;

/// A place of a beam and what carries it: rotations as shares of those of points, the deflection with what the
/// rotations add to it in a plate without shear, w_i + (x - x_i) . psi_i / 2.
struct Node {
  Point at;
  std::vector<Share> shares;
  std::vector<Point> levers;  // half of the way from each point
};

using Sum = std::map<Dof, double>;  // factors of degrees of freedom

void add_deflection(const Node& node, double factor, Sum& form) {
  for (std::size_t i = 0; i < node.shares.size(); ++i) {
    const auto [k, share] = node.shares[i];
    form[dof(k, 0)] += factor * share;  // psi = (-theta_y, theta_x)
    form[dof(k, 1)] += factor * share * node.levers[i].y();
    form[dof(k, 2)] -= factor * share * node.levers[i].x();
  }
}

void add_slope(const Node& node, const Point& along, double factor, Sum& form) {
  for (const auto& [k, share] : node.shares) {
    form[dof(k, 1)] += factor * share * along.y();
    form[dof(k, 2)] -= factor * share * along.x();
  }
}

/// Stiffness EA of the axis at z = e by what slopes are of a law: of the fibre at z = 1, or of the middle plane, whose
/// strains are e kappa and epsilon of EA (epsilon + e kappa)^2.
double axial_by(PlateLaw law, const Stiffener& beam) {
  switch (law) {
    case PlateLaw::membrane:
      return beam.axial;
    case PlateLaw::coupling:
      return beam.axial * beam.eccentricity;
    case PlateLaw::bending:
      break;
  }
  return beam.axial * beam.eccentricity * beam.eccentricity;
}

/// Adds an element between two places: E A, E I and G J by the difference of the slopes, and the shear angle by what
/// makes it the cubic line of Hermite, one after the other with the beam's own shear.
void add_element(const Stiffener& beam, PlateLaw law, const Node& a, const Node& b, ElasticSupportSum& sum) {
  const Point way = b.at - a.at, along = way.normalized(), across(-along.y(), along.x());
  const double length = way.norm();
  const auto add = [&](double stiffness, const std::function<void(Sum&)>& fill) {
    if (stiffness == 0) return;
    Sum form;
    fill(form);
    std::vector<FormTerm> terms;
    for (const auto& [dof, factor] : form)
      if (factor != 0) terms.push_back({dof, factor});
    sum.add(stiffness, terms);
  };
  const auto difference = [&](const Point& direction) {
    return [&, direction](Sum& form) { add_slope(b, direction, 1, form), add_slope(a, direction, -1, form); };
  };
  if (const double axial = axial_by(law, beam); axial != 0) add(axial / length, difference(along));
  if (law != PlateLaw::bending) return;
  add(beam.bending / length, difference(along));
  add(beam.torsion / length, difference(across));
  const double cubic = 12 * beam.bending / (length * length);
  add(beam.bending > 0 ? (beam.shear ? cubic / (1 + cubic / *beam.shear) : cubic) * length : 0, [&](Sum& form) {
    add_deflection(b, 1 / length, form), add_deflection(a, -1 / length, form);
    add_slope(a, along, -0.5, form), add_slope(b, along, -0.5, form);
  });
}

Node point_node(std::uint32_t k, const geometry::Tessellation& cells) {
  return {cells.positions[k], {{k, 1}}, {Point(0, 0)}};
}

/// visit(a, b) for all elements of a beam.
void for_elements(const Stiffener& beam, const geometry::Tessellation& cells,
                  const std::function<void(const Node&, const Node&)>& visit) {
  for (const auto& border : cells.borders) {
    if (border.edge == geometry::Curves::crack) continue;
    if (std::ranges::find(beam.edges, cells.names[std::size_t(border.edge)]) == beam.edges.end()) continue;
    visit(point_node(border.from, cells), point_node(border.to, cells));
  }
  if (beam.along.empty()) return;
  const geometry::CellLocator locate(cells);
  const auto node_at = [&](const Point& x) {
    Node node{x, {}, {}};
    for (const auto& share : interpolation(locate, cells.units.spacing, x))
      if (std::abs(share.weight) > 1e-9)
        node.shares.push_back({share.point, share.weight}),
            node.levers.push_back((x - cells.positions[share.point]) / 2);
    return node;
  };
  for (std::size_t i = 0; i + 1 < beam.along.size(); ++i) {
    const Point &from = beam.along[i], way = beam.along[i + 1] - from;
    const int count = std::max(1, int(std::lround(way.norm() / cells.units.spacing)));
    std::optional<Node> last;
    for (int n = 0; n <= count; ++n) {
      const Point x = from + way * n / count;
      auto next = cells.sees(x) ? std::optional(node_at(x)) : std::nullopt;
      if (last && next) visit(*last, *next);
      last = std::move(next);
    }
  }
}

}  // namespace

void add_stiffener(const Stiffener& stiffener, PlateLaw law, const geometry::Tessellation& cells,
                   ElasticSupportSum& sum) {
  for_elements(stiffener, cells, [&](const Node& a, const Node& b) { add_element(stiffener, law, a, b, sum); });
}

std::vector<AxialElement> axial_elements(const Problem& problem, const geometry::Tessellation& cells,
                                         const PointMap& map) {
  std::vector<AxialElement> result;
  const auto terms_of = [](const Sum& form) {
    std::vector<FormTerm> terms;
    for (const auto& [dof, factor] : form)
      if (factor != 0) terms.push_back({dof, factor});
    return terms;
  };
  for (const auto& beam : problem.stiffeners) {
    if (!beam.stretches()) continue;
    const auto owned = [&](const Node& node) {
      return std::ranges::any_of(node.shares, [&](const Share& share) { return map.owns(share.point); });
    };
    for_elements(beam, cells, [&](const Node& a, const Node& b) {
      if (!owned(a) && !owned(b)) return;
      const Point way = b.at - a.at, along = way.normalized();
      Sum pull, rise;
      add_slope(b, along, -1, pull), add_slope(a, along, 1, pull);  // (u, v) = -psi of the plane
      add_deflection(b, 1, rise), add_deflection(a, -1, rise);
      result.push_back({beam.axial / way.norm(), beam.eccentricity, way.norm(), terms_of(pull), terms_of(rise)});
    });
  }
  return result;
}

std::vector<double> stiffener_masses(const Problem& problem, const geometry::Tessellation& cells, int power) {
  std::vector<double> result;
  for (const auto& beam : problem.stiffeners) {
    if (beam.mass <= 0) continue;
    const double mass = beam.mass * std::pow(beam.eccentricity, power);
    result.resize(cells.positions.size(), 0);
    for_elements(beam, cells, [&](const Node& a, const Node& b) {
      for (const auto* node : {&a, &b})
        for (const auto& [k, share] : node->shares) result[k] += mass * (b.at - a.at).norm() / 2 * share;
    });
  }
  return result;
}

ElasticSupports axial_forces_of(const Problem& problem, const geometry::Tessellation& cells, const PointMap& map,
                                const State& bending, const State& in_plane) {
  const auto elements = axial_elements(problem, cells, map);
  if (elements.empty()) return {};
  ElasticSupportSum sum(cells.positions.size());
  for (const auto& element : elements) {
    double longer = 0;
    for (const auto& [at, factor] : element.pull)
      longer += factor * (at_dof(in_plane, at) + element.eccentricity * at_dof(bending, at));
    sum.add(element.stiffness * longer / element.length, element.rise);
  }
  std::vector<ElasticSupport> parts;
  parts.push_back(std::move(sum).taken("axial force", std::nullopt, false));
  return ElasticSupports(std::move(parts));
}

namespace {

using Form = std::vector<FormTerm>;

/// A place of an edge or a line: its value as shares of the values of points, and what the rotations of the first of
/// them add to the deflection there.
struct Place {
  std::vector<std::pair<std::uint32_t, double>> shares;
  Point lever{0, 0};
};

Form deflection(const Place& at) {
  Form form;
  for (const auto& [k, share] : at.shares) form.push_back({dof(k, 0), share});
  const auto first = at.shares.front().first;
  form.push_back({dof(first, 1), at.lever.y()});
  form.push_back({dof(first, 2), -at.lever.x()});
  return form;
}

/// Linear form of the slope psi = (-theta_y, theta_x) along a direction.
Form slope(const Place& at, const Point& n) {
  Form form;
  for (const auto& [k, share] : at.shares) {
    form.push_back({dof(k, 1), share * n.y()});
    form.push_back({dof(k, 2), -share * n.x()});
  }
  return form;
}

/// A spring over a length of an edge or line with the unit normal n.
void add_piece(const Spring& spring, double length, const Place& at, const Point& n, ElasticSupportSum& sum) {
  if (spring.deflection > 0) sum.add(length * spring.deflection, deflection(at));
  if (spring.rotation_normal > 0) sum.add(length * spring.rotation_normal, slope(at, n));
  if (spring.rotation_tangential > 0) sum.add(length * spring.rotation_tangential, slope(at, {-n.y(), n.x()}));
}

void add_line(const Spring& spring, const std::vector<LinePiece>& pieces, const std::vector<Point>& positions,
              ElasticSupportSum& sum) {
  for (const auto& [k, middle, way] : pieces) {
    const Point n = Point(way.y(), -way.x()) / way.norm();
    add_piece(spring, way.norm(), {{{std::uint32_t(k), 1}}, middle - positions[k]}, n, sum);
  }
}

void add_point(const Spring& spring, const std::vector<Point>& positions, std::size_t count, ElasticSupportSum& sum) {
  const auto away = [&](const Point& x) { return (x - *spring.position).squaredNorm(); };
  const auto end = positions.begin() + std::ptrdiff_t(count);
  const auto k = std::uint32_t(std::ranges::min_element(positions.begin(), end, {}, away) - positions.begin());
  const Place at{{{k, 1}}, *spring.position - positions[k]};
  if (spring.deflection > 0) sum.add(spring.deflection, deflection(at));
  for (const Point& n : {Point(1, 0), Point(0, 1)})
    if (spring.rotation > 0) sum.add(spring.rotation, slope(at, n));
}

/// Portion of an edge that belongs to one of the points beside it: its length, and where its middle is.
struct EdgePortion {
  double length = 0;
  Point moment{0, 0}, normal{0, 0};  // integrals of the place and of the outward normal
};

/// Loads on an edge: forces beside any others, moments and nothing else.
struct EdgeLoads {
  bool shear = false, moments_alone = false;
};

EdgeLoads loads_on(const std::string& edge, const Problem& problem) {
  EdgeLoads result{false, !problem.loads.empty()};
  for (const auto& load : problem.loads) {
    const bool here = std::ranges::find(load.edges(), edge) != load.edges().end();
    result.shear |= here && load.as<EdgeShear>();
    result.moments_alone &= here && load.as<EdgeMoment>();
  }
  return result;
}

/// A spring and the strip of the plate between the edge and the point next to it, `away` wide, one after the other. A
/// force on the same edge acts at that point too and must not pass through the strip: then the spring alone; also under
/// moments, but for other loads the strip turns.
Spring behind(Spring spring, double away, const Section& section, const EdgeLoads& loads) {
  const auto soften = [&](double& stiffness, double of_plate) { stiffness /= 1 + stiffness * away / of_plate; };
  const double D = section.bending_stiffness();
  if (!loads.shear) soften(spring.deflection, section.shear_stiffness());
  if (loads.moments_alone) return spring;
  soften(spring.rotation_normal, D);
  soften(spring.rotation_tangential, D * (1 - section.poisson) / 2);
  return spring;
}

void add_edges(const Spring& spring, const Problem& problem, const geometry::Cloud& cloud, ElasticSupportSum& sum) {
  for (const auto& name : spring.edges) {
    const auto loads = loads_on(name, problem);
    for (const auto& border : edge_borders(name, cloud, problem.outline)) {
      std::map<std::uint32_t, EdgePortion> by_point;
      for (const auto& [middle, normal] : border.pieces) {
        auto& portion = by_point[nearest(border.near, cloud, middle)];
        portion.length += normal.norm(), portion.moment += normal.norm() * middle, portion.normal += normal;
      }
      for (const auto& [k, portion] : by_point) {
        const Point n = portion.normal.normalized(), lever = portion.moment / portion.length - cloud.positions[k];
        const double away = std::max(0.0, lever.dot(n));
        add_piece(behind(spring, away, problem.section, loads), portion.length, {{{k, 1}}, lever}, n, sum);
      }
    }
  }
}

/// Adds a spring along edges. Between the ends of a piece all is linear; two places of Gauss are exact for its square.
void add_edges(const Spring& spring, const geometry::Tessellation& cells, ElasticSupportSum& sum) {
  const double gauss = (1 - 1 / std::sqrt(3.0)) / 2;
  for (const auto& border : cells.borders) {
    if (border.edge == geometry::Curves::crack) continue;
    if (std::ranges::find(spring.edges, cells.names[std::size_t(border.edge)]) == spring.edges.end()) continue;
    const Point way = cells.positions[border.to] - cells.positions[border.from];
    for (const double at : {gauss, 1 - gauss})
      add_piece(spring, way.norm() / 2, {{{border.from, 1 - at}, {border.to, at}}},
                Point(way.y(), -way.x()) / way.norm(), sum);
  }
}

/// Springs between the faces of cracks.
ElasticSupport tied_faces(const Problem& problem, std::size_t number, const std::vector<FacePair>& faces,
                          std::size_t points) {
  ElasticSupportSum sum(points);
  for (const auto& one : crack_springs(problem, number, faces)) one.add(problem.section.law, sum);
  auto result = std::move(sum).taken(fmt::format("spring{}", number), std::nullopt, false);
  const auto& spring = problem.springs[number];
  const bool bends = problem.section.law == PlateLaw::bending;
  // faces that stay together along a line do not twist against each other either
  result.joins = spring.depth.given() || (bends ? spring.deflection > 0 && spring.rotation_normal > 0
                                                : spring.opening > 0 && spring.sliding > 0);
  return result;
}

/// `hubs`: those of the supports, none in the plane; `faces`: of the cracks; `found(foundation, sum)`,
/// `hold(spring, sum)`, `stiffen(stiffener, sum)`: what they add.
template <typename Found, typename Hold, typename Stiffen>
ElasticSupports all(const Problem& problem, const std::vector<Point>& positions, const std::vector<Hub>& hubs,
                    const std::vector<FacePair>& faces, const Found& found, const Hold& hold, const Stiffen& stiffen) {
  const auto points = positions.size();
  const auto holders = hubs.empty() ? std::vector<Holder>() : holders_of(problem.supports);
  std::vector<ElasticSupport> parts;
  for (std::size_t i = 0; i < problem.foundations.size(); ++i) {
    ElasticSupportSum sum(points);
    found(problem.foundations[i], sum);
    parts.push_back(std::move(sum).taken(fmt::format("foundation{}", i), std::nullopt));
  }
  for (std::size_t i = 0; i < problem.springs.size(); ++i) {
    if (!problem.springs[i].cracks.empty()) {
      parts.push_back(tied_faces(problem, i, faces, points));
      continue;
    }
    ElasticSupportSum sum(points);
    hold(problem.springs[i], sum);
    parts.push_back(std::move(sum).taken(fmt::format("spring{}", i), problem.springs[i].position));
  }
  for (const auto& hub : hubs) {
    ElasticSupportSum sum(points);
    const auto& support = problem.supports[holders[hub.holder].support];
    if (add_hub(hub, support, positions, sum))
      parts.push_back(std::move(sum).taken(holders[hub.holder].name, hub.centre));
  }
  for (std::size_t i = 0; i < problem.stiffeners.size(); ++i) {
    ElasticSupportSum sum(points);
    stiffen(problem.stiffeners[i], sum);
    parts.push_back(std::move(sum).taken(fmt::format("stiffener{}", i), std::nullopt, false));
  }
  return ElasticSupports(std::move(parts));
}

}  // namespace

ElasticSupports elastic_supports_of(const Problem& problem, const geometry::Cloud& cloud,
                                    const std::vector<FacePair>& faces) {
  const bool bends = problem.section.law == PlateLaw::bending;
  const auto hubs = bends ? hubs_of(problem.supports, cloud) : std::vector<Hub>();
  return all(
      problem, cloud.positions, hubs, faces,
      [&](const Foundation& one, ElasticSupportSum& sum) { add_foundation(one, cloud, sum); },
      [&](const Spring& one, ElasticSupportSum& sum) {
        add_edges(one, problem, cloud, sum);
        if (!one.along.empty())
          add_line(one, line_pieces(one.along, cloud, crack_paths(problem)), cloud.positions, sum);
        if (one.position && cloud.seeded(*one.position)) add_point(one, cloud.positions, cloud.plate_points, sum);
      },
      [](const Stiffener&, ElasticSupportSum&) {});  // refused before
}

ElasticSupports elastic_supports_of(const Problem& problem, const geometry::Tessellation& cells) {
  const auto points = cells.positions.size();
  const bool bends = problem.section.law == PlateLaw::bending;
  const auto outline = geometry::to_lattice(problem.outline, cells.units);
  return all(
      problem, cells.positions, bends ? hubs_of(problem.supports, outline, cells) : std::vector<Hub>(),
      problem.ties_faces() ? facing_points(cells) : std::vector<FacePair>(),
      [&](const Foundation& one, ElasticSupportSum& sum) { add_foundation(one, cells, sum); },
      [&](const Spring& one, ElasticSupportSum& sum) {
        add_edges(one, cells, sum);
        if (!one.along.empty()) add_line(one, line_pieces(one.along, cells), cells.positions, sum);
        if (one.position && cells.sees(*one.position)) add_point(one, cells.positions, points, sum);
      },
      [&](const Stiffener& one, ElasticSupportSum& sum) { add_stiffener(one, problem.section.law, cells, sum); });
}

}  // namespace plate
