#include "post/report/probes_and_lines.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/crack_springs.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/problem_validation.hpp"
#include "plate/model/reduction.hpp"
#include "post/files/frame.hpp"

namespace post {

std::vector<plate::PlaceShare> place_in_frames(const plate::Formulation& plate, const geometry::Point& at) {
  const auto& [units, positions, areas, plate_points, part] = plate.cloud();
  auto result = plate.interpolation(at);
  const auto beyond = [&](const plate::PlaceShare& share) { return share.point >= plate_points; };
  if (std::ranges::none_of(result, beyond)) return result;
  return plate::visible_place(at, units, plate.boundary().lattice, plate_points,
                              geometry::to_lattice(plate.paths(), units));
}

std::vector<ProbeValue> values_at(const std::vector<Probe>& probes, const Frame& frame,
                                  const plate::Formulation& plate) {
  const auto& boundary = plate.boundary();
  const bool forces_known = !plate.distributed() || !plate.offers(plate::Feature::horizon);
  static const std::array<const char*, 5> forces{"Mxx", "Myy", "Mxy", "Qx", "Qy"};
  std::vector<ProbeValue> result;
  for (const auto& [name, x, shares] : probes) {
    const auto mean = [&](const auto& values, Eigen::Index row) {  // one process has the place
      double sum = 0;
      for (const auto& share : shares) sum += share.weight * values(row, share.point);
      return plate::sum_of_all(boundary.map, sum);
    };
    const auto add = [&](const std::string& quantity, double value) { result.push_back({name, quantity, x, value}); };
    plate::PointValues u = plate::value_at(shares, frame.state);
    for (double& component : u) component = plate::sum_of_all(boundary.map, component);
    add("w", u[0]), add("theta_x", u[1]), add("theta_y", u[2]);
    if (frame.in_plane)
      add("u", mean(frame.in_plane->displacement, 0)), add("v", mean(frame.in_plane->displacement, 1));
    if (!forces_known) continue;
    for (Eigen::Index i = 0; i < 3; ++i) add(forces[std::size_t(i)], mean(frame.resultants.moments, i));
    for (Eigen::Index i = 0; i < 2; ++i) add(forces[std::size_t(3 + i)], mean(frame.resultants.shear, i));
    if (frame.in_plane)
      for (Eigen::Index i = 0; i < 3; ++i)
        add(std::string("N") + &forces[std::size_t(i)][1], mean(frame.in_plane->force, i));
    const auto& resultants = frame.resultants;
    add("von_mises", mean(resultants.von_mises.transpose(), 0));
    const auto add_principal = [&](const std::string& face, const Eigen::Vector3d& stress) {
      const auto [largest, smallest, angle] = plate::principal(stress);
      add("sigma1_" + face, largest), add("sigma2_" + face, smallest), add("angle_" + face, angle);
    };
    const auto at = [&](const Eigen::Matrix3Xd& stress) {
      return Eigen::Vector3d(mean(stress, 0), mean(stress, 1), mean(stress, 2));
    };
    const Eigen::Vector3d top = at(resultants.top);
    add_principal("top", top), add_principal("bottom", resultants.bottom.cols() > 0 ? at(resultants.bottom) : -top);
  }
  return result;
}

namespace {

/// Shares of the way from one point to another at which it meets an edge of a ring.
void add_meetings(const std::vector<geometry::Point>& ring, const geometry::Point& from, const geometry::Point& way,
                  std::vector<double>& meetings) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const geometry::Point a = ring[i], edge = ring[(i + 1) % ring.size()] - a;
    const double turn = way.x() * edge.y() - way.y() * edge.x();
    if (turn == 0) continue;
    const geometry::Point apart = a - from;
    const double along_edge = (apart.x() * way.y() - apart.y() * way.x()) / turn;
    if (along_edge >= 0 && along_edge <= 1) meetings.push_back((apart.x() * edge.y() - apart.y() * edge.x()) / turn);
  }
}

/// Likewise of a circle.
void add_meetings(const geometry::Circle& circle, const geometry::Point& from, const geometry::Point& way,
                  std::vector<double>& meetings) {
  const geometry::Point apart = from - circle.centre;
  const double half = apart.dot(way) / way.squaredNorm(),
               under = half * half - (apart.squaredNorm() - circle.radius * circle.radius) / way.squaredNorm();
  if (under > 0) meetings.insert(meetings.end(), {-half - std::sqrt(under), -half + std::sqrt(under)});
}

/// Shares of a way between which it runs within the plate.
std::vector<std::array<double, 2>> pieces_within(const geometry::Outline& outline, const geometry::Point& from,
                                                 const geometry::Point& way) {
  std::vector<double> meetings{0, 1};
  add_meetings(outline.outer.vertices, from, way, meetings);
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole))
      add_meetings(*circle, from, way, meetings);
    else
      add_meetings(std::get<geometry::Polygon>(hole).vertices, from, way, meetings);
  std::erase_if(meetings, [](double t) { return t < 0 || t > 1; });
  std::ranges::sort(meetings);
  std::vector<std::array<double, 2>> result;
  constexpr double nothing = 1e-9;
  for (std::size_t i = 1; i < meetings.size(); ++i) {
    const double a = meetings[i - 1], b = meetings[i];
    if (b - a > nothing && plate::on_plate(outline, from + (a + b) / 2 * way)) result.push_back({a, b});
  }
  return result;
}

}  // namespace

SampledLine sampled_line(const std::string& name, const geometry::Point& from, const geometry::Point& to,
                         const plate::Formulation& plate) {
  constexpr double pieces = 100;
  SampledLine result{name, from, to, {}, {}, {}};
  const geometry::Point way = to - from;
  double last = -1;
  for (const auto& [a, b] : pieces_within(plate.problem().outline, from, way)) {
    const int count = std::max(2, int(std::round(pieces * (b - a))));
    for (int n = a == last ? 1 : 0; n <= count; ++n) {
      const double t = a + (b - a) * n / count;
      const geometry::Point x = from + t * way;
      result.places.push_back({name, x, plate.here(x) ? place_in_frames(plate, x) : std::vector<plate::PlaceShare>{}});
      result.along.push_back(t * way.norm()), result.joined.push_back(n > 0);
    }
    last = b;
  }
  return result;
}

void add_rows(Table& table, double time, const SampledLine& line, const std::vector<ProbeValue>& values) {
  if (line.places.empty()) return;
  const auto each = values.size() / line.places.size();
  if (table.columns.empty()) {
    table.columns = {"time", "line", "s", "x", "y"};
    for (std::size_t q = 0; q < each; ++q) table.columns.push_back(values[q].quantity);
  }
  for (std::size_t i = 0; i < line.places.size(); ++i) {
    const auto& x = line.places[i].position;
    table.rows.push_back({time, line.name, line.along[i], x.x(), x.y()});
    for (std::size_t q = 0; q < each; ++q) table.rows.back().emplace_back(values[i * each + q].value);
  }
}

std::vector<ProbeValue> sums_along(const SampledLine& line, const std::vector<ProbeValue>& values) {
  const auto count = line.places.size();
  if (count == 0) return {};
  if (std::ranges::find(values, "Mxx", &ProbeValue::quantity) == values.end()) return {};
  const auto each = values.size() / count;
  const geometry::Point way = (line.to - line.from).normalized(), n(way.y(), -way.x()), s = way;
  const auto at = [&](std::size_t i, const char* quantity) {
    const auto begin = values.begin() + std::ptrdiff_t(i * each), end = begin + std::ptrdiff_t(each);
    return std::find_if(begin, end, [&](const ProbeValue& one) { return one.quantity == quantity; })->value;
  };
  const auto tensor = [&](std::size_t i, const std::array<const char*, 3>& names, const geometry::Point& other) {
    Eigen::Matrix2d T;
    T << at(i, names[0]), at(i, names[2]), at(i, names[2]), at(i, names[1]);
    return n.dot(T * other);
  };
  const auto sum = [&](const auto& value) {
    double result = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (line.joined[i]) result += (line.along[i] - line.along[i - 1]) * (value(i) + value(i - 1)) / 2;
    return result;
  };
  std::vector<ProbeValue> result;
  const auto add = [&](const char* quantity, const auto& value) {
    result.push_back({line.name, quantity, (line.from + line.to) / 2, sum(value)});
  };
  constexpr std::array M{"Mxx", "Myy", "Mxy"}, N{"Nxx", "Nyy", "Nxy"};
  add("moment", [&](std::size_t i) { return tensor(i, M, n); });
  add("twist", [&](std::size_t i) { return tensor(i, M, s); });
  add("shear", [&](std::size_t i) { return n.dot(geometry::Point(at(i, "Qx"), at(i, "Qy"))); });
  if (std::ranges::find(values, "Nxx", &ProbeValue::quantity) == values.end()) return result;
  add("normal_force", [&](std::size_t i) { return tensor(i, N, n); });
  add("tangential_force", [&](std::size_t i) { return tensor(i, N, s); });
  return result;
}

SpringsOnCracks::SpringsOnCracks(const plate::Formulation& plate) {
  const auto& problem = plate.problem();
  if (!problem.ties_faces()) return;
  const auto pairs = plate.face_pairs();
  for (std::size_t i = 0; i < problem.springs.size(); ++i)
    springs_.push_back(problem.springs[i].cracks.empty() ? std::vector<plate::CrackSpring>()
                                                         : plate::crack_springs(problem, i, pairs));
}

std::vector<ProbeValue> SpringsOnCracks::take(const Frame& frame, Table& table) const {
  using Carried = plate::CarriedAcross;
  static const std::array<std::pair<const char*, double Carried::*>, 5> sums{
      {{"moment", &Carried::moment},
       {"twist", &Carried::twist},
       {"shear", &Carried::shear},
       {"normal_force", &Carried::normal_force},
       {"tangential_force", &Carried::tangential_force}}};
  plate::State in_plane = plate::no_state();
  if (frame.in_plane) {
    in_plane = plate::zero_like(frame.state);
    const auto& u = frame.in_plane->displacement;
    in_plane.row(1).head(u.cols()) = -u.row(1), in_plane.row(2).head(u.cols()) = u.row(0);
  }
  if (table.columns.empty()) {
    table.columns = {"time", "spring", "x", "y", "rotation", "deflection"};
    for (const auto& [name, member] : sums) table.columns.emplace_back(name);
    table.columns.emplace_back("K_front");
  }
  std::vector<ProbeValue> result;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    if (springs_[i].empty()) continue;
    const auto name = fmt::format("spring{}", i);
    Carried total;
    ProbeValue front{name, "K_front", {0, 0}};
    for (const auto& spring : springs_[i]) {
      const auto own = spring.carried(frame.state, in_plane);
      const auto& x = spring.pair.position;
      auto& row =
          table.rows.emplace_back(std::vector<Cell>{frame.time, name, x.x(), x.y(), own.rotation, own.deflection});
      for (const auto& [quantity, member] : sums) {
        total.*member += spring.pair.length * (own.*member);
        row.emplace_back(own.*member);
      }
      row.push_back(cell(own.front_factor));
      if (own.front_factor && *own.front_factor > front.value) front.value = *own.front_factor, front.position = x;
    }
    const auto& middle = springs_[i][springs_[i].size() / 2].pair.position;
    for (const auto& [quantity, member] : sums)
      if (total.*member != 0) result.push_back({name, quantity, middle, total.*member});
    if (springs_[i].front().part) result.push_back(front);
  }
  return result;
}

}  // namespace post
