// A third formulation of the plate, the bare list of its bonds with constant parameters, goes through statics,
// dynamics, frequencies, intensity factors and files without a line of the program that knows it.

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/horizon_parameters.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/bonds/results.hpp"
#include "plate/bonds/supports.hpp"
#include "plate/bonds/visibility.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/layout.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/nodal_forces.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/unit/post/xml.hpp"

namespace {

using plate::Forces, plate::State;
namespace fs = std::filesystem;

/// A bond between two points, each pair once, with twice what both ends give to it.
struct Bond {
  std::uint32_t k, j;
  double mx, my, length, curvature, shear;
};

class BareBonds : public plate::Formulation {
public:
  BareBonds(plate::Layout layout, geometry::Families families, std::vector<plate::BondShape> shapes)
      : Formulation(std::move(layout)), families_(std::move(families)), shapes_(std::move(shapes)) {
    const auto p = plate::disc_parameters(section(), discretization().influence, discretization().horizon());
    const auto& A = cloud().areas;
    for (std::uint32_t k = 0; k < points(); ++k)
      for (const auto& [j, id] : families_[k]) {
        if (j < k || !(boundary().active[k] || boundary().active[j])) continue;
        const auto& s = shapes_[id];
        const double ends = (boundary().active[k] ? 2.0 : 0.0) + (boundary().active[j] ? 2.0 : 0.0);
        bonds_.push_back(
            {k, j, s.mx, s.my, s.length, ends * A[k] * A[j] * p.b * s.weight, ends * A[k] * A[j] * p.C * s.weight / 4});
      }
  }

  std::size_t points() const override { return cloud().size(); }
  void internal_force(const State& u, Forces& f) const override { product(u, f, -1); }
  void absolute_product(const State& u, Forces& f) const override { product(u, f, +1); }
  Forces diagonal() const override {
    Forces d = Forces::Zero(3, Eigen::Index(points()));
    for (const auto& b : bonds_)
      for (const auto i : {b.k, b.j}) {
        const double lever = b.length * b.length / 4 * b.shear;
        d.col(i) += Eigen::Vector3d(b.shear, (b.curvature + lever) * b.mx * b.mx, (b.curvature + lever) * b.my * b.my);
      }
    return d;
  }

  const geometry::Families& families() const override { return families_; }
  Eigen::VectorXd energies(const State& u) const override {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(points()));
    for (const auto& b : bonds_) {
      const double s = curvature_difference(b, at(u, b.k), at(u, b.j)), g = shear_difference(b, at(u, b.k), at(u, b.j));
      const double energy = (b.curvature * s * s + b.shear * g * g) / 2;
      result[b.k] += energy / 2, result[b.j] += energy / 2;
    }
    return result;
  }
  plate::Resultants resultants(const State& u) const override {
    return plate::resultants(u, families_, shapes_, cloud().areas, cloud().plate_points, section());
  }
  std::vector<plate::PlaceShare> interpolation(const geometry::Point& x) const override {
    return {{std::uint32_t(geometry::nearest_plate_point(cloud(), x)), 1.0}};
  }
  plate::Mesh mesh() const override {
    return plate::mesh(boundary(), problem().outline, paths(), cut(), section().thickness);
  }
  std::vector<double> cut_at(const plate::StartOfCracks& start) const override { return start.cut; }
  std::unique_ptr<plate::TipView> tip_view() const override {
    return std::make_unique<plate::BondView>(cloud(), families_, shapes_, section(), discretization());
  }
  plate::ChosenPreconditioner preconditioner(plate::Preconditioning) const override { return {nullptr, "diagonal"}; }
  std::vector<plate::MemoryPart> memory(bool) const override {
    return {{"bonds", "parameters", double(bonds_.size() * sizeof(Bond))}};
  }
  std::vector<std::string> warnings(bool) const override { return {"bare bonds; set another formulation"}; }
  std::string remedy() const override { return "set another formulation"; }

private:
  static plate::Kinematics<> at(const State& u, std::uint32_t k) { return {u(0, k), u(1, k), u(2, k)}; }

  /// -K u, or |K| u of a state without negative entries.
  void product(const State& u, Forces& f, int sign) const {
    f = Forces::Zero(3, Eigen::Index(points()));
    for (const auto& b : bonds_) {
      const auto k = at(u, b.k), j = at(u, b.j);
      if (sign < 0) {
        const double s = curvature_difference(b, k, j), g = shear_difference(b, k, j);
        const double bend = b.curvature * s, force = b.shear * g, lever = force * b.length / 2;
        f.col(b.k) += Eigen::Vector3d(force, b.mx * (bend + lever), b.my * (bend + lever));
        f.col(b.j) += Eigen::Vector3d(-force, b.mx * (lever - bend), b.my * (lever - bend));
        continue;
      }
      const double mx = std::abs(b.mx), my = std::abs(b.my);
      const double s = mx * (j.theta_x + k.theta_x) + my * (j.theta_y + k.theta_y), g = j.w + k.w + b.length / 2 * s;
      const double couple = b.curvature * s + b.shear * g * b.length / 2;
      for (const auto i : {b.k, b.j}) f.col(i) += Eigen::Vector3d(b.shear * g, mx * couple, my * couple);
    }
  }

  geometry::Families families_;
  std::vector<plate::BondShape> shapes_;
  std::vector<Bond> bonds_;
};

plate::Discretised bare_bonds(const plate::Problem& problem, const plate::Communicator&) {
  const auto& d = problem.discretization;
  auto paths = plate::crack_paths(problem);
  auto cloud = geometry::lattice(problem.outline, d.spacing);
  const auto outline = geometry::to_lattice(problem.outline, cloud.units);
  plate::Layout layout{
      problem, {}, geometry::tips(paths), plate::boundary(std::move(cloud), outline, problem.supports, d), {}, {}};
  const auto& boundary = layout.boundary;
  const auto whole = geometry::families(boundary.cloud, d.horizon(), plate::sees(boundary, outline, d.horizon_ratio));
  auto families = plate::without_crossing_bonds(boundary, whole, geometry::to_lattice(paths, boundary.cloud.units),
                                                d.horizon_ratio);
  auto shapes = plate::bond_shapes(families.vectors(), problem.section, d);
  layout.pieces = plate::pieces(boundary, families);
  layout.cut = plate::cut_share(whole, families, shapes, boundary.cloud.plate_points);
  for (const auto& one : problem.loads)
    layout.loads.push_back({nodal_forces(one, boundary.cloud, problem.outline), one.history});
  layout.paths = std::move(paths);
  plate::Discretised result;
  result.plate = std::make_unique<BareBonds>(std::move(layout), std::move(families), std::move(shapes));
  return result;
}

using plate::Feature;
const plate::FormulationKind bare{"bare_bonds",
                                  "bare bonds",
                                  {{Feature::levels, "it has one level"},
                                   {Feature::factor, "it has no matrix"},
                                   {Feature::short_horizon, "it has one horizon"},
                                   {Feature::graded_points, "its points are those of a lattice"},
                                   {Feature::single_precision, "it is in double precision"},
                                   {Feature::lanczos, "points outside the plate have no mass"},
                                   {Feature::stretching, "it has no plane"},
                                   {Feature::touching_faces, "it has no plane"},
                                   {Feature::breaking_bonds, "its bonds hold"},
                                   {Feature::running_tips, "its bonds hold"}},
                                  bare_bonds};

/// Bond-based plates have a Poisson's ratio of 1/3.
cases::CaseFile cracked_plate(const plate::FormulationKind& kind) {
  cases::CaseFile file;
  auto& c = file.content;
  c.title = "third formulation";
  c.section = {1000, 1.0 / 3, 0.2, 5.0 / 6, 1};
  c.outline = geometry::rectangle(-1, -1, 1, 1);
  c.cracks = {{{-0.3, 0}, {0.3, 0}}};
  c.discretization.spacing = 0.025;
  c.discretization.surface_correction = plate::SurfaceCorrection::none;
  c.discretization.formulation = &kind;
  c.supports = {{plate::SupportKind::simply_supported, {"bottom", "top"}, {}}};
  c.loads = {plate::Load{plate::Pressure{.value = 1}}};
  c.srif.emplace();
  c.output.probes["side"] = {0.9875, 0.0125};
  return file;
}

}  // namespace

TEST_CASE("third formulation: in statics as the ordinary plate with the same parameters, with factors and files") {
  const small_run::TemporaryFolder folder;
  const auto ours = cases::run(cracked_plate(bare), {folder / "bare", true});
  const auto theirs = cases::run(cracked_plate(plate::ordinary), {folder / "ordinary", true});
  CHECK(ours.formulation == "bare_bonds");
  CHECK(ours.scene.size() > 2);
  CHECK(std::ranges::find(ours.warnings, "bare bonds; set another formulation") != ours.warnings.end());
  // the dilatation of the ordinary plate is nothing at this Poisson's ratio: one and the same plate
  REQUIRE(ours.energy.front().second > 0);
  CHECK(ours.energy.front().second == Approx(theirs.energy.front().second).epsilon(1e-5));
  REQUIRE(ours.srif.size() == theirs.srif.size());
  REQUIRE(ours.srif.size() >= 2);
  CHECK(ours.srif.front().K1 > 0);
  CHECK(ours.srif.front().K1 == Approx(theirs.srif.front().K1).epsilon(1e-4));
  for (const char* name : {"fields.pvd", "fields_0000.vtu"})
    CHECK(xml::error(small_run::text_of(folder / "bare" / name)) == "");
  CHECK(fs::file_size(folder / "bare/state.h5") > 1000);
}

TEST_CASE("third formulation: in motion it conserves energy, and its frequencies are those of the ordinary plate") {
  const small_run::TemporaryFolder folder;
  auto moving = cracked_plate(bare);
  moving.content.analysis.kind = cases::Analysis::Kind::dynamic;
  moving.content.analysis.method = cases::Analysis::Method::central_difference;
  moving.content.analysis.duration = 0.5;
  cases::run(moving, {folder / "moving", true});
  const auto history = post::read_csv(folder / "moving/history.csv");
  const auto energy = [&](const std::vector<post::Cell>& row) {
    return std::get<double>(row[history.column("discrete_energy")]);
  };
  REQUIRE(history.rows.size() > 100);
  const double work = std::get<double>(history.rows.back()[history.column("external_work")]);
  for (const auto& row : history.rows)
    CHECK(std::abs(energy(row) - energy(history.rows.front())) < 1e-9 * std::abs(work));

  for (const auto* kind : {&bare, &plate::ordinary}) {
    auto file = cracked_plate(*kind);
    file.content.srif.reset();
    file.content.loads.clear();
    file.content.analysis.kind = cases::Analysis::Kind::frequencies;
    file.content.analysis.method = cases::Analysis::Method::lanczos;
    file.content.analysis.tolerance = 1e-6;
    file.content.analysis.modes = 3;
    cases::run(file, {folder / kind->name, true});
  }
  const auto ours = post::read_csv(folder / "bare_bonds/frequencies.csv"),
             theirs = post::read_csv(folder / "ordinary/frequencies.csv");
  REQUIRE(ours.rows.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(std::get<double>(ours.rows[i][1]) == Approx(std::get<double>(theirs.rows[i][1])).epsilon(1e-5));
}
