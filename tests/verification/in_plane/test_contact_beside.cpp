// Cracks whose faces touch beside what else makes a plate nonlinear or couples it to its plane: soil that lifts off,
// ribs on one side. References: beams of Timoshenko on soil from which they lift off, with a hinge that contact of
// faces stiffens, or of plies that are not symmetric; large deflections under small loads; symmetry; energy.
#include <fmt/format.h>
#include <Eigen/LU>
#include <complex>

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "post/files/sinks.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"

using geometry::Point;

namespace {

struct Run {
  post::ResultsInMemory results;
  post::Summary summary;

  explicit Run(const std::string& text, const std::vector<std::string>& changes = {}) {
    const auto file = cases::read_case_text(text, "contact", changes);
    summary = cases::run(file, {.folder = {}, .quiet = true, .in_memory = &results});
  }
  const post::Srif& tip(std::size_t which) const { return *post::recommended(summary.srif).at(which); }
  std::vector<double> column(const std::string& table, const std::string& name) const {
    const auto found = std::ranges::find(results.tables, table, &std::pair<std::string, post::Table>::first);
    REQUIRE(found != results.tables.end());
    std::vector<double> values;
    for (const auto& row : found->second.rows) values.push_back(std::get<double>(row[found->second.column(name)]));
    return values;
  }
  /// A factor at every tip, by displacement extrapolation.
  std::vector<double> extrapolated(const std::string& factor) const {
    std::vector<double> values;
    for (const auto& one : summary.srif)
      if (one.method == post::SrifMethod::displacement_extrapolation)
        values.push_back(factor == "K1"   ? one.K1
                         : factor == "K2" ? one.K2
                         : factor == "K3" ? one.K3
                         : factor == "N1" ? one.membrane->N[0]
                                          : one.membrane->N[1]);
    return values;
  }
  double energy(const std::string& name) const {
    const auto found = std::ranges::find(summary.energy, name, &std::pair<std::string, double>::first);
    return found == summary.energy.end() ? 0 : found->second;
  }
};

double largest_of(const std::vector<double>& values) {
  return *std::ranges::max_element(values);
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

/// Nothing overlaps or is pulled, and what is open is not pressed.
void check_faces(const Run& run) {
  const double size =
      std::max(largest_of(run.column("contact", "opening_top")), largest_of(run.column("contact", "opening_bottom")));
  for (const std::string face : {"top", "bottom"}) {
    const auto opening = run.column("contact", "opening_" + face), pressure = run.column("contact", "pressure_" + face);
    for (std::size_t i = 0; i < opening.size(); ++i) {
      CHECK(opening[i] >= -1e-9 * size);
      CHECK(pressure[i] >= 0);
      CHECK(opening[i] * pressure[i] == 0);
    }
  }
}

/// A half of a beam of Timoshenko on Winkler's soil that pulls nowhere: a spring `hinge` against the rotation of its
/// left end, without shear force there; a force p at x = at. It touches the soil up to c.
struct HalfBeam {
  double D, S, k, hinge, at, p;
  double c = 0, end = 0, rotation = 0, slope = 0;  // end: w at x = 0; slope: of what stands up

  void solve() {
    const double lambda = std::pow(k / (4 * D), 0.25);
    double low = at + 0.3 / lambda, high = at + 3 / lambda;
    const double sign = lift(low);
    REQUIRE(lift(high) * sign < 0);
    while (high - low > 1e-12) (lift((low + high) / 2) * sign > 0 ? low : high) = (low + high) / 2;
  }

private:
  /// w at the end of the contact, where that is at c.
  double lift(double where) {
    using Complex = std::complex<double>;
    const Complex root = std::sqrt(Complex(k * k / (S * S) - 4 * k / D));
    const Complex one = std::sqrt((k / S + root) / 2.0), other = std::sqrt((k / S - root) / 2.0);
    const std::array<Complex, 4> r{one, -one, other, -other};
    const auto of = [&](double x, std::size_t i) {  // w, psi, M, Q
      const Complex q = r[i], psi = q - k / (S * q), e = std::exp(q * x);
      return std::array<Complex, 4>{e, psi * e, D * q * psi * e, S * (q - psi) * e};
    };
    Eigen::MatrixXcd rows = Eigen::MatrixXcd::Zero(8, 8);
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(8);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto left = of(0, i), here = of(at, i), last = of(where, i);
      const auto a = Eigen::Index(i), b = a + 4;
      rows(0, a) = std::isinf(hinge) ? left[1] : left[2] - hinge * left[1], rows(1, a) = left[3];
      for (std::size_t j = 0; j < 4; ++j)
        rows(Eigen::Index(2 + j), a) = -here[j], rows(Eigen::Index(2 + j), b) = here[j];
      rows(6, b) = last[2], rows(7, b) = last[3];
    }
    right[5] = -p;
    const Eigen::VectorXcd found = rows.fullPivLu().solve(right);
    Complex w = 0, at_end = 0, psi = 0, standing = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto a = found[Eigen::Index(i)], b = found[Eigen::Index(i + 4)];
      w += b * of(where, i)[0], standing += b * of(where, i)[1];
      at_end += a * of(0, i)[0], psi += a * of(0, i)[1];
    }
    c = where, end = at_end.real(), rotation = psi.real(), slope = standing.real();
    return w.real();
  }
};

/// A strip 2 x 0.2 on soil that lifts off.
std::string strip(double spacing, const std::string& formulation, double modulus, const std::string& section,
                  const std::string& more) {
  return fmt::format(
      "[section]\n{}\n[geometry]\noutline = {{ rectangle = [-1.0, 0.0, 1.0, 0.2] }}\n[discretization]\nspacing = {}\n"
      "formulation = \"{}\"\n[[support]]\nkind = \"symmetry\"\nedges = [\"bottom\", \"top\"]\n"
      "[[foundation]]\nmodulus = {:.17g}\nlifts_off = true\n[analysis]\nkind = \"static\"\nmethod = \"cg\"\n"
      "tolerance = 1e-9\n[output]\nprobes = {{ end = [0.9, 0.1] }}\n{}",
      section, spacing, formulation, modulus, more);
}

std::string line_load(double x, double value) {
  return fmt::format("[[load]]\nkind = \"line_load\"\nalong = [[{0}, 0.0], [{0}, 0.2]]\nvalue = {1}\n", x, value);
}

}  // namespace

TEST_CASE("contact on soil: a beam lifts its ends and presses on the hinge that parts it", "[in_plane]") {
  const auto [formulation, lambda] = GENERATE(
      table<std::string, double>({{"galerkin", 3.0}, {"galerkin", 5.0}, {"ordinary", 3.0}, {"ordinary", 5.0}}));
  const double E = 1000, h = 0.1, D = E * h * h * h / 12, S = 5.0 / 6 * E / 2 * h, k = 4 * D * std::pow(lambda, 4);
  HalfBeam exact{.D = D, .S = S, .k = k, .hinge = 3 * D, .at = 0.1, .p = -0.5};  // held 1 away from the crack
  exact.solve();
  const double force = E * h * h * exact.rotation / 2;
  std::vector<double> worst;
  for (const double spacing : {0.05, 0.025}) {
    const Run run(
        strip(spacing, formulation, k, "young = 1000.0\npoisson = 0.0\nthickness = 0.1",
              "[cracks]\ncontact = true\n[[support]]\nkind = \"free\"\nedges = [\"left\", \"right\"]\nin_plane = "
              "\"normal\"\n" +
                  line_load(-0.1, -0.5) + line_load(0.1, -0.5)),
        {"geometry.cracks=[[[0.0,0.0],[0.0,0.2]]]"});
    check_faces(run);
    const double pressure = mean_of(run.column("contact", "pressure_top")) / force - 1,
                 opening = mean_of(run.column("contact", "opening_bottom")) / (2 * h * exact.rotation) - 1,
                 touching = *run.summary.touching - exact.c,
                 end = run.column("probes", "w").back() / (exact.slope * (0.9 - exact.c)) - 1;
    CAPTURE(formulation, lambda, spacing, exact.c, pressure, opening, touching, end);
    CHECK(largest_of(run.column("contact", "pressure_bottom")) == 0);
    CHECK(run.energy("strain") == Approx(run.energy("external_work")).epsilon(1e-8));
    worst.push_back(std::max({std::abs(pressure), std::abs(opening), std::abs(touching), std::abs(end)}));
    CHECK(worst.back() < 0.1);
  }
  CAPTURE(formulation, lambda, worst);
  CHECK(worst[1] < 0.7 * worst[0]);
}

TEST_CASE("coupled on soil: a beam of two unlike plies lifts its ends", "[sections]") {
  const double lambda = GENERATE(3.0, 5.0);
  const bool turned = GENERATE(false, true);  // the stiff ply above
  const double E1 = 1000, E2 = 200, t = 0.05, G = 1e5;
  const double A = (E1 + E2) * t, B = (E1 - E2) * t * t / 2, D = (E1 + E2) * t * t * t / 3 - B * B / A;
  const double k = 4 * D * std::pow(lambda, 4);
  HalfBeam exact{.D = D, .S = 5.0 / 6 * G * 2 * t, .k = k, .hinge = INFINITY, .at = 0.1, .p = -0.5};
  exact.solve();
  const auto ply = [&](double young) {
    return fmt::format(
        "{{ angle = 0.0, thickness = {}, E1 = {}, E2 = 500.0, nu12 = 0.0, G12 = 100.0, G13 = {}, G23 = {} }}", t, young,
        G, G);
  };
  const Run run(strip(0.025, "galerkin", k,
                      fmt::format("plies = [{}, {}]", ply(turned ? E2 : E1), ply(turned ? E1 : E2)),
                      line_load(-0.1, -0.5) + line_load(0.1, -0.5)));
  const double touching = *run.summary.touching - exact.c,
               end = run.column("probes", "w").back() / (exact.slope * (0.9 - exact.c)) - 1;
  CAPTURE(lambda, exact.c, touching, end, D, B * B / A);
  CHECK(std::abs(touching) < 0.005);
  CHECK(std::abs(end) < 0.02);
  CHECK(run.energy("strain") == Approx(run.energy("external_work")).epsilon(1e-8));
  const double coupling = run.energy("coupling");
  CHECK(coupling < 0);
}

namespace {

/// A slab on soil, pressed near a corner, with an oblique crack that a moment closes: turned by quarters and mirrored.
struct Slab {
  std::string formulation = "galerkin";
  int quarters = 0;
  bool mirrored = false;

  std::string at(double x, double y) const {
    if (mirrored) x = -x;
    for (int i = 0; i < quarters; ++i) std::swap(x, y), x = -x;
    return fmt::format("[{:.17g}, {:.17g}]", x, y);
  }
  std::string text() const {
    const auto corner = [&](double x, double y) { return at(x, y); };
    std::string edges = "\"a\", \"b\", \"c\", \"d\"";
    std::string corners = fmt::format("{}, {}, {}, {}", corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
    if (mirrored) {
      corners = fmt::format("{}, {}, {}, {}", corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1));
      edges = "\"d\", \"c\", \"b\", \"a\"";
    }
    return fmt::format(
        "[section]\nyoung = 1000.0\npoisson = 0.3\nthickness = 0.2\ndensity = 1.0\n[geometry]\noutline = {{ polygon = "
        "[{}], edges = [{}] }}\ncracks = [[{}, {}]]\n[cracks]\ncontact = true\n[discretization]\nspacing = {}\n"
        "formulation = \"{}\"\n[[foundation]]\nmodulus = 20.0\nlifts_off = true\n[[load]]\nkind = \"pressure\"\nvalue "
        "= "
        "-0.05\n[[load]]\nkind = \"point_force\"\nposition = {}\nvalue = -2.0\n[[load]]\nkind = \"edge_moment\"\n"
        "edges = [\"a\", \"c\"]\nvalue = 0.3\n[srif]\n",
        corners, edges, at(-0.41, -0.16), at(0.32, 0.19), formulation == "galerkin" ? "0.1\ntip_spacing = 0.05" : "0.1",
        formulation, at(0.6, 0.7));
  }
};

}  // namespace

TEST_CASE("contact on soil: slabs that are turned or mirrored touch at the same places", "[in_plane]") {
  const auto formulation = GENERATE(as<std::string>(), "galerkin", "ordinary");
  const std::string rest = "[analysis]\nkind = \"static\"\ntolerance = 1e-10\n";
  const Slab slab{.formulation = formulation};
  const Run straight(slab.text() + rest);
  check_faces(straight);
  REQUIRE(*straight.summary.touching < 0.95);
  REQUIRE(*straight.summary.touching > 0.25);
  REQUIRE(straight.summary.contact->closed_share > 0.3);
  CHECK(straight.energy("strain") == Approx(straight.energy("external_work")).epsilon(1e-7));
  const double carried = straight.summary.reactions->largest_residual;
  CHECK(carried < 1e-7);
  // bonds turn with their lattice; mirrored graded cells lie elsewhere: measured 8e-5, 3e-5, 1.4e-3
  const bool cells = formulation == "galerkin";
  const Run other(Slab{formulation, cells ? 0 : 1, cells}.text() + rest);
  check_faces(other);
  CHECK(other.energy("strain") == Approx(straight.energy("strain")).epsilon(cells ? 1e-3 : 1e-9));
  CHECK(other.summary.contact->largest_pressure ==
        Approx(straight.summary.contact->largest_pressure).epsilon(cells ? 1e-3 : 1e-8));
  CHECK(*other.summary.touching == Approx(*straight.summary.touching).epsilon(cells ? 0.01 : 1e-9));
  CHECK(other.summary.contact->closed_share == Approx(straight.summary.contact->closed_share).epsilon(1e-6));
}

TEST_CASE("contact on soil: without what soil lets go, or with a crack that stays open, nothing new", "[in_plane]") {
  const auto formulation = GENERATE(as<std::string>(), "galerkin", "ordinary");
  const std::string rest = "[analysis]\nkind = \"static\"\ntolerance = 1e-11\n";
  const auto text = Slab{.formulation = formulation}.text() + rest;
  // pressed everywhere: soil that lifts off is soil that pulls too
  const Run lifting(text, {"load[0].value=-5"}), pulling(text, {"load[0].value=-5", "foundation[0].lifts_off=false"});
  CHECK(*lifting.summary.touching == Approx(1));
  CHECK(lifting.energy("strain") == Approx(pulling.energy("strain")).epsilon(1e-8));
  const auto one = lifting.column("contact", "pressure_top"), other = pulling.column("contact", "pressure_top");
  for (std::size_t i = 0; i < one.size(); ++i) CHECK(one[i] == Approx(other[i]).margin(1e-7 * largest_of(other)));
  // pulled apart in its plane: no faces touch
  const std::vector<std::string> pulled{
      "load[2]={kind='edge_traction',edges=['a','b','c','d'],value=20}",
      "support=[{kind='in_plane',points=[[-1,-1]]},{kind='in_plane',points=[[1,-1]],in_plane='y'}]"};
  auto open = pulled;
  open.emplace_back("cracks.contact=false");
  const Run apart(text, pulled), never(text, open);
  CHECK(apart.summary.contact->largest_pressure == 0);
  CHECK(apart.energy("bending") == Approx(never.energy("strain")).epsilon(1e-9));
  CHECK(*apart.summary.touching == Approx(*never.summary.touching).epsilon(1e-9));
  if (formulation == "galerkin")  // with contact factors of bonds take virtual crack extension
    CHECK(apart.tip(0).K1 == Approx(never.tip(0).K1).epsilon(1e-5));
}

TEST_CASE("contact on soil: load cases are those of single runs", "[in_plane]") {
  const auto formulation = GENERATE(as<std::string>(), "galerkin", "ordinary");
  const auto text = Slab{.formulation = formulation}.text() + "[analysis]\nkind = \"static\"\ntolerance = 1e-10\n";
  const Run alone(text);
  const Run cases(text, {"-load",
                         "case=[{name='all',load=[{kind='pressure',value=-0.05},{kind='point_force',position=[0.6,0.7],"
                         "value=-2.0},{kind='edge_moment',edges=['a','c'],value=0.3}]},"
                         "{name='weight',load=[{kind='pressure',value=-0.05}]}]"});
  const auto& one = cases.summary.load_cases.at(0);
  CHECK(one.strain_energy == Approx(alone.energy("strain")).epsilon(1e-8));
  CHECK(one.contact->largest_pressure == Approx(alone.summary.contact->largest_pressure).epsilon(1e-8));
  CHECK(one.contact->closed_share == Approx(alone.summary.contact->closed_share));
  CHECK(post::recommended(one.srif).at(0)->K1 == Approx(alone.tip(0).K1).epsilon(1e-8));
}

namespace {

/// A square with a crack and a rib on one side of it, bent.
std::string ribbed(double eccentricity, double load, const std::string& crack = "[[-0.25, -0.1], [0.2, 0.15]]") {
  return fmt::format(
      "[section]\nyoung = 1000.0\npoisson = 0.3\nthickness = 0.1\ndensity = 1.0\n[geometry]\noutline = {{ rectangle = "
      "[-0.5, -0.75, 0.5, 0.75] }}\ncracks = [{}]\n[cracks]\ncontact = true\n[discretization]\nspacing = 0.05\n"
      "tip_spacing = 0.02\n[[support]]\nkind = \"simply_supported\"\nedges = [\"bottom\", \"top\"]\n[[stiffener]]\n"
      "along = [[0.4, -0.7], [0.32, 0.7]]\nbending = 0.05\naxial = 30.0\neccentricity = {}\n[[load]]\nkind = "
      "\"pressure\"\nvalue = {:.17g}\n[[load]]\nkind = \"edge_moment\"\nedges = [\"top\"]\nvalue = {:.17g}\n[srif]\n",
      crack, eccentricity, load, 0.2 * load);
}

}  // namespace

TEST_CASE("contact beside ribs: large deflections under small loads give the same", "[in_plane]") {
  const double eccentricity = GENERATE(0.12, -0.12);
  const double small = 1e-8;
  const Run linear(ribbed(eccentricity, 1) + "[analysis]\nkind = \"static\"\ntolerance = 1e-10\n");
  const Run stretched(ribbed(eccentricity, small) +
                      "[analysis]\nkind = \"static\"\nnonlinear = true\ntolerance = 1e-10\n");
  check_faces(linear);
  REQUIRE(linear.summary.contact->closed_share > 0.5);
  CHECK(std::abs(linear.energy("coupling")) > 1e-3 * linear.energy("strain"));
  CHECK(linear.energy("strain") == Approx(linear.energy("external_work")).epsilon(1e-8));
  CHECK(stretched.energy("strain") / small / small == Approx(linear.energy("strain")).epsilon(1e-5));
  for (const std::string face : {"top", "bottom"}) {
    const auto one = linear.column("contact", "pressure_" + face),
               other = stretched.column("contact", "pressure_" + face);
    const double largest = linear.summary.contact->largest_pressure;
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(other[i] / small == Approx(one[i]).margin(1e-5 * largest));
  }
  // other methods take other shares of the forces of the rib
  for (const std::string factor : {"K1", "K2", "K3", "N1", "N2"}) {
    const auto one = linear.extrapolated(factor), other = stretched.extrapolated(factor);
    REQUIRE(one.size() == 2);
    for (const std::size_t tip : {0, 1}) {
      CAPTURE(factor, tip);
      CHECK(other[tip] / small == Approx(one[tip]).epsilon(1e-5));
    }
  }
}

TEST_CASE("contact beside ribs: seen from the other side, and next to no eccentricity", "[in_plane]") {
  const std::string rest = "[analysis]\nkind = \"static\"\ntolerance = 1e-10\n";
  const Run above(ribbed(0.12, 1) + rest), below(ribbed(-0.12, -1) + rest);
  const auto top = above.column("contact", "pressure_top"), bottom = below.column("contact", "pressure_bottom");
  for (std::size_t i = 0; i < top.size(); ++i) CHECK(top[i] == Approx(bottom[i]).margin(1e-8 * largest_of(top)));
  CHECK(above.tip(0).K1 == Approx(-below.tip(0).K1).epsilon(1e-7));
  CHECK(above.tip(0).membrane->N[0] == Approx(below.tip(0).membrane->N[0]).epsilon(1e-7));
  // found by one factor of both, and by one of the plate and one of its plane: measured 5e-10, 6e-9, 1e-8
  const Run hardly(ribbed(1e-9, 1) + rest), alone(ribbed(0, 1) + rest);
  CHECK(hardly.energy("strain") == Approx(alone.energy("strain")).epsilon(1e-8));
  const auto one = hardly.column("contact", "pressure_bottom"), other = alone.column("contact", "pressure_bottom");
  for (std::size_t i = 0; i < one.size(); ++i) CHECK(one[i] == Approx(other[i]).margin(1e-7 * largest_of(other)));
  CHECK(hardly.tip(0).K1 == Approx(alone.tip(0).K1).epsilon(1e-7));
  CHECK(hardly.tip(0).membrane->N[0] == Approx(alone.tip(0).membrane->N[0]).epsilon(1e-7));
}

TEST_CASE("contact beside ribs and on soil: energy is kept in motion", "[in_plane]") {
  const auto scene = GENERATE(as<std::string>(), "soil", "soil, bonds", "rib", "rib on soil");
  const std::string formulation = scene == "soil, bonds" ? "ordinary" : "galerkin";
  std::string text = scene.starts_with("soil") ? Slab{.formulation = formulation}.text() : ribbed(0.12, 1);
  if (scene == "rib on soil") text += "[[foundation]]\nmodulus = 20.0\nlifts_off = true\n";
  text += "[analysis]\nkind = \"dynamic\"\nduration = 0.5\n";
  if (scene != "rib") text += "start = \"equilibrium\"\n[initial]\nvelocity = \"2 * x + cos(3 * y)\"\n";
  const Run run(text, {"output.history_every=0.05", "-srif"});
  const double given = run.energy("external_work"), dissipated = run.energy("dissipated");
  CAPTURE(scene, given, dissipated, run.energy("strain"), run.energy("kinetic"), run.energy("contact"),
          run.summary.contact->largest_pressure);
  CHECK(run.summary.contact->largest_pressure > 0);
  if (const auto& touching = run.summary.touching) CHECK(*touching > 0);
  const auto strain = run.column("history", "strain_energy"), kinetic = run.column("history", "kinetic_energy"),
             work = run.column("history", "external_work"), lost = run.column("history", "contact_energy");
  double size = 0, worst = 0;
  for (std::size_t i = 0; i < strain.size(); ++i) size = std::max(size, strain[i] + kinetic[i]);
  const double first = strain[0] + kinetic[0] - work[0];
  for (std::size_t i = 0; i < strain.size(); ++i)
    worst = std::max(worst, std::abs(strain[i] + kinetic[i] + lost[i] - work[i] - first) / size);
  CAPTURE(worst, first, size);
  CHECK(run.energy("contact") > -1e-5 * size);
  CHECK(worst < 0.01);
}
