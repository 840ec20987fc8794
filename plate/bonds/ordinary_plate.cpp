#include "plate/bonds/ordinary_plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>
#include <optional>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/family_weights.hpp"
#include "plate/bonds/horizon_parameters.hpp"
#include "plate/bonds/loads_in_plane.hpp"
#include "plate/bonds/part_of_lattice.hpp"
#include "plate/bonds/preconditioners.hpp"
#include "plate/bonds/results.hpp"
#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/bonds/stiffness.hpp"
#include "plate/bonds/stretching.hpp"
#include "plate/bonds/supports.hpp"
#include "plate/bonds/validation.hpp"
#include "plate/bonds/visibility.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/face_pairs.hpp"
#include "plate/formulation/hubs.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/layout.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/formulation/springs_and_stiffeners.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/process.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/factorised_plate.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Iterations that conjugate gradients with the diagonal take to 1e-8: measured on square plates with a crack, held on
/// two edges and (three times as many) on three points, sides of 125 to 500 spacings, side / thickness from 4 to 200.
double iterations_with_diagonal(const Problem& problem) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const double side = (high - low).maxCoeff();
  const bool held = problem.elastically_supported() ||
                    std::ranges::any_of(problem.supports, [](const auto& s) { return !s.edges.empty(); });
  const double slender = problem.section.law == PlateLaw::membrane ? 0 : 0.084 * side / problem.section.thickness;
  return (held ? 1 : 3) * (2.2 + slender) * side / problem.discretization.spacing;
}

/// Bytes of the factor of the short-horizon plate on every fourth point: measured 220 n log2 n for n = 15,600 to
/// 250,000.
double factor_bytes(double points) {
  const double coarse = points / 4;
  return 220 * coarse * std::log2(coarse + 2);
}

template <typename T>
double bytes_of(const std::vector<T>& values) {
  return double(values.size() * sizeof(T));
}

double weight_bytes(const FamilyOperator& plate) {
  const auto& weights = plate.weights();
  return bytes_of(weights.kind) + bytes_of(weights.a) + bytes_of(weights.first) + bytes_of(weights.bonds) +
         bytes_of(plate.patterns().bonds) + bytes_of(plate.patterns().first) + bytes_of(plate.runs().runs) +
         bytes_of(plate.runs().example) + 2 * sizeof(double) * double(plate.points());
}

std::string name_of(SurfaceCorrection correction) {
  switch (correction) {
    case SurfaceCorrection::none:
      return "none";
    case SurfaceCorrection::volume:
      return "volume";
    case SurfaceCorrection::arbitrary_horizon:
      return "arbitrary horizon";
    case SurfaceCorrection::position_aware:
      return "position-aware";
  }
  return "";
}

/// Shares of points in the displacements of a place [spacings] on the face of a crack: by the linear field that fits
/// those of the points that it sees best, with weights that fall to zero over 2.5 spacings.
std::vector<FacePair::Share> shares_on_face(const Point& at, const Boundary& boundary,
                                            const std::vector<geometry::CrackPath>& cracks) {
  constexpr double reach = 2.5;
  const auto& [units, positions, areas, plate_points, part] = boundary.cloud;
  const auto near = visible_from(at, reach, boundary.lattice, plate_points, cracks);
  const auto count = Eigen::Index(near.size());
  Eigen::MatrixXd basis(count, 3);
  Eigen::VectorXd root(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point x = near[std::size_t(i)].second - at;
    basis.row(i) << 1, x.x(), x.y();
    root[i] = std::sqrt(std::max(0.0, 1 - x.norm() / reach));
  }
  std::vector<FacePair::Share> result;
  if (const auto [inverse, rank] = pseudo_inverse(root.asDiagonal() * basis); rank == 3) {
    for (Eigen::Index i = 0; i < count; ++i) result.push_back({near[std::size_t(i)].first, inverse(0, i) * root[i]});
    return result;
  }
  for (const auto& share : visible_place(units.from_lattice(at), units, boundary.lattice, plate_points, cracks))
    result.push_back({share.point, share.weight});
  return result;
}

/// Places two spacings apart on the cracks: forces at nearer ones would vary from place to place, as the points do
/// beside oblique cracks.
std::vector<FacePair> facing_places(const Boundary& boundary, const std::vector<geometry::CrackPath>& paths) {
  constexpr double apart = 2, beside = 1e-3;  // spacings
  const auto& units = boundary.cloud.units;
  const auto cracks = geometry::to_lattice(paths, units);
  // a rank knows all points that a place sees, but near the border of what it has discretised, far from owned points
  constexpr long border = 8;
  const auto& part = boundary.cloud.part;
  const auto known = part ? std::optional(part->grown(-border)) : std::nullopt;
  const auto shares = [&](const Point& place) -> std::vector<FacePair::Share> {
    if (known && !known->contains(geometry::cell_of(place))) return {};
    auto result = shares_on_face(place, boundary, cracks);
    std::erase_if(result, [&](const auto& share) { return !boundary.owns(share.point); });
    return result;
  };
  std::vector<FacePair> result;
  for (const auto& path : paths)
    for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i) {
      const Point from = path.vertices[i], along = path.vertices[i + 1] - from;
      const double count = std::max(1.0, std::round(along.norm() / (apart * units.spacing)));
      const Point normal = Point(-along.y(), along.x()).normalized();
      for (double n = 0.5; n < count; ++n) {
        const Point at = from + n / count * along, place = units.to_units(at);
        result.push_back({.left = shares(place + beside * normal),
                          .right = shares(place - beside * normal),
                          .position = at,
                          .normal = normal,
                          .length = along.norm() / count});
      }
    }
  return result;
}

class OrdinaryPlate : public Formulation {
public:
  OrdinaryPlate(Layout layout, LatticeOperator op, std::optional<MatchCounts> match)
      : Formulation(std::move(layout)), op_(std::move(op)), match_(match) {}

  std::size_t points() const override { return op_.points(); }
  void internal_force(const State& state, Forces& forces) const override { op_.internal_force(state, forces); }
  void internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const override {
    op_.internal_force_overlapped(state, rest, forces);
  }
  void absolute_product(const State& state, Forces& forces) const override { op_.absolute_product(state, forces); }
  Forces diagonal() const override { return op_.diagonal(); }

  const geometry::Families& families() const override { return op_.families(); }
  Eigen::VectorXd energies(const State& state) const override { return op_.energies(state); }
  Resultants resultants(const State& state) const override {
    return plate::resultants(state, op_.families(), op_.shapes(), cloud().areas, cloud().plate_points, section());
  }
  std::vector<PlaceShare> interpolation(const Point& at) const override;
  Mesh mesh() const override { return plate::mesh(boundary(), problem().outline, paths(), cut(), section().thickness); }
  std::vector<double> cut_at(const StartOfCracks& start) const override { return start.cut; }
  std::unique_ptr<TipView> tip_view() const override {
    return std::make_unique<BondView>(cloud(), op_.families(), op_.shapes(), section(), discretization());
  }
  ChosenPreconditioner preconditioner(Preconditioning wanted) const override;
  std::unique_ptr<Preconditioner> inverse_of_shifted(double shift) const override;
  std::vector<FacePair> face_pairs() const override { return facing_places(boundary(), paths()); }
  PointMatrix stiffness() const override { return stiffness_matrix(op_, true); }
  std::unique_ptr<Stretching> stretching() const override {
    return std::make_unique<BondStretching>(op_, section(), cloud().areas, cloud().plate_points);
  }
  std::unique_ptr<Formulation> middle_plane() const override;
  std::unique_ptr<Preconditioner> factor() const override;
  Constraints constraints_about() const override;
  SingleForce single_precision() const override {
    return [rows = op_.single_rows(), elastic_supports = op_.elastic_supports()](const Values<float>& state,
                                                                                 Values<float>& force) {
      rows.internal_force(state, force);
      elastic_supports.add_force(state, force);
    };
  }
  const FamilyOperator* breaking() const override { return &op_; }
  std::vector<MemoryPart> memory(bool single) const override;
  std::optional<MatchCounts> matched() const override { return match_; }
  std::vector<std::string> warnings(bool factors) const override { return warnings_about_bonds(*this, factors); }
  std::string remedy() const override;
  double error_of_edges() const override { return error_of_stairs(*this); }
  std::optional<double> width_of_pins() const override { return plate::width_of_pins(problem(), cloud().units); }

private:
  /// Forces of a point, and of its image beyond an edge, are of what is two horizons away [spacings].
  double reach_of_stiffness() const { return 4 * discretization().horizon_ratio + 2; }

  LatticeOperator op_;
  std::optional<MatchCounts> match_;
  mutable std::once_flag indexed_;
  mutable std::optional<geometry::CellIndex> index_;  // of the points, from the first place on
};

std::vector<PlaceShare> OrdinaryPlate::interpolation(const Point& at) const {
  constexpr int cells = 4;  // have all points within two times reach_of_places
  const auto& lattice = boundary().lattice;
  const auto& units = cloud().units;
  std::call_once(indexed_, [&] {
    const auto last = lattice.begin() + std::ptrdiff_t(cloud().plate_points);
    index_.emplace(std::vector<Point>(lattice.begin(), last));
  });
  const Point u = units.to_lattice(at);
  std::vector<std::uint32_t> about;
  for (int row = -cells; row <= cells; ++row)
    for (int column = -cells; column <= cells; ++column)
      if (const auto k = index_->at(u + Point(column, row))) about.push_back(*k);
  std::ranges::sort(about);
  std::vector<Point> near;
  for (const auto k : about) near.push_back(lattice[k]);
  if (std::ranges::none_of(near, [&](const Point& x) { return (x - u).norm() <= reach_of_places; }))
    throw Refused({{Subject::geometry, 0, too_far("place", at, distance_to_points(cloud(), at), reach_of_places)}});
  auto result = visible_place(at, units, near, near.size(), geometry::to_lattice(paths(), units));
  for (auto& share : result) share.point = about[share.point];
  return result;
}

std::unique_ptr<Preconditioner> OrdinaryPlate::factor() const {
  if (!distributed()) return std::make_unique<AssembledPlate>(op_, constraints(), stiffness_matrix(op_, true));
  const auto near = surroundings(problem().outline, discretization(), boundary(), reach_of_stiffness());
  return std::make_unique<DistributedFactor>(op_, boundary(), stiffness_matrix(op_, true, near->known),
                                             near->exchange.get());
}

Constraints OrdinaryPlate::constraints_about() const {
  const auto near = surroundings(problem().outline, discretization(), boundary(), reach_of_stiffness());
  return near ? constraints().fetching(near->exchange) : constraints();
}

ChosenPreconditioner OrdinaryPlate::preconditioner(Preconditioning wanted) const {
  // the factor of two levels would enlarge the rounding of a motion without resistance
  using enum Preconditioning;
  const auto usual = [&] {
    const auto here = may_move() ? diagonal : usual_preconditioner_of_bonds(problem(), double(points()));
    return largest_of(*this, here == diagonal) > 0 ? diagonal : here;
  };
  if (wanted == automatic) wanted = usual();
  if (wanted == two_level && hubs_move(problem().supports, section().law)) wanted = local;
  if (wanted == diagonal) return {nullptr, "diagonal"};
  if (wanted == local)
    return {std::make_unique<ShortHorizonPreconditioner>(op_, boundary(), section(), discretization()), "local"};
  return {std::make_unique<TwoLevelPreconditioner>(op_, boundary(), section(), discretization()), "two_level"};
}

std::unique_ptr<Preconditioner> OrdinaryPlate::inverse_of_shifted(double shift) const {
  if (distributed() || 4 * factor_bytes(double(points())) > free_memory() / 2)
    return Formulation::inverse_of_shifted(shift);
  return std::make_unique<ShortHorizonPreconditioner>(op_, boundary(), section(), discretization(), shift * mass());
}

std::vector<MemoryPart> OrdinaryPlate::memory(bool single) const {
  return {{fmt::format("weights of the bonds, surface correction {}", name_of(discretization().surface_correction)),
           "parameters", weight_bytes(op_)},
          {"rows of points", "parameters", double(op_.rows().bytes()) * (single ? 1.5 : 1)}};
}

std::string OrdinaryPlate::remedy() const {
  const auto& d = discretization();
  return fmt::format("set `spacing` = {:.2g} or formulation = \"galerkin\"",
                     std::min(section().layer() / 2 / d.horizon_ratio, d.spacing / 2));
}

struct Weights {
  HorizonWeights weights;
  std::optional<MatchCounts> counts;
};

Weights horizon_weights(const Problem& problem, const Boundary& boundary, const geometry::Families& families,
                        const std::vector<BondShape>& shapes) {
  const auto& d = problem.discretization;
  const auto& areas = boundary.cloud.areas;
  const auto kinds = family_kinds(families, areas, boundary.active);
  if (d.surface_correction == SurfaceCorrection::position_aware) {
    auto found = position_aware(families, shapes, areas, boundary.active, kinds, problem.section);
    return {std::move(found.weights), found.counts};
  }
  const auto parameters = horizon_parameters(families, shapes, areas, boundary.active, problem.section, d);
  return {weights_of_parameters(families, shapes, areas, kinds, parameters), std::nullopt};
}

void warn_of_edges(const Boundary& boundary, double spacing, std::vector<std::string>& warnings) {
  for (const auto& side : boundary.sides) {
    const int axis = side.normal_axis();
    if (axis < 0 || side.support || side.along_lattice() || side.kind == SupportKind::free) continue;
    const double cells = side.edge.from[axis];
    warnings.push_back(
        fmt::format("edge '{}' lies {:.3f} spacings from the lattice's origin, not on a cell boundary; set "
                    "`spacing` = {:.6g}",
                    side.name, cells, spacing * cells / std::round(cells)));
  }
}

void check_weights(const std::vector<BondShape>& shapes, double horizon_ratio) {
  for (const auto& bond : shapes)
    if (bond.weight < 0)
      throw Refused(
          {{Subject::volume_correction, 0,
            fmt::format("\"lattice_fitted\" has a negative weight at horizon_ratio {:g}; choose \"linear\", or "
                        "a ratio a little above a whole number",
                        horizon_ratio)}});
}

/// Dirichlet lift of load `number`; in a distributed plate that of a settlement has columns on every rank, also on
/// those that know no moved point.
State lift_of(const Load& load, std::size_t number, const Boundary& boundary) {
  auto result = boundary.constraints.lift(number, boundary.cloud.size());
  if (boundary.map.distributed() && load.as<Settlement>() && result.cols() == 0)
    result = zero_state(boundary.cloud.size());
  return result;
}

Forces forces_of(const Load& load, const Problem& problem, const Boundary& boundary,
                 const std::vector<geometry::CrackPath>& paths) {
  if (problem.section.law == PlateLaw::bending)
    return nodal_forces(load, boundary.cloud, problem.outline, boundary.map, paths);
  return forces_in_plane(load, boundary, problem.outline, paths, problem.discretization.horizon_ratio,
                         problem.supports);
}

/// Supports whose points beyond edges a plate has without bonds: those of `other`, the same plate in its plane, or
/// across it, where states of both stand together.
std::vector<Support> supports_beside(const Problem& problem, const Problem& other) {
  return problem.joined_with_plane || problem.stretches ? other.supports : std::vector<Support>{};
}

/// Adds warnings to `warnings`, and its time to `stopwatch`. `beside`: supports_beside().
std::unique_ptr<Formulation> discretised_plate(const Problem& problem, const std::vector<Support>& beside,
                                               const Communicator& all, std::vector<std::string>& warnings,
                                               Stopwatch& stopwatch) {
  const auto& d = problem.discretization;
  const auto law = problem.section.law;
  auto paths = crack_paths(problem);
  const auto part = part_of_lattice(all, problem.outline, d);
  auto cloud = geometry::lattice(problem.outline, d.spacing, part ? std::optional(part->seen) : std::nullopt);
  const auto outline = geometry::to_lattice(problem.outline, cloud.units);
  check_lattice(problem, cloud, outline);
  Layout layout{problem,
                {},
                geometry::tips(paths),
                boundary(std::move(cloud), outline, problem.supports, d, support_motions(problem), {&all}, law, beside),
                {},
                {}};
  auto& boundary = layout.boundary;
  warnings = boundary.warnings;
  warn_of_edges(boundary, d.spacing, warnings);
  stopwatch.lap("geometry");
  const auto whole = geometry::families(boundary.cloud, d.horizon(), sees(boundary, outline, d.horizon_ratio));
  auto families =
      without_crossing_bonds(boundary, whole, geometry::to_lattice(paths, boundary.cloud.units), d.horizon_ratio);
  boundary.elastic_supports = elastic_supports_of(
      problem, boundary.cloud, problem.ties_faces() ? facing_places(boundary, paths) : std::vector<FacePair>());
  OperatedPart operated_part;
  if (part) operated_part = operated(*part, boundary, families, layout.tips);
  layout.pieces = pieces(boundary, families, law);
  stopwatch.lap("families");
  auto shapes = bond_shapes(families.vectors(), problem.section, d);
  check_weights(shapes, d.horizon_ratio);
  layout.cut = cut_share(whole, families, shapes, boundary.cloud.plate_points);
  auto [weights, counts] = horizon_weights(problem, boundary, families, shapes);
  Forces load = zero_forces(boundary.cloud.size());
  for (const auto& one : problem.loads) {
    layout.loads.push_back({forces_of(one, problem, boundary, paths), one.history,
                            free_curvature(one, problem.section, boundary.cloud.positions, boundary.cloud.plate_points),
                            lift_of(one, layout.loads.size(), boundary)});
    if (auto& last = layout.loads.back(); last.curvature.size() > 0)
      last.forces = force_of_curvature(families, shapes, boundary.cloud.areas, weights, last.curvature, boundary.map);
    if (one.moves())
      layout.loads.back().moving =
          std::make_shared<MovingForces>(moving_forces(one, boundary.cloud, boundary.map, &problem.outline));
    const double share = 1 + (problem.load_cases.empty() ? 0 : 0.1 * double(layout.loads.size()));
    load += share * layout.loads.back().forces;  // those of load cases do not act together: none takes another away
  }
  layout.mechanisms = mechanisms(boundary, families, layout.pieces, load, law);
  if (layout.mechanisms.twisting > 0 && !all.distributed()) tie_twists(boundary, families);
  LatticeOperator op(FamilyOperator(std::move(families), std::move(shapes), boundary.cloud.areas, std::move(weights),
                                    std::move(operated_part)));
  op.set_elastic_supports(boundary.elastic_supports);
  layout.paths = std::move(paths);
  auto result = std::make_unique<OrdinaryPlate>(std::move(layout), std::move(op), counts);
  stopwatch.lap("parameters");
  return result;
}

Discretised discretised(const Problem& problem, const Communicator& all) {
  Discretised result;
  const auto membrane = membrane_of(problem);
  result.plate = discretised_plate(problem, supports_beside(problem, membrane), all, result.warnings, result.stopwatch);
  if (!has_plane(problem)) return result;
  std::vector<std::string> more;
  result.membrane = discretised_plate(membrane, supports_beside(problem, problem), all, more, result.stopwatch);
  for (auto& line : more)
    if (std::ranges::find(result.warnings, line) == result.warnings.end()) result.warnings.push_back(std::move(line));
  return result;
}

std::unique_ptr<Formulation> OrdinaryPlate::middle_plane() const {
  std::vector<std::string> ignored;
  Stopwatch stopwatch;
  return discretised_plate(membrane_of(problem()), supports_beside(problem(), problem()), communicator(), ignored,
                           stopwatch);
}

}  // namespace

/// Coarse points of a hub that moves are coupled farther than the two-level plate looks: it has the local one. The
/// factor of the two-level plate and the iterations with it cost about as much as 600 iterations with the diagonal.
Preconditioning usual_preconditioner_of_bonds(const Problem& problem, double points) {
  constexpr double worth = 600;
  const bool faster = iterations_with_diagonal(problem) > worth && factor_bytes(points) < free_memory() / 2;
  const bool moving = hubs_move(problem.supports, problem.section.law);
  return !faster ? Preconditioning::diagonal : moving ? Preconditioning::local : Preconditioning::two_level;
}

const FormulationKind ordinary{
    "ordinary",
    "bonds",
    {{Feature::levels, "\"levels\" is of formulation = \"galerkin\""},
     {Feature::hubs_in_holes, "bonds have no points on the rim of a hole, which a hub would move"},
     {Feature::graded_points, "needs the Galerkin plate, whose points can be graded"},
     {Feature::any_direction, "these supports mirror or extend the lattice, at edges along x or y"},
     {Feature::lanczos, "\"lanczos\" is of formulation = \"galerkin\", whose points all have mass"},
     {Feature::sections, "bonds share their weights by pattern, as one isotropic section makes them"},
     {Feature::stiffeners, "beams need points on their line, and bonds have theirs beside it"},
     {Feature::part_through,
      "springs that are nearly rigid need points on the faces, and bonds have theirs beside "
      "them"}},
    discretised};

}  // namespace plate
