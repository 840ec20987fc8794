#include "plate/edges/surface_formulation.hpp"

#include <fmt/format.h>

#include "plate/bonds/horizon_parameters.hpp"
#include "plate/bonds/results.hpp"
#include "plate/bonds/validation.hpp"
#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/multiplied_plate.hpp"
#include "plate/edges/surface_layout.hpp"
#include "plate/edges/surface_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/space.hpp"

namespace plate {

namespace {

using geometry::Point;

/// Degree of freedom after degree of freedom, as the matrices have them.
Eigen::VectorXd by_points(const State& state) {
  return Eigen::Map<const Eigen::VectorXd>(StateByPoints(state).data(), state.size());
}

State by_components(const Eigen::VectorXd& values) {
  return Eigen::Map<const StateByPoints>(values.data(), unknowns_per_point, values.size() / unknowns_per_point);
}

/// The free degrees of freedom, factorised.
class FreeFactor : public Preconditioner {
public:
  FreeFactor(const SparseStiffness& K, const Constraints& constraints) : factor_(free_part(K, constraints, free_)) {}

  void apply(const Forces& residual, State& result) const override {
    const Eigen::VectorXd all = by_points(residual);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(all.size());
    values(free_) = factor_.solve(all(free_));
    result = by_components(values);
  }
  std::size_t bytes() const override { return factor_.bytes(); }

private:
  static SparseStiffness free_part(const SparseStiffness& K, const Constraints& constraints,
                                   std::vector<Eigen::Index>& free) {
    std::vector<int> place(std::size_t(K.cols()), -1);
    for (Eigen::Index i = 0; i < K.cols(); ++i)
      if (!constraints.held(dof_by_points(i))) place[std::size_t(i)] = int(free.size()), free.push_back(i);
    std::vector<Eigen::Triplet<double>> entries;
    for (const Eigen::Index j : free)
      for (SparseStiffness::InnerIterator e(K, j); e; ++e)
        if (const int row = place[std::size_t(e.row())]; row >= 0)
          entries.emplace_back(row, place[std::size_t(j)], e.value());
    SparseStiffness result(Eigen::Index(free.size()), Eigen::Index(free.size()));
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  std::vector<Eigen::Index> free_;
  ScaledFactor factor_;
};

/// Nodes of the lattice, their families and the expansion of fictitious nodes, for quantities derived from a state.
struct Surroundings {
  Surroundings(const SurfacePlate& plate, bool multiplied, const geometry::LatticeUnits& units, double horizon,
               const std::vector<geometry::CrackPath>& cracks)
      : rows((multiplied ? expansion_of_real(plate) : expansion(plate))
                 .topRows(unknowns_per_point * plate.body.count())) {
    geometry::Cloud cloud{units, {}, {}, 0};
    for (int k = 0; k < plate.body.count(); ++k) cloud.positions.push_back(plate.at(k));
    cloud.plate_points = cloud.positions.size();
    cloud.areas.assign(cloud.size(), plate.bonds.spacing * plate.bonds.spacing);
    std::vector<Point> places;
    for (const auto& x : cloud.positions) places.push_back(units.to_lattice(x));
    families = geometry::families(cloud, horizon, [&](std::uint32_t k, std::uint32_t j) {
      if (!plate.cuts.of(int(k))) return true;
      const auto parts = [&](const auto& crack) { return geometry::separates(crack, places[k], places[j]); };
      return std::ranges::none_of(cracks, parts);
    });
    areas = std::move(cloud.areas);
  }
  WeightRows rows;
  geometry::Families families;
  std::vector<double> areas;
};

class SurfaceNodePlate : public Formulation {
public:
  SurfaceNodePlate(SurfaceLayout made, EdgeMethod method)
      : Formulation(std::move(made.layout)),
        plate_(std::move(made.plate)),
        stiffness_(std::move(made.stiffness)),
        families_(std::move(made.families)),
        shapes_(bond_shapes(families_.vectors(), section(), discretization())),
        cracks_(geometry::to_lattice(paths(), cloud().units)),
        multiplied_(method == EdgeMethod::fictitious_nodes),
        around_(plate_, multiplied_, cloud().units, discretization().horizon(), cracks_) {}

  std::size_t points() const override { return cloud().size(); }
  void internal_force(const State& state, Forces& forces) const override {
    forces = by_components(-(stiffness_ * by_points(state)));
  }
  void absolute_product(const State& state, Forces& forces) const override {
    forces = by_components(SparseStiffness(stiffness_.cwiseAbs()) * by_points(state));
  }
  Forces diagonal() const override;

  const geometry::Families& families() const override { return families_; }
  Eigen::VectorXd energies(const State& state) const override;
  Resultants resultants(const State& state) const override {
    const auto shapes = bond_shapes(around_.families.vectors(), section(), discretization());
    return plate::resultants(everywhere(state), around_.families, shapes, around_.areas, cloud().plate_points,
                             section());
  }
  std::vector<PlaceShare> interpolation(const Point& at) const override;
  Mesh mesh() const override { return plate::mesh(boundary(), problem().outline, paths(), cut(), section().thickness); }
  std::vector<double> cut_at(const StartOfCracks& start) const override { return start.cut; }
  std::unique_ptr<TipView> tip_view() const override {
    return std::make_unique<BondView>(cloud(), families_, shapes_, section(), discretization());
  }
  ChosenPreconditioner preconditioner(Preconditioning) const override { return {nullptr, "diagonal"}; }
  std::unique_ptr<Preconditioner> factor() const override {
    return std::make_unique<FreeFactor>(stiffness_, constraints());
  }
  std::vector<MemoryPart> memory(bool) const override {
    constexpr std::size_t entry = sizeof(double) + sizeof(int);
    return {{"stiffness with surface nodes", "parameters", double(std::size_t(stiffness_.nonZeros()) * entry)}};
  }
  std::vector<std::string> warnings(bool factors) const override { return warnings_about_bonds(*this, factors); }
  std::string of_edges() const override;
  std::optional<double> multipliers(const State& state) const override;
  std::string remedy() const override {
    return fmt::format("set `spacing` = {:.2g}{}", plate_.bonds.spacing / 2,
                       multiplied_ ? " or boundary = \"images\"" : "");
  }

private:
  /// The state at all nodes, fictitious ones too, without their sights.
  State everywhere(const State& state) const {
    return by_components(around_.rows * by_points(state).head(around_.rows.cols()));
  }

  SurfacePlate plate_;
  SparseStiffness stiffness_;
  geometry::Families families_;
  std::vector<BondShape> shapes_;
  std::vector<geometry::CrackPath> cracks_;  // [spacings]
  bool multiplied_;                          // conditions at edges
  Surroundings around_;
};

/// Diagonal of the stiffness, absolute values; with multipliers, whose rows of fluxes and conditions have none, a flux
/// counts as a force on its inner node.
Forces SurfaceNodePlate::diagonal() const {
  Forces result = by_components(stiffness_.diagonal().cwiseAbs());
  if (multiplied_)
    for (std::size_t s = 0; s < plate_.body.surface.size(); ++s)
      result.col(Eigen::Index(plate_.body.real + s)) = result.col(plate_.body.surface[s].inner);
  return result;
}

Eigen::VectorXd SurfaceNodePlate::energies(const State& state) const {
  const State all = everywhere(state);
  const auto at = [&](int k) { return Kinematics<>{all(0, k), all(1, k), all(2, k)}; };
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(points()));
  for (int k = 0; k < plate_.body.real; ++k) {
    double couple = 0, dilatation = 0, sum = 0;  // couple: 2 A a theta
    for (std::size_t i = 0; i < plate_.bonds.bonds.size(); ++i) {
      if (plate_.cuts.broken(k, i)) continue;
      const int j = plate_.body.node(plate_.body.nodes[std::size_t(k)] + plate_.bonds.bonds[i].away);
      const auto& bond = plate_.bonds.bonds[i];
      const BondHalf own = half(plate_.bonds, plate_.cuts, k, i);
      const double curvature = curvature_difference(bond, at(k), at(j)), shear = shear_difference(bond, at(k), at(j));
      couple += own.dilatation_couple * curvature, dilatation += own.D * curvature;
      sum += (own.curvature * curvature * curvature + own.shear * shear * shear) / 2;
    }
    result[k] = couple * dilatation / 2 + sum;
  }
  return result;
}

/// Surface nodes are points like others there.
std::vector<PlaceShare> SurfaceNodePlate::interpolation(const Point& at) const {
  return visible_place(at, cloud().units, boundary().lattice, std::size_t(plate_.unknowns() / unknowns_per_point),
                       cracks_);
}

/// Forces of the multipliers over the sizes of the loads, as the residual of the balance (post::Balance).
std::optional<double> SurfaceNodePlate::multipliers(const State& state) const {
  if (!multiplied_) return std::nullopt;
  const auto [low, high] = geometry::bounding_box(problem().outline);
  const double arm = (high - low).norm() / 2;
  const Forces load = total_load();
  double loads = load.row(0).cwiseAbs().sum();  // roots one by one: gcc warns of Eigen's for eight
  for (Eigen::Index k = 0; k < load.cols(); ++k) loads += load.col(k).tail<2>().norm() / arm;
  return loads > 0 ? added_forces(stiffness_, plate_, by_points(state), arm) / loads : 0;
}

std::string SurfaceNodePlate::of_edges() const {
  if (multiplied_ || plate_.oblique) return "";
  const double d = plate_.bonds.spacing;
  auto outline = geometry::rectangle(0, 0, 10 * d, 8 * d);
  const bool notched = !plate_.body.sights.empty();
  if (notched) outline.outer = {{{0, 0}, {10 * d, 0}, {10 * d, 5 * d}, {5 * d, 5 * d}, {5 * d, 9 * d}, {0, 9 * d}}, {}};
  const auto small = surface_plate(section(), discretization(), outline);
  const auto edges = [&](const Point& at, const Point& normal) {
    const auto side = std::ranges::find_if(
        boundary().sides, [&](const Side& one) { return one.outward(cloud().units.to_units(at)).dot(normal) > 0.5; });
    return edge_condition(side->kind);
  };
  const auto [lowest, asymmetry, negative] = spectrum(small, edges, section().thickness);
  return fmt::format(
      "edges         of {} points like these: lowest square of a frequency {:.1e} of the largest, asymmetry {:.1e}, "
      "motions that grow: {}\n",
      notched ? "10 x 9 less 5 x 4" : "10 x 8", lowest, asymmetry, negative);
}

template <EdgeMethod method>
Discretised discretised(const Problem& problem, const Communicator&) {
  Discretised result;
  auto layout = surface_layout(problem, method);
  result.warnings = layout.layout.boundary.warnings;
  result.stopwatch.lap("geometry");
  result.plate = std::make_unique<SurfaceNodePlate>(std::move(layout), method);
  if (loaded_in_plane(problem))
    result.membrane = std::make_unique<SurfaceNodePlate>(surface_layout(membrane_of(problem), method), method);
  result.stopwatch.lap("parameters");
  return result;
}

/// Features that plates with surface nodes or fictitious nodes do not support, each with the reason.
std::map<Feature, std::string> lacks(const std::string& nodes) {
  const std::string asymmetric = "the stiffness with " + nodes + " is not symmetric: ";
  return {{Feature::layers, nodes + " hold edges, not layers"},
          {Feature::any_direction, nodes + " are of edges along the axes"},
          {Feature::stretching, asymmetric + "loads in the plane act on bending with boundary = \"images\""},
          {Feature::touching_faces, asymmetric + "contact of crack faces is found with boundary = \"images\""},
          {Feature::graded_points, "needs the Galerkin plate, whose points can be graded"},
          {Feature::short_horizon, asymmetric + "it is solved directly"},
          {Feature::levels, asymmetric + "it is solved directly"},
          {Feature::single_precision, asymmetric + "motion on it would grow"},
          {Feature::lanczos, asymmetric + "motion on it would grow"},
          {Feature::symmetry, asymmetric + "it is solved directly, at rest"},
          {Feature::breaking_bonds, asymmetric + "cracks grow with boundary = \"images\""},
          {Feature::sections, "bonds share their weights by pattern, as one isotropic section makes them"},
          {Feature::stiffeners, "beams need points on their line, and bonds have theirs beside it"},
          {Feature::running_tips, asymmetric + "cracks grow with boundary = \"images\""}};
}

std::map<Feature, std::string> without(std::map<Feature, std::string> all, Feature one) {
  all.erase(one);
  return all;
}

}  // namespace

const FormulationKind bonds_with_surface_nodes{"surface_nodes", "bonds with surface nodes",
                                               without(lacks("surface nodes"), Feature::any_direction),
                                               discretised<EdgeMethod::surface_nodes>};

const FormulationKind bonds_with_fictitious_nodes{"fictitious_nodes", "bonds with fictitious nodes",
                                                  lacks("fictitious nodes"), discretised<EdgeMethod::fictitious_nodes>};

}  // namespace plate
