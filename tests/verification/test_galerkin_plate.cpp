// The Galerkin plate of the program: patch tests, locking, spectrum, convergence. Figures to compare with are those of
// the formulation's first implementation (theory.md, "The Galerkin plate").

#include "plate/formulation/sections.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"
#include "tests/verification/exact.hpp"
#include "tests/verification/galerkin/plate.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
namespace gp = galerkin_plate;
namespace gs = galerkin_systems;
using geometry::Point;

namespace {

cases::Case in_galerkin(cases::Case c) {
  c.discretization.formulation = &plate::galerkin;
  return c;
}

Section of_thickness(double thickness, double poisson = 0.3) {
  Section s = gp::section;
  s.thickness = thickness, s.poisson = poisson;
  return s;
}

/// Constant shear angles gamma: w = gamma . x, psi = 0.
State sheared(const geometry::Tessellation& cells, const Point& gamma) {
  State u = State::Zero(3, Eigen::Index(cells.positions.size()));
  for (Eigen::Index k = 0; k < u.cols(); ++k) u(0, k) = gamma.dot(cells.positions[std::size_t(k)]);
  return u;
}

/// What holds constant shear in balance: Q . n on all edges, and -Q as a couple on the rotations.
Forces shear_load(const geometry::Tessellation& cells, const GalerkinFamilies& families, const Point& Q) {
  Forces sum = Forces::Zero(3, Eigen::Index(families.areas.size()));
  for (const auto& border : cells.borders) {
    const Point along = (cells.positions[border.to] - cells.positions[border.from]).normalized();
    geometry::Tessellation one = cells;
    one.borders = {{border.from, border.to, 0}};
    one.names = {"edge"};
    const Load load{EdgeShear{.edges = {"edge"}, .value = Q.dot(Point(along.y(), -along.x()))}};
    sum += nodal_forces(load, one, families.areas);
  }
  for (Eigen::Index k = 0; k < sum.cols(); ++k) {
    const Point couple = -families.areas[std::size_t(k)] * Q;
    sum.col(k) += Eigen::Vector3d(0, couple.y(), -couple.x());
  }
  return sum;
}

/// At rest, by the factor of the plate.
State by_factor(const Formulation& a) {
  return dynamic_cast<const AssembledPlate&>(*a.factor()).solve({a.total_load()})[0];
}

/// Error of the deflection at the middle of a square of side 1 under unit pressure, in percent.
double centre_error(int cells, double thickness, SupportKind kind) {
  auto c = in_galerkin(vp::free_plate(geometry::rectangle(0, 0, 1, 1), 1.0 / cells));
  c.section = of_thickness(thickness);
  c.supports = {vp::held_all_round(kind)};
  const auto a = vp::assembled(c);
  const double w = by_factor(*a)(0, Eigen::Index(geometry::nearest_plate_point(a->cloud(), {0.5, 0.5})));
  gs::Plate plate;
  plate.thickness = thickness;
  const double exact = kind == SupportKind::clamped ? gs::ritz_deflection(plate, gs::Held::clamped, 22)
                                                    : exact::navier_deflection(c.section, 1, 1, 1, 0.5, 0.5);
  return 100 * (w / exact - 1);
}

}  // namespace

TEST_CASE("Galerkin plate: constant curvature and constant shear are solutions on any points") {
  for (const auto& cells : gp::scenes())
    for (const double thickness : {0.1, 0.001}) {
      const auto families = gp::families(cells);
      const Section section = of_thickness(thickness);
      const GalerkinOperator op(families, section);
      const double D = section.bending_stiffness(), rounding = thickness == 0.1 ? 1e-11 : 1e-8;
      for (const Eigen::Vector3d& k : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {0, 0, 1}}) {
        EdgeMoment moment{.edges = cells.names,
                          .tensor = {{-D * (k[0] + 0.3 * k[1]), -D * (k[1] + 0.3 * k[0]), -D * 0.7 * k[2]}}};
        moment.edges.push_back("crack");
        const Load load{moment};
        auto named = cells;
        named.names.push_back("crack");
        for (auto& border : named.borders)
          if (border.edge < 0) border.edge = std::int32_t(named.names.size()) - 1;
        Forces force;
        op.internal_force(gp::bent(cells, k[0], k[1], k[2]), force);
        const Forces edge = nodal_forces(load, named, families.areas);
        const double off = (force + edge).cwiseAbs().maxCoeff() / edge.cwiseAbs().maxCoeff();
        CHECK(off < rounding);  // measured: 9e-13; 2e-11 for the thin plate
      }
      const Point gamma(1, 0.5);
      Forces force;
      op.internal_force(sheared(cells, gamma), force);
      const GalerkinStiffness stiffness(section, families.square(0));
      const Forces load = shear_load(cells, families, stiffness.shear * gamma);
      const double off = (force + load).cwiseAbs().maxCoeff() / load.cwiseAbs().maxCoeff();
      if (!cells.graded) CHECK(off < rounding);  // measured: 4e-15
    }
}

TEST_CASE("Galerkin plate: deflections of squares, thick to thin, do not lock") {
  struct Row {
    double thickness;
    std::array<double, 3> simply, clamped;  // percent, with 8, 16 and 32 cells: measured
  };
  for (const auto& row :
       {Row{0.1, {0.52, 0.152, 0.0413}, {8.20, 2.23, 0.575}}, Row{0.01, {0.30, 0.088, 0.0254}, {8.31, 2.58, 0.727}},
        Row{0.001, {0.30, 0.086, 0.0240}, {8.12, 2.49, 0.700}},
        Row{0.0001, {0.30, 0.086, 0.0240}, {8.12, 2.49, 0.699}}})
    for (std::size_t i = 0; i < 3; ++i) {
      const int cells = 8 << i;
      INFO("thickness " << row.thickness << ", " << cells << " cells");
      CHECK(centre_error(cells, row.thickness, SupportKind::simply_supported_hard) ==
            Approx(row.simply[i]).epsilon(0.02));
      CHECK(centre_error(cells, row.thickness, SupportKind::clamped) == Approx(row.clamped[i]).epsilon(0.02));
    }
}

TEST_CASE("Galerkin plate: a cantilever converges with the second order") {
  double w_before = 0, psi_before = 0;
  for (const double spacing : {0.1, 0.05, 0.025}) {
    auto c = in_galerkin(vp::free_plate(geometry::rectangle(0, 0, 1.2, 0.8), spacing));
    c.section = of_thickness(0.1, 0);
    c.supports = {vp::held(SupportKind::clamped, {"left"})};
    c.loads = {Load{EdgeShear{.edges = {"right"}, .value = 1}}};
    const auto a = vp::assembled(c);
    const State u = by_factor(*a);
    const double L = 1.2, D = c.section.bending_stiffness(), S = c.section.shear_stiffness();
    const double w_end = L * L * L / (3 * D) + L / S, psi_end = L * L / (2 * D);
    double w_off = 0, psi_off = 0;
    for (Eigen::Index k = 0; k < u.cols(); ++k) {
      const double x = a->cloud().positions[std::size_t(k)].x();
      w_off = std::max(w_off, std::abs(u(0, k) - (L * x * x / 2 - x * x * x / 6) / D - x / S) / w_end);
      psi_off = std::max(psi_off, std::abs(-u(2, k) - (L * x - x * x / 2) / D) / psi_end);
    }
    CAPTURE(spacing, w_off, psi_off);
    if (w_before > 0) {
      CHECK(std::log2(w_before / w_off) > 1.9);      // measured: 1.97, 1.99
      CHECK(std::log2(psi_before / psi_off) > 1.9);  // measured: 1.94, 1.94
    }
    if (spacing == 0.05) CHECK(w_off < 6.4e-4);    // measured: 6.25e-4
    if (spacing == 0.05) CHECK(psi_off < 1.1e-3);  // measured: 1.08e-3
    w_before = w_off, psi_before = psi_off;
  }
}

TEST_CASE("Galerkin plate: spectrum of a free square") {
  struct Row {
    double thickness;
    std::array<double, 5> off;  // percent of f4, f6, f10, f20, f30: measured
  };
  for (const auto& row :
       {Row{0.1, {-0.102, -0.912, -1.995, -3.374, -5.811}}, Row{0.01, {-0.424, -0.954, -2.084, -3.558, -5.620}}}) {
    auto c = in_galerkin(vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.05));
    c.section = of_thickness(row.thickness);
    c.section.density = 1;
    const auto a = vp::assembled(c);
    const Eigen::MatrixXd K = gp::stiffness(gp::families(gp::cells(c.outline, c.discretization.spacing)), c.section);
    const Eigen::VectorXd root = a->mass().reshaped<Eigen::ColMajor>().cwiseSqrt().cwiseInverse();
    const Eigen::VectorXd values = dense::eigenvalues(dense::scaled(K, root));
    gs::Plate plate;
    plate.thickness = row.thickness;
    const Eigen::VectorXd ritz = gs::ritz_frequencies(plate, 14);
    const std::array<int, 5> modes{4, 6, 10, 20, 30};
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const auto n = Eigen::Index(modes[i] - 1);
      CHECK(100 * (std::sqrt(values[n] / ritz[n]) - 1) == Approx(row.off[i]).margin(0.02));
    }
  }
}

TEST_CASE("Galerkin plate: moments about a hole against Reissner's closed form") {
  // half a side of 40 radii: the edges change the moments at the hole by about its square, 0.1 %
  for (const double thickness : {0.5, 1.0, 2.0}) {
    std::vector<double> error;
    for (const double at_hole : {0.1, 0.05}) {
      auto outline = geometry::rectangle(-40, -40, 40, 40);
      outline.holes.push_back(geometry::Circle{{0, 0}, 1, "hole0"});
      auto c = in_galerkin(vp::free_plate(outline, 4));
      c.section = of_thickness(thickness);
      c.discretization.hole_spacing = at_hole, c.discretization.spacing_growth = 2 * at_hole;
      c.supports = {{SupportKind::pinned, {}, {{-40, -40}, {40, -40}, {40, 40}}}};
      c.loads = {Load{EdgeMoment{.edges = {"left", "right", "bottom", "top"}, .tensor = {{1, 0, 0}}}}};
      const auto a = vp::assembled(c);
      const State u = by_factor(*a);
      const auto r = a->resultants(u);
      const auto top = Eigen::Index(geometry::nearest_plate_point(a->cloud(), {0, 1}));
      error.push_back(100 * (r.moments(0, top) / exact::hole_moment_concentration(c.section, 1) - 1));
    }
    // the mean over the cells at the edge, which reach inwards: of the first order. Measured: -4.3, -2.5 (h/R = 0.5),
    // -4.8, -2.7 (1), -5.1, -2.8 % (2), and half of that at a fortieth of the radius
    CAPTURE(thickness, error);
    CHECK(std::abs(error[0]) < 5.2);
    CHECK(std::abs(error[1]) < 2.9);
    CHECK(std::log2(error[0] / error[1]) > 0.75);  // measured: 0.80 to 0.86
  }
}
