#include "cases/driver/assembly.hpp"

#include <algorithm>
#include "cases/driver/assembly_checks.hpp"
#include "cases/driver/assembly_galerkin.hpp"
#include "cases/driver/lattice_checks.hpp"
#include "cases/driver/trust.hpp"
#include "geometry/lattice/seeding.hpp"

namespace cases {
namespace {

using Seconds = std::chrono::duration<double>;

std::vector<plate::TimedLoad> timed_loads(const Case& c, const geometry::Cloud& cloud) {
  std::vector<plate::TimedLoad> loads;
  for (const auto& load : c.loads) loads.push_back({plate::nodal_forces(load, cloud, c.outline), load.history});
  return loads;
}

struct Weights {
  plate::HorizonWeights weights;
  std::optional<plate::MatchCounts> counts;
};

Weights horizon_weights(const Case& c, const plate::Boundary& boundary, const geometry::Families& families,
                        const std::vector<plate::BondShape>& shapes) {
  const auto& areas = boundary.cloud.areas;
  const auto kinds = plate::family_kinds(families, areas, boundary.active);
  if (c.discretization.surface_correction == plate::SurfaceCorrection::position_aware) {
    auto found = plate::position_aware(families, shapes, areas, boundary.active, kinds, c.section);
    return {std::move(found.weights), found.counts};
  }
  const auto parameters =
      plate::horizon_parameters(families, shapes, areas, boundary.active, c.section, c.discretization);
  return {plate::weights_of_parameters(families, shapes, areas, kinds, parameters), std::nullopt};
}

Assembly assemble_ordinary(const CaseFile& file, std::vector<geometry::CrackPath> paths, Stopwatch& stopwatch) {
  const Case& c = file.content;
  const auto& d = c.discretization;
  auto cloud = geometry::lattice(c.outline, d.spacing);
  const auto outline = geometry::to_lattice(c.outline, cloud.units);
  std::vector<std::string> warnings;
  check_lattice(file, cloud, outline, warnings);
  auto boundary = plate::boundary(std::move(cloud), outline, c.supports, d);
  warnings.insert(warnings.end(), boundary.warnings.begin(), boundary.warnings.end());
  check_edges_fit(boundary, d.spacing, warnings);
  check_modes(file, boundary);
  stopwatch.lap("geometry");

  const auto whole = geometry::families(boundary.cloud, d.horizon(), plate::sees(boundary, outline, d.horizon_ratio));
  auto families = fracture::sever(boundary, whole, geometry::to_lattice(paths, boundary.cloud.units), d.horizon_ratio);
  const auto pieces = plate::pieces(boundary, families);
  check_held(file, pieces, warnings);
  warn_of_distrust(c, boundary, warnings);
  stopwatch.lap("families");

  auto shapes = plate::bond_shapes(families.vectors(), c.section, d);
  check_weights(file, shapes);
  auto cut = fracture::cut_share(whole, families, shapes, boundary.cloud.plate_points);
  const auto& areas = boundary.cloud.areas;
  auto loads = timed_loads(c, boundary.cloud);
  plate::Forces load = plate::Forces::Zero(3, Eigen::Index(boundary.cloud.size()));
  for (const auto& one : loads) load += one.forces;
  const auto mechanisms = plate::mechanisms(boundary, families, pieces, load);
  check_mechanisms(file, mechanisms, warnings);
  auto [weights, counts] = horizon_weights(c, boundary, families, shapes);
  plate::LatticeOperator plate(plate::FamilyOperator(std::move(families), std::move(shapes), areas, std::move(weights)));
  stopwatch.lap("parameters");

  const auto tips = geometry::tips(paths);
  return {std::move(paths),
          tips,
          std::move(boundary),
          std::move(cut),
          std::move(plate),
          counts,
          std::move(loads),
          std::move(warnings),
          mechanisms.motions > 0 || !mechanisms.searched};
}

}  // namespace

void Stopwatch::lap(const std::string& stage) {
  const auto now = std::chrono::steady_clock::now();
  add(stage, Seconds(now - last_).count());
  last_ = now;
}

void Stopwatch::add(const Stopwatch& other) {
  for (const auto& [stage, spent] : other.seconds_) add(stage, spent);
}

void Stopwatch::add(const std::string& stage, double spent) {
  const auto entry = std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& s) { return s.first == stage; });
  if (entry == seconds_.end())
    seconds_.emplace_back(stage, spent);
  else
    entry->second += spent;
}

double Stopwatch::seconds(const std::string& stage) const {
  for (const auto& [name, spent] : seconds_)
    if (name == stage) return spent;
  return 0;
}

double Stopwatch::total() const {
  double sum = 0;
  for (const auto& [stage, seconds] : seconds_) sum += seconds;
  return sum;
}

plate::Forces mass_of(const Case& c, const Assembly& assembly) {
  const auto& boundary = assembly.boundary;
  return plate::mass(c.section, boundary.cloud.areas, boundary.active, boundary.constraints, c.analysis.rotary_inertia);
}

const plate::Operator& Assembly::plate() const {
  if (const auto* plate = galerkin()) return plate->op;
  return *ordinary();
}

const geometry::Families& Assembly::families() const {
  return galerkin() ? galerkin()->op.families().families : ordinary()->families();
}

double Assembly::strain_energy(const plate::State& state) const {
  return (galerkin() ? galerkin()->op.energies(state) : ordinary()->energies(state)).sum();
}

std::size_t Assembly::bonds() const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < boundary.cloud.plate_points; ++k)
    for (const auto& bond : families()[k]) count += boundary.is_plate(bond.neighbour);
  return count;
}

std::size_t Assembly::fictitious_bonds() const {
  return families().bonds() - bonds();
}

Assembly assemble(const CaseFile& file, Stopwatch& stopwatch) {
  const Case& c = file.content;
  const auto [low, high] = geometry::bounding_box(c.outline);
  auto paths = geometry::crack_paths(c.outline, c.cracks, 1e-9 * (high - low).norm());
  return c.discretization.formulation == plate::Formulation::galerkin
             ? assemble_galerkin(file, std::move(paths), stopwatch)
             : assemble_ordinary(file, std::move(paths), stopwatch);
}

}  // namespace cases
