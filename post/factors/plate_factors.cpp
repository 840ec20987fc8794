#include "post/factors/plate_factors.hpp"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "geometry/shape/patch.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/crack_springs.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/crack_contact.hpp"
#include "plate/solve/stretching.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/tip_integrals.hpp"
#include "post/factors/tip_place.hpp"

namespace post {
namespace {

/// Factors of one tip that are not resolved, or uncertain, and the largest of their errors.
struct Doubt {
  std::vector<std::string> names = {};
  double share = 0;  // of the largest factor

  void add(const std::string& name, double error) { names.push_back(name), share = std::max(share, error); }
  std::string words(const char* what) const {
    if (names.empty()) return "";
    return fmt::format("{} {} ({})", fmt::join(names, ", "), what,
                       share >= 1 ? "> 100 %" : fmt::format("{:.2g} %", 100 * share));
  }
};

/// Distance to a part of the plate [length]; 0 within it.
double distance_to(const geometry::Hole& part, const geometry::Point& x) {
  auto ring = geometry::Patch(part).ring();
  if (geometry::contains({{ring, std::vector<std::string>(ring.size())}, {}}, x)) return 0;
  ring.push_back(ring.front());
  return geometry::distance(ring, x);
}

/// Length over which elastic foundations and springs between faces press back, in proportion to what the fields of a
/// fit do not have: the shortest of all sqrt(D / G_p) and (D / k)^(1/4), of springs D / 2k and S / 2k [length].
double reach_of_elastic_supports(const plate::Problem& c) {
  double result = INFINITY;
  const double stiffness = c.section.bending_stiffness();
  for (const auto& foundation : c.foundations) {
    if (foundation.modulus > 0) result = std::min(result, std::pow(stiffness / foundation.modulus, 0.25));
    if (foundation.shear > 0) result = std::min(result, std::sqrt(stiffness / foundation.shear));
  }
  const bool bends = c.section.law == plate::PlateLaw::bending;
  for (const auto& spring : c.springs) {
    if (spring.cracks.empty()) continue;
    const double turns =
        bends ? std::max(spring.rotation_normal, spring.rotation_tangential) : std::max(spring.opening, spring.sliding);
    if (turns > 0) result = std::min(result, stiffness / (2 * turns));
    if (bends && spring.deflection > 0)
      result = std::min(result, c.section.shear_stiffness() / (2 * spring.deflection));
  }
  return result;
}

/// True where the methods follow a crack that is a curve: the fields about its tip are known for isotropic sections.
bool follows_curves(const plate::Problem& c) {
  return c.section.isotropic();
}

/// Distance from a tip to the next point force, line load, pin, spring, stiffener or support inside [length].
double undisturbed_distance(const plate::Problem& c, const geometry::Tip& tip) {
  double result = INFINITY;
  const auto take = [&](const geometry::Point& x) { result = std::min(result, (x - tip.position).norm()); };
  const auto take_line = [&](const geometry::Polyline& along) {
    if (!along.empty()) result = std::min(result, geometry::distance(along, tip.position));
  };
  for (const auto& load : c.loads) {
    if (const auto x = load.point()) take(*x);
    take_line(load.line());
  }
  for (const auto& spring : c.springs) {
    if (spring.position) take(*spring.position);
    take_line(spring.along);
  }
  for (const auto& stiffener : c.stiffeners) take_line(stiffener.along);
  if (c.impact) take(c.impact->position);
  for (const auto& support : c.supports) {
    for (const auto& point : support.points) take(point);
    take_line(support.along);
    if (support.patch) result = std::min(result, distance_to(*support.patch, tip.position));
  }
  return result;
}

}  // namespace

double clear_distance(const plate::Problem& c, const std::vector<geometry::CrackPath>& paths,
                      const geometry::Tip& tip) {
  const double spacing = c.discretization.spacing_at_tips();
  const double clear =
      std::min(clear_distance(c.outline, paths, tip, spacing, follows_curves(c)), undisturbed_distance(c, tip));
  // families next to where the section changes have some of both
  return std::min(clear, std::max(0.0, c.section.uniform_within(tip.position) - spacing));
}

namespace {

/// Surroundings of a tip, of which points within `reach` are known.
TipPlace place_of(const plate::Problem& c, const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip,
                  double reach) {
  const auto& d = c.discretization;
  const double clear = std::min(reach, clear_distance(c, paths, tip));
  const double faces = std::min(d.spacing, d.spacing_at_tips() + d.spacing_growth * clear);
  const bool heated = std::ranges::any_of(
      c.loads, [](const plate::Load& load) { return load.as<plate::Temperature>() && load.formula().given(); });
  const double undisturbed = std::min(undisturbed_distance(c, tip), 2 * reach_of_elastic_supports(c));
  const auto frame = frame_of(paths[tip.crack], tip, d.spacing_at_tips(), follows_curves(c));
  return {.tip = {tip.position, frame.ahead, tip.crack, tip.at_back},
          .path = paths[tip.crack],
          .clear = clear,
          .narrowest = clear,
          .undisturbed = undisturbed,
          .faces = faces,
          .heated = heated,
          .tied = std::ranges::any_of(c.foundations,
                                      [&](const auto& foundation) {
                                        return foundation.shear > 0 &&
                                               (!foundation.patch || distance_to(*foundation.patch, tip.position) == 0);
                                      }),
          .frame = frame};
}

}  // namespace

double least_clear_distance(const plate::Problem& c, const std::vector<geometry::CrackPath>& paths,
                            const std::vector<geometry::Tip>& tips) {
  double result = INFINITY;
  for (const auto& tip : tips) result = std::min(result, clear_distance(c, paths, tip));
  return result;
}

double widest_ring(const plate::Problem& c, double wider) {
  constexpr double widest = 24;
  const auto paths = plate::crack_paths(c);
  const auto tips = geometry::tips(paths);
  if (tips.empty()) return 0;
  if (c.discretization.tip_spacing) return widest;
  return std::min(widest, least_clear_distance(c, paths, tips) / (wider * c.discretization.spacing));
}

std::optional<double> tip_spacing_for(const plate::Problem& problem) {
  constexpr double far = 24;  // spacings: enough for the points of a lattice, as `thick` is
  const double thick = problem.faces_touch() ? 48 : 12;
  const double of_layer = problem.faces_touch() ? 1.0 / 24 : 1.0 / 6;
  constexpr double of_clear = 1.0 / 32;
  constexpr double least = 1.0 / 256;  // of the spacing
  plate::Problem fine = problem;       // bends count, however slight
  const double spacing = problem.discretization.spacing;
  fine.discretization.tip_spacing = 1e-6 * spacing;
  const auto paths = plate::crack_paths(fine);
  const auto tips = geometry::tips(paths);
  if (tips.empty()) return std::nullopt;
  const double clear = std::min(least_clear_distance(fine, paths, tips), reach_of_elastic_supports(problem));
  double result = spacing;
  if (problem.section.thickness < thick * spacing) result = std::min(result, of_layer * problem.section.layer());
  if (clear < far * spacing) result = std::min(result, of_clear * clear);
  return result < spacing ? std::optional(std::max(result, least * spacing)) : std::nullopt;
}

bool ringed(const plate::Problem& c, const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip) {
  const double spacing = c.discretization.spacing_at_tips();
  return !rings(clear_distance(c, paths, tip), spacing, false).empty();
}

namespace {

/// Every process tells the others what works at its tips: '+', or '-' where none does, or nothing of a tip that is not
/// its own, then a line for every method that is left out; tips end with a page break.
void tell(const plate::Formulation& plate, std::vector<TipMethods>& methods) {
  std::string own;
  for (const auto& tip : methods) {
    if (tip.here() || !tip.left_out().empty()) own += tip.works() ? '+' : '-';
    for (const auto& line : tip.left_out()) own += line + '\n';
    own += '\f';
  }
  for (const auto& theirs : plate::texts_of_all(plate, own)) {
    std::istringstream tips(theirs);
    std::string tip, line;
    for (auto& one : methods) {
      std::getline(tips, tip, '\f');
      if (tip.empty() || one.here()) continue;
      std::istringstream lines(tip.substr(1));
      std::vector<std::string> left_out;
      while (std::getline(lines, line)) left_out.push_back(line);
      one = TipMethods(tip.front() == '+', std::move(left_out));
    }
  }
}

/// Discretisation error of the whole plate, as a share of the largest factor: of the second order in its spacing over
/// its smaller side.
double error_of_coarseness(const plate::Problem& problem) {
  constexpr double share = 2;
  const auto [low, high] = geometry::bounding_box(problem.outline);
  return share * std::pow(problem.discretization.spacing / (high - low).minCoeff(), 2);
}

}  // namespace

std::vector<TipMethods> tip_methods(const plate::Formulation& plate, const SrifOptions& options) {
  // of edges, measured: 91 % of the errors are within the estimates then; of plates few points wide
  const double known = 0.75 * plate.error_of_edges() + error_of_coarseness(plate.problem());
  const double narrowest = least_clear_distance(plate.problem(), plate.paths(), plate.tips());
  std::vector<TipMethods> result;
  std::shared_ptr<const TipView> view;
  for (const auto& tip : plate.tips()) {
    if (!plate.here(tip.position)) {
      result.emplace_back(false, std::vector<std::string>{});
      continue;
    }
    if (plate::part_through_at(plate.problem(), tip.position)) {
      result.emplace_back(
          false, std::vector<std::string>{
                     "its crack has a depth, and K_front in crack_springs.csv; remove [srif] if all cracks do"});
      continue;
    }
    if (!view) view = plate.tip_view();
    auto place = place_of(plate.problem(), plate.paths(), tip, INFINITY);
    place.narrowest = narrowest, place.known_error = known;
    result.emplace_back(view, place, options);
  }
  tell(plate, result);
  return result;
}

std::optional<TipMethods> tip_methods(std::shared_ptr<const TipView> view, const plate::Problem& problem,
                                      const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip,
                                      const SrifOptions& options, double reach) {
  TipMethods result(std::move(view), place_of(problem, paths, tip, reach), options);
  return result.works() ? std::optional(std::move(result)) : std::nullopt;
}

namespace {

/// kappa_0 about a tip, the mean of the points next to it.
double curvature_at(const geometry::Point& tip, const plate::Formulation& plate, const plate::Heat& heat) {
  const auto& cloud = plate.cloud();
  const double near = 2 * plate.discretization().spacing_at_tips();
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < cloud.plate_points; ++k)
    if ((cloud.positions[k] - tip).norm() < near) sum += heat.curvature[Eigen::Index(k)], ++count;
  return count > 0 ? sum / count : 0;
}

/// Factors of a tip of a heated plate. The free curvature about the tip is subtracted first: the remaining field has
/// the actual moments, and no method needs to account for uniform heating. `stretch`: of a plate in its plane.
std::vector<Srif> of_heated(const plate::Formulation& plate, const TipMethods& methods, const geometry::Tip& tip,
                            const plate::State& state, const plate::Forces& force, const plate::Heat& heat,
                            bool all_rings, const Eigen::VectorXd* on_faces, const plate::Stretch* stretch) {
  const bool uniform = heat.curvature.minCoeff() == heat.curvature.maxCoeff();
  const double there = uniform ? heat.curvature[0] : curvature_at(tip.position, plate, heat);
  const auto& positions = plate.cloud().positions;
  if (heat.linear && heat.linear->varies() && !stretch)
    return methods(state - plate::free_field(positions, tip.position, *heat.linear), force, all_rings,
                   {nullptr, on_faces});
  const auto cold = plate::cold(state, positions, tip.position, there);
  const Eigen::VectorXd varying = heat.curvature.array() - there;
  Eigen::Matrix3Xd free = -Eigen::Vector3d(1, 1, 0) * varying.transpose();
  if (stretch) free += stretch->strains;
  return methods(cold, force, all_rings, {uniform && !stretch ? nullptr : &free, on_faces});
}

/// Forces on points of a state beside those of elastic supports: internal, on all that constraints hold too.
plate::Forces forces_on(const plate::Formulation& plate, const plate::State& state) {
  plate::Forces force;
  plate.internal_force(state, force), plate.boundary().elastic_supports.take_force(state, force);
  return force;
}

/// Factor of the products of pairs, by which forces on their points follow from those that press the pairs apart: the
/// same for all jumps of a straight crack.
Eigen::LDLT<Eigen::MatrixXd> products_of(const plate::Formulation& plate,
                                         const std::vector<std::pair<double, plate::FacePair>>& pairs) {
  struct Row {
    Eigen::Index pair;
    geometry::Point share;
  };
  std::map<std::uint32_t, std::vector<Row>> at;  // by points
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& pair = pairs[i].second;
    for (const auto& [point, weight] : pair.left) at[point].push_back({Eigen::Index(i), weight * pair.normal});
    for (const auto& [point, weight] : pair.right) at[point].push_back({Eigen::Index(i), -weight * pair.normal});
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Eigen::Index(pairs.size()), Eigen::Index(pairs.size()));
  for (const auto& [point, rows] : at)
    for (const auto& one : rows)
      for (const auto& other : rows) result(one.pair, other.pair) += one.share.dot(other.share);
  return plate::sum_of_ranks(plate, result).ldlt();
}

/// Pairs of places behind a tip on the straight part of its crack, or as far as that follows a circle, the nearest
/// first. Springs resist all jumps; faces that touch press on their opening alone. Collective: every rank must call
/// each member function.
class FacesBehind {
public:
  FacesBehind(const plate::Formulation& plate, const std::vector<plate::FacePair>& pairs, const TipFrame& frame)
      : plate_(plate) {
    if (plate.problem().ties_faces()) acts_.setOnes();
    const double spacing = plate.discretization().spacing_at_tips();
    const double unbent = frame.curve.empty() ? 0 : unbent_length(frame, spacing);
    for (const auto& pair : pairs) {
      const geometry::Point x = frame.beside(pair.position);
      const double behind = -x.x();
      const bool on_crack =
          frame.curve.empty() ? behind > (1 - 1e-6) * x.norm() : behind < unbent && std::abs(x.y()) < 1e-3 * spacing;
      if (behind > 0 && on_crack) pairs_.push_back({behind, pair.seen_from(frame.left())});
    }
    std::ranges::sort(pairs_, {}, &std::pair<double, plate::FacePair>::first);
    if (!pairs_.empty()) products_ = products_of(plate, pairs_);
  }

  /// Force that presses the faces apart at the tip, along the crack: by the line that fits the forces of the nearest
  /// pairs best, all within `near` and two at least [force/length]; of a plate that bends couples.
  double pressure(const plate::Forces& force, double near) const {
    Eigen::Matrix2d sums = Eigen::Matrix2d::Zero();
    Eigen::Vector2d forces = Eigen::Vector2d::Zero();
    const auto pressing = this->pressing(force);
    for (std::size_t i = 0; i < pairs_.size() && (i < 2 || pairs_[i].first <= near); ++i) {
      const auto& [behind, pair] = pairs_[i];
      const Eigen::Vector2d line(1, behind);
      sums += pair.length * line * line.transpose();
      forces += line * pressing(Eigen::Index(i), opening);
    }
    return pairs_.empty() ? 0 : sums.completeOrthogonalDecomposition().solve(forces)[0];
  }

  /// Takes the forces that part the faces away. Returns the work that they do per length by which the tip moves on,
  /// minus, at every point [force]: a difference of jumps, as gradients at the points are means over the field
  /// about them.
  Eigen::VectorXd take(const plate::State& state, plate::Forces& force) const {
    plate::Forces works = plate::zero_like(force);  // in the first row
    const Eigen::MatrixX3d pressing = this->pressing(force), jumps = this->jumps(state);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto& pair = pairs_[i].second;
      const Eigen::Vector3d own = pressing.row(Eigen::Index(i)).transpose();
      pair.press(own, force);
      if (i + 1 == pairs_.size()) continue;  // the mouth, or the other tip: far outside of rings
      const double before = i == 0 ? 0 : pairs_[i - 1].first, after = pairs_[i + 1].first;
      const Eigen::RowVector3d less = i == 0 ? Eigen::RowVector3d(0, 0, 0) : jumps.row(Eigen::Index(i) - 1);
      const double work = own.dot((jumps.row(Eigen::Index(i) + 1) - less).transpose()) / (after - before);
      for (const auto& [point, weight] : pair.left) works(0, point) += weight * work;  // jumps grow backwards
    }
    plate_.constraints().fetch(force), plate_.constraints().fetch(works);
    return works.row(0).transpose();
  }

private:
  static constexpr Eigen::Index opening = 1;  // of the jumps of a pair

  /// Forces that part the pairs, by internal forces, which are minus those from outside [pairs x 3].
  Eigen::MatrixX3d pressing(const plate::Forces& force) const {
    const Eigen::MatrixX3d result = -(jumps(force) * acts_.asDiagonal());
    return pairs_.empty() ? result : Eigen::MatrixX3d(products_.solve(result));
  }
  Eigen::MatrixX3d jumps(const plate::State& state) const {
    Eigen::MatrixXd result(Eigen::Index(pairs_.size()), 3);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      result.row(Eigen::Index(i)) = pairs_[i].second.jumps(state).transpose();
    return plate::sum_of_ranks(plate_, result);
  }

  const plate::Formulation& plate_;
  Eigen::Vector3d acts_{0, 1, 0};                          // 1 for the jumps that forces act on
  std::vector<std::pair<double, plate::FacePair>> pairs_;  // with their distances from the tip
  Eigen::LDLT<Eigen::MatrixXd> products_;
};

/// A state less the uniform one whose tractions on the crack are a pressure on its faces at a tip.
plate::State eased(const plate::Formulation& plate, const geometry::Tip& tip, const plate::State& state,
                   double pressure) {
  const geometry::Point normal(-tip.direction.y(), tip.direction.x());
  const Eigen::Vector3d stress(normal.x() * normal.x(), normal.y() * normal.y(), normal.x() * normal.y());
  const Eigen::Vector3d strain =
      plate::LocalSection(plate.section().at(tip.position)).bending.ldlt().solve(-pressure * stress);
  Eigen::Matrix2d slope;
  slope << strain[0], strain[2] / 2, strain[2] / 2, strain[1];
  plate::State result = state;
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const geometry::Point x = plate.cloud().positions[std::size_t(k)] - tip.position;
    const geometry::Point d = slope * x;  // (theta_y, -theta_x)
    result.col(k) -= plate::PointValues(-x.dot(d) / 2, -d.y(), d.x());
  }
  return result;
}

}  // namespace

std::vector<Srif> srifs(const plate::Formulation& plate, const SrifOptions& options,
                        const std::vector<TipMethods>& methods, const plate::State& state, bool all_rings,
                        const plate::Heat* heat, const plate::Stretch* stretch) {
  const bool heated = heat && !heat->none();
  const bool pressed = plate.problem().faces_touch() || plate.problem().ties_faces();  // on the faces
  const auto forces = [&](const plate::State& of) {
    auto force = forces_on(plate, of);
    if (heated) force += heat->forces;
    if (stretch) force += stretch->forces;
    plate.constraints().fetch(force);
    return force;
  };
  const auto of_tip = [&](std::size_t tip, const plate::State& at, const plate::Forces& force,
                          const Eigen::VectorXd* on_faces) {
    return heated ? of_heated(plate, methods[tip], plate.tips()[tip], at, force, *heat, all_rings, on_faces, stretch)
                  : methods[tip](at, force, all_rings, {stretch ? &stretch->strains : nullptr, on_faces});
  };
  plate::Forces force;
  if (plate.distributed() ||  // no process can find forces alone
      pressed || std::ranges::any_of(methods, [](const auto& tip) { return tip.needs_force(); }))
    force = forces(state);
  std::vector<std::vector<Srif>> by_tip(methods.size());
  if (pressed) {  // each tip needs forces of a state of its own, which all threads find together
    const auto pairs = plate.face_pairs();
    for (std::size_t tip = 0; tip < methods.size(); ++tip) {
      auto at = plate.tips()[tip];
      const double spacing = plate.discretization().spacing_at_tips();
      const auto frame = frame_of(plate.paths()[at.crack], at, spacing, follows_curves(plate.problem()));
      const FacesBehind faces(plate, pairs, frame);
      const double near = std::min(clear_distance(plate.problem(), plate.paths(), at) / 4, 2 * plate.section().layer());
      at.direction = frame.ahead;
      // what springs carry falls to zero towards the tip
      const double pressure = plate.problem().ties_faces() ? 0 : faces.pressure(force, near);
      const auto rest = eased(plate, at, state, pressure);
      auto of_rest = forces(rest);
      const auto on_faces = faces.take(rest, of_rest);
      if (methods[tip].here()) by_tip[tip] = of_tip(tip, rest, of_rest, &on_faces);
    }
  } else {
#pragma omp parallel for schedule(dynamic)
    for (std::size_t tip = 0; tip < methods.size(); ++tip)
      if (methods[tip].here()) by_tip[tip] = of_tip(tip, state, force, nullptr);
  }
  std::vector<Srif> result;
  for (std::size_t tip = 0; tip < methods.size(); ++tip)
    for (auto& srif : by_tip[tip]) {
      srif.tip = tip;
      normalize(srif, options, plate.section().thickness);
      result.push_back(std::move(srif));
    }
  const double thickness = plate.section().thickness;
  add_errors_of_other_tips(result, plate::largest_of(plate, largest_of_tips(result, thickness)), thickness);
  std::vector<double> largest;
  mark_lost(result, thickness, largest);
  return result;
}

std::vector<ClosedTip> closed_tips(const plate::TouchingFaces& found, const plate::Formulation& plate) {
  const double scale = found.largest_force() * std::sqrt(found.length());
  std::vector<ClosedTip> result;
  for (const auto& tip : plate.tips()) {
    const auto* next = found.next_to(tip.position);
    result.push_back({.top = next && next->force_top > 0,
                      .bottom = next && next->force_bottom > 0,
                      .scale = scale,
                      .layer = plate.offers(plate::Feature::graded_points)});
  }
  return result;
}

std::vector<std::string> left_out(const std::vector<geometry::Tip>& tips, const std::vector<TipMethods>& methods,
                                  const SrifOptions& options) {
  const bool named = options.methods != SrifOptions{}.methods;
  std::vector<std::string> result;
  for (std::size_t tip = 0; tip < methods.size(); ++tip) {
    const auto& x = tips[tip].position;
    if (!methods[tip].works()) {
      result.push_back(
          fmt::format("tip at ({:g}, {:g}): no intensity factors: {}", x.x(), x.y(), methods[tip].left_out().front()));
      continue;
    }
    for (const auto& reason : named ? methods[tip].left_out() : std::vector<std::string>())
      result.push_back(fmt::format("tip at ({:g}, {:g}): left out {}", x.x(), x.y(), reason));
  }
  return result;
}

std::vector<std::string> warnings_about_ligaments(const plate::Formulation& plate) {
  std::vector<std::string> warnings;
  constexpr double resolved = 2;  // spacings
  const double spacing = plate.discretization().spacing_at_tips();
  for (const auto& tip : plate.tips()) {
    const double clear =
        clear_distance(plate.problem().outline, plate.paths(), tip, spacing, follows_curves(plate.problem()));
    if (clear >= resolved * spacing) continue;
    warnings.push_back(fmt::format(
        "tip at ({:g}, {:g}): the next edge, crack or bend is {:.2g} spacings away: errors may exceed their estimates; "
        "set {} = {:.2g}",
        tip.position.x(), tip.position.y(), clear / spacing,
        plate.offers(plate::Feature::graded_points) ? "`tip_spacing`" : "`spacing`", clear / 4));
  }
  return warnings;
}

std::vector<std::string> warnings_about_factors(const std::vector<Srif>& srifs, const std::vector<double>& largest,
                                                double h, const std::string& remedy) {
  constexpr double uncertain = 0.03;
  std::vector<std::string> warnings;
  for (const auto* one : recommended(srifs)) {
    const auto& srif = *one;
    const auto place = fmt::format("tip {} ({:.4g}, {:.4g})", srif.tip, srif.position.x(), srif.position.y());
    const char* lost = srif.membrane ? "no K1, K2, K3" : "no intensity factors";
    std::vector<std::string> said;
    if (srif.G && *srif.G <= 0 && !srif.resolved[0])
      said.push_back(fmt::format("{}: energy release rate {:.3g} is not positive", lost, *srif.G));
    const double scale = std::max(largest_with_plane(srif, h), srif.tip < largest.size() ? largest[srif.tip] : 0);
    if (scale > 0 && said.empty() && of_opening(srif.method) && !srif.resolved[0])
      said.push_back(fmt::format("{}: only the crack opening has enough points", lost));
    // tips that no method of bending has room at are told of elsewhere
    const bool bends = said.empty() && (srif.resolved[0] || srif.errors[0]);
    Doubt none, some;
    const double reached = srif.accuracy_reached.value_or(0);
    const auto judge = [&](const std::string& name, bool resolved, const std::optional<double>& error, double arm) {
      const double share = error.value_or(0) * arm / scale;
      if (!resolved) return none.add(name, share);
      // what was asked for counts against the largest of all tips, times and kinds of load
      const bool as_asked = srif.accuracy_reached && reached <= uncertain;
      if (!as_asked && share > std::max(uncertain, reached * (1 + 1e-9))) some.add(name, share);
    };
    for (std::size_t i = 0; i < 3 && bends && scale > 0; ++i)
      judge(fmt::format("K{}", i + 1), srif.resolved[i], srif.errors[i], i == 2 ? h : 1);
    for (std::size_t i = 0; i < 2 && srif.membrane && scale > 0; ++i)
      judge(fmt::format("N{}", i + 1), srif.membrane->resolved[i], srif.membrane->errors[i], h / 6);
    for (const auto& words : {none.words("unresolved"), some.words("uncertain")})
      if (!words.empty()) said.push_back(words);
    if (!said.empty()) warnings.push_back(fmt::format("{}: {}; {}", place, fmt::join(said, ", "), remedy));
  }
  return warnings;
}

}  // namespace post
