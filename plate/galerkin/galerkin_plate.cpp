#include "plate/galerkin/galerkin_plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "geometry/cells/tessellation.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/face_pairs.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/layout.hpp"
#include "plate/formulation/mesh.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/formulation/springs_and_stiffeners.hpp"
#include "plate/galerkin/discretised_cells.hpp"
#include "plate/galerkin/multigrid.hpp"
#include "plate/galerkin/results.hpp"
#include "plate/galerkin/stiffness.hpp"
#include "plate/galerkin/stretched_stiffeners.hpp"
#include "plate/galerkin/stretching.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/process.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {
namespace {

using Eigen::Index;
using geometry::Point;

template <typename T>
double bytes_of(const std::vector<T>& values) {
  return double(values.size() * sizeof(T));
}

/// Unit vectors and lengths of the bonds of families; they have no weights.
std::vector<BondShape> shapes_of(const std::vector<Point>& vectors) {
  std::vector<BondShape> result;
  result.reserve(vectors.size());
  for (const auto& xi : vectors) {
    const double length = xi.norm();
    result.push_back({xi.y() / length, -xi.x() / length, length, 0});
  }
  return result;
}

class GalerkinPlate : public Formulation {
public:
  explicit GalerkinPlate(DiscretisedPart part)
      : Formulation(std::move(part.layout)),
        cells_(std::move(part.cells)),
        shapes_(shapes_of(part.families.families.vectors())),
        op_(std::move(part.families), sections(), boundary().elastic_supports, part.column_block,
            constraints().pending(cells_.positions.size())),
        seen_(geometry::positions_inside_faces(cells_)),
        number_(std::move(part.number)) {}

  std::size_t points() const override { return op_.points(); }
  void internal_force(const State& state, Forces& forces) const override { op_.internal_force(state, forces); }
  void internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const override {
    op_.internal_force_overlapped(state, rest, forces);
  }
  void absolute_product(const State& state, Forces& forces) const override { op_.absolute_product(state, forces); }
  Forces diagonal() const override { return op_.diagonal(); }

  const geometry::Families& families() const override { return op_.families().families; }
  Eigen::VectorXd energies(const State& state) const override { return op_.energies(state); }
  Resultants resultants(const State& state) const override {
    return plate::resultants(state, op_.families(), sections());
  }
  std::vector<PlaceShare> interpolation(const Point& at) const override {
    std::call_once(located_, [&] { locate_.emplace(cells_); });
    return plate::interpolation(*locate_, cells_.units.spacing, at);
  }
  Mesh mesh() const override {
    return {cells_.positions,
            cloud().areas,
            cut(),
            cells_.squares,
            cells_.triangles,
            cells_.units.spacing,
            section().thickness,
            {},
            0,
            {},
            number_};
  }
  std::vector<double> cut_at(const StartOfCracks& start) const override;
  std::unique_ptr<TipView> tip_view() const override {
    return std::make_unique<GalerkinView>(cells_, op_.families(), seen_, shapes_, problem(), sections());
  }
  /// The consistent mass of its cells.
  Inertia inertia(double rotary) const override { return {sections(), cells_, constraints(), rotary}; }
  ChosenPreconditioner preconditioner(Preconditioning wanted) const override;
  std::unique_ptr<Preconditioner> inverse_of_shifted(double shift) const override;
  std::vector<FacePair> face_pairs() const override { return facing_points(cells_, boundary().map); }
  PointMatrix stiffness() const override { return stiffness_matrix(op_); }
  std::unique_ptr<Stretching> stretching() const override {
    const auto& families = op_.families();
    auto plane = std::make_unique<GalerkinStretching>(
        families, sections(),
        section().couples() ? std::optional(galerkin_coupling(families, section())) : std::nullopt);
    auto beams = axial_elements(problem(), cells_, boundary().map);
    if (beams.empty()) return plane;
    return std::make_unique<StretchedStiffeners>(std::move(plane), std::move(beams));
  }
  std::unique_ptr<Formulation> middle_plane() const override {
    Stopwatch ignored;
    return std::make_unique<GalerkinPlate>(
        discretised_part(membrane_of(problem()), paths(), cells_, communicator(), ignored));
  }
  PointMatrix coupling() const override {
    auto by_section = section().couples() ? coupling_matrix(op_.families(), section())
                                          : zeros(points(), [](Column&, std::uint32_t) {});
    return with(std::move(by_section), elastic_supports_of(coupling_of(problem()), cells_));
  }
  MassOffsets mass_offsets() const override;
  PointMatrix with_coupling_forces(PointMatrix geometric, const State& bending, const State& in_plane) const override;
  std::unique_ptr<Preconditioner> factor() const override {
    if (distributed()) return std::make_unique<DistributedFactor>(op_, boundary(), stiffness_matrix(op_));
    return std::make_unique<AssembledPlate>(op_, constraints(), stiffness_matrix(op_));
  }
  std::vector<MemoryPart> memory(bool single) const override;
  std::vector<std::string> warnings(bool factors) const override;
  std::string remedy() const override;

private:
  std::unique_ptr<Preconditioner> multigrid() const;

  geometry::Tessellation cells_;
  std::vector<BondShape> shapes_;
  GalerkinOperator op_;
  std::vector<Point> seen_;            // geometry::positions_inside_faces()
  std::vector<std::uint32_t> number_;  // in the global plate, where it is distributed
  mutable std::once_flag located_;
  mutable std::optional<geometry::CellLocator> locate_;  // from the first place on
};

std::vector<double> GalerkinPlate::cut_at(const StartOfCracks& start) const {
  const double tolerance = 1e-6 * cells_.units.spacing;
  std::vector<double> result(cut().size(), 0);
  for (std::size_t k = 0; k < result.size(); ++k)
    if (std::ranges::any_of(start.cracks, [&](const auto& crack) {
          return geometry::distance(crack, cells_.positions[k]) <= tolerance;
        }))
      result[k] = cut()[k];
  return result;
}

MassOffsets GalerkinPlate::mass_offsets() const {
  MassOffsets result;
  result.first = section().first_moment() * Eigen::Map<const Eigen::VectorXd>(cloud().areas.data(), Index(points()));
  result.second = Eigen::VectorXd::Zero(Index(points()));
  const auto add = [&](int power, Eigen::VectorXd& sum) {
    const auto masses = stiffener_masses(problem(), cells_, power);
    if (!masses.empty()) sum += Eigen::Map<const Eigen::VectorXd>(masses.data(), Index(masses.size()));
  };
  add(1, result.first), add(2, result.second);
  return result;
}

PointMatrix GalerkinPlate::with_coupling_forces(PointMatrix geometric, const State& bending,
                                                const State& in_plane) const {
  if (section().law == PlateLaw::bending && section().couples()) {
    auto moments = resultants(bending), forces = moments;
    forces.moments.setZero();
    couple(moments, forces, section());
    plate::add(GalerkinStretching(op_.families(), sections()).stiffness_of_forces(forces.moments), 1, geometric);
  }
  return with(std::move(geometric), axial_forces_of(problem(), cells_, boundary().map, bending, in_plane));
}

std::unique_ptr<Preconditioner> GalerkinPlate::multigrid() const {
  auto coarser = multigrid_levels(*this, seen_);
  if (coarser.empty()) return factor();
  return std::make_unique<GalerkinMultigrid>(op_, constraints(), seen_, std::move(coarser));
}

ChosenPreconditioner GalerkinPlate::preconditioner(Preconditioning wanted) const {
  if (wanted == Preconditioning::diagonal) return {nullptr, "diagonal"};
  if (wanted == Preconditioning::automatic)
    wanted = usual_preconditioner_of_cells(problem(), double(points_of_all(boundary())));
  if (wanted == Preconditioning::automatic) return {factor(), "factor"};
  return {multigrid(), "levels"};
}

/// Coarser plates alone do not see the rigid motions of a plate that nothing holds.
std::unique_ptr<Preconditioner> GalerkinPlate::inverse_of_shifted(double shift) const {
  if (held()) return preconditioner(Preconditioning::levels).inverse;
  constexpr std::size_t many = 100000;  // points
  if (distributed() || points() > many) return nullptr;
  return std::make_unique<AssembledPlate>(op_, constraints(), plus(stiffness_matrix(op_), shift * mass()));
}

std::vector<MemoryPart> GalerkinPlate::memory(bool) const {
  return {
      {"weights of the families, rows and bonds", "parameters", double(op_.bytes())},
      {"cells", "geometry",
       bytes_of(cells_.positions) + bytes_of(cells_.squares) + bytes_of(cells_.triangles) + bytes_of(cells_.borders)}};
}

/// Round holes that are held and smaller than two spacings: 2 to 15 % in deflections of plates that nothing else holds.
std::vector<std::string> warnings_about_small_holes(const Problem& problem) {
  constexpr double least = 2;
  const double spacing = problem.discretization.hole_spacing.value_or(problem.discretization.spacing);
  std::vector<std::string> result;
  for (const auto& hole : problem.outline.holes) {
    const auto* circle = std::get_if<geometry::Circle>(&hole);
    const auto holds = [&](const Support& s) {
      return !s.holds_nothing() && std::ranges::find(s.edges, circle->name) != s.edges.end();
    };
    if (circle && circle->radius < least * spacing && std::ranges::any_of(problem.supports, holds))
      result.push_back(
          fmt::format("{} is held and has a radius of {:.2g} spacings: deflections may be some percent off; set "
                      "`hole_spacing` = {:.2g}",
                      circle->name, circle->radius / spacing, circle->radius / 4));
  }
  return result;
}

std::vector<std::string> GalerkinPlate::warnings(bool) const {
  return warnings_about_small_holes(problem());
}

std::string GalerkinPlate::remedy() const {
  return fmt::format("set `spacing` or tip_spacing = {:.2g}",
                     std::min(section().layer() / 3, discretization().spacing_at_tips() / 2));
}

Discretised discretised(const Problem& problem, const Communicator& all) {
  Discretised result;
  auto& stopwatch = result.stopwatch;
  auto paths = crack_paths(problem);
  auto cells = required_cells(problem, paths, all.distributed());
  stopwatch.lap("geometry");
  if (has_plane(problem))
    result.membrane =
        std::make_unique<GalerkinPlate>(discretised_part(membrane_of(problem), paths, cells, all, stopwatch));
  result.plate =
      std::make_unique<GalerkinPlate>(discretised_part(problem, std::move(paths), std::move(cells), all, stopwatch));
  stopwatch.lap("parameters");
  return result;
}

}  // namespace

/// A plate of few points is solved by its own factor. On a lattice coarser plates cost little; triangles have to be
/// found anew for each of them, and follow the finer ones badly: 142,000 points took 36 s of a core with them, 5 s with
/// the factor (theory.md, "Statics" of the Galerkin plate).
Preconditioning usual_preconditioner_of_cells(const Problem& problem, double points) {
  constexpr double few = 2000, some = 100000;
  const auto& d = problem.discretization;
  const double bytes = 850 * points * std::log2(points + 2);  // of the factor, measured
  const bool graded = d.tip_spacing || d.hole_spacing;
  const bool factor = points <= few || (graded && (points <= some || bytes < free_memory() / 2));
  return factor ? Preconditioning::automatic : Preconditioning::levels;
}

const FormulationKind galerkin{
    "galerkin",
    "the Galerkin plate",
    {{Feature::horizon, "its families are the points of the cells about a point"},
     {Feature::influence, "its families are the points of the cells about a point"},
     {Feature::volume_correction, "its families end at whole cells"},
     {Feature::surface_correction, "points lie on edges and cracks, nothing is to be corrected there"},
     {Feature::full_horizon, "its families need no calibration"},
     {Feature::surface_nodes, "its points lie on the edges themselves"},
     {Feature::twist_match, "its families need no calibration"},
     {Feature::layers,
      "a layer outside the plate has no meaning with formulation = \"galerkin\", whose points lie on the edges"},
     {Feature::short_horizon, "the plate with a short horizon is of formulation = \"ordinary\""},
     {Feature::single_precision, "\"mixed\" is of formulation = \"ordinary\""},
     {Feature::breaking_bonds, "bonds that break one by one are bonds over a horizon"},
     {Feature::running_tips, "growth in motion severs bonds over a horizon"}},
    discretised};

}  // namespace plate
