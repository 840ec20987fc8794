// Cracks whose faces touch while the plate moves: bars that hit each other against the waves of bars, energy and
// momentum of plates whose cracks open and close, and the equilibrium with contact that a damped plate reaches.
#include <fmt/format.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/stretched_motion.hpp"
#include "post/files/sinks.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
using geometry::Point;
namespace vp = verified_plate;

namespace {

/// A plate whose crack faces may touch, and its motion by `share` of the stable step.
struct Moving {
  Discretised plates;
  StretchedMotion both;
  double step;

  explicit Moving(const cases::Case& c, double share = 0.9)
      : plates(discretise(c)),
        both(*plates.plate, *plates.membrane, 1),
        step(share * stable_time_step(*plates.plate, *plates.membrane, 1)) {}

  void move(DynamicOptions options, double duration, const std::function<void(const Instant&)>& see) const {
    options.steps = std::size_t(std::ceil(duration / step));
    options.time_step = duration / double(options.steps);
    options.faces = both.faces();
    if (both.stretching()) options.strain_energy = [&](const State& state) { return both.strain_energy(state); };
    central_differences(both, both.constraints(), both.mass(), both.loads(), options, see);
  }
};

/// Two bars of the length 1 beside each other along x, to be turned about the origin and mirrored.
struct Bars {
  double spacing = 1.0 / 40, turn = 0;  // [degrees]
  bool mirrored = false;
  const FormulationKind* formulation = &galerkin;
  static constexpr double width = 0.2;

  Point along() const { return Eigen::Rotation2Dd(turn * std::numbers::pi / 180) * Point(mirrored ? -1 : 1, 0); }
  cases::Case plate() const {
    const Point x = along(), y = Point(-x.y(), x.x());
    auto c = vp::free_plate({}, spacing);
    c.outline.outer = {{-x, x, x + width * y, -x + width * y}, {"a", "b", "c", "d"}};
    c.cracks = {{Point(0, 0), width * y}};
    c.faces = CrackFaces{.contact = true};
    c.discretization.formulation = formulation;
    c.section = {1000, 0, 0.1, 5.0 / 6, 2};
    c.loads.clear();
    return c;
  }
};

/// Motion of bars after the first one has hit the second one with the velocity V = 1; by theory 1, 1, (0, 1), 0, 0.
struct Hit {
  double duration = 0, force = 0;      // of the contact over 2 L / c; its mean over rho c V h b / 2
  std::array<double, 2> speed{};       // mean of each bar at the end, over V
  double across = 0;                   // momentum across the bars over that along them
  double momentum = 0, imbalance = 0;  // changes over what there was
  double lost = 0, left = 0;           // by points that meet; in waves at the end; over the energy before
};

Hit hit(const Bars& bars) {
  const Moving moving(bars.plate());
  const auto& plate = *moving.plates.plate;
  const auto points = Eigen::Index(plate.points());
  const Point x = bars.along();
  const Forces mass = of_plane(moving.both.unconstrained_mass());
  std::vector<char> second(points);
  for (Eigen::Index k = 0; k < points; ++k) second[k] = plate.cloud().positions[k].dot(x) > 0;
  for (const auto& pair : plate.face_pairs()) {
    if (bars.formulation != &galerkin) break;  // no points on the faces
    const bool forward = pair.normal.dot(x) > 0;
    second[pair.left.front().point] = forward, second[pair.right.front().point] = !forward;
  }
  State velocity = zero_state(2 * points);
  double moved = 0, all = 0;  // masses
  for (Eigen::Index k = 0; k < points; ++k) {
    all += mass(2, k);
    if (second[k]) continue;
    velocity(2, points + k) = x.x(), velocity(1, points + k) = -x.y(), moved += mass(2, k);
  }
  DynamicOptions options;
  options.velocity = velocity, options.given = moved / 2;
  const double c = std::sqrt(500.0), h = 0.1;
  Hit result;
  double before = 0, time_before = 0, impulse = 0;
  moving.move(options, 3.2 / c, [&](const Instant& now) {
    double force = 0;
    for (const auto& pair : *now.faces) force += pair.force[0] + pair.force[1];
    impulse += force * (now.time - time_before), time_before = now.time;
    if (force > 0) result.duration = now.time * c / 2;
    const double energy = now.strain_energy + now.discrete_kinetic_energy + now.dissipated;
    if (now.step == 0) before = energy;
    result.imbalance = std::max(result.imbalance, std::abs(energy - before) / options.given);
    const State v = of_plane(now.velocity());
    Point sum(0, 0);
    result.speed = {0, 0};
    for (Eigen::Index k = 0; k < points; ++k) {
      const Point of_point(mass(2, k) * v(2, k), -mass(1, k) * v(1, k));
      sum += of_point, result.speed[second[k]] += of_point.dot(x) / (second[k] ? all - moved : moved);
    }
    result.momentum = std::max(result.momentum, std::abs(sum.dot(x) / moved - 1));
    result.across = std::max(result.across, std::abs(sum.dot(Point(-x.y(), x.x()))) / moved);
    result.lost = now.contact_so_far.lost / options.given;
    result.left = now.strain_energy / options.given;
  });
  result.force = impulse / (2 / c) / (2 * c * h * Bars::width / 2);
  return result;
}

/// A square plate with an oblique crack that vibrates freely: it is thrown, bent, and its crack opens and closes.
cases::Case breathing(double h, bool stretches, std::vector<geometry::Polyline> cracks,
                      const FormulationKind* formulation = &galerkin) {
  auto c = vp::free_plate(geometry::rectangle(-1, -1, 1, 1), 0.1);
  c.discretization.formulation = formulation;
  c.section = {1000, 0.3, h, 5.0 / 6, 2};
  c.cracks = std::move(cracks);
  c.faces = CrackFaces{.contact = true};
  c.stretches = stretches;
  c.loads.clear();
  return c;
}

struct Breathing {
  double imbalance = 0, lost = 0;       // of the energy put in
  double overlap = 0, opening = 0;      // least and largest opening over the thickness
  double momentum = 0;                  // largest change in the plane, over the root of twice energy and mass
  std::size_t steps = 0, meetings = 0;  // meetings: of a face that was open the step before
};

/// Lets the plate move from w = amplitude (x^2 + y^2 - 2/3), pulled apart in its plane by u = drift x.
Breathing breathe(const cases::Case& c, double amplitude, double drift, double periods) {
  const Moving moving(c);
  const auto& plate = *moving.plates.plate;
  const auto points = Eigen::Index(plate.points());
  State start = zero_state(2 * points);
  for (Eigen::Index k = 0; k < points; ++k) {
    const auto& x = plate.cloud().positions[k];
    start.col(k) << amplitude * (x.squaredNorm() - 2.0 / 3), 2 * amplitude * x.y(), -2 * amplitude * x.x();
    start.col(points + k) << 0, 0, drift * x.x();
  }
  DynamicOptions options;
  options.start = start, options.bent = true, options.given = moving.both.strain_energy(start);
  const Forces mass = of_plane(moving.both.unconstrained_mass());
  const double all = mass.row(2).sum();
  Breathing result;
  std::vector<PairContact> last;
  double before = 0;
  moving.move(
      options, periods * 4 / std::sqrt(c.section.bending_stiffness() / c.section.mass()), [&](const Instant& now) {
        const double energy = now.strain_energy + now.discrete_kinetic_energy + now.dissipated;
        if (now.step == 0) before = energy;
        result.imbalance = std::max(result.imbalance, std::abs(energy - before) / options.given);
        const State v = of_plane(now.velocity());
        for (const int row : {1, 2})
          result.momentum =
              std::max(result.momentum, std::abs(mass.row(row).dot(v.row(row))) / std::sqrt(2 * all * options.given));
        for (std::size_t i = 0; i < now.faces->size(); ++i)
          for (const int face : {0, 1}) {
            const auto& [opening, force] = (*now.faces)[i];
            result.overlap = std::min(result.overlap, opening[face] / c.section.thickness);
            result.opening = std::max(result.opening, opening[face] / c.section.thickness);
            if (!last.empty() && force[face] > 0 && last[i].force[face] == 0) ++result.meetings;
          }
        last = *now.faces, result.lost = now.contact_so_far.lost / options.given, result.steps = now.step;
      });
  return result;
}

}  // namespace

TEST_CASE("contact in motion: a bar that hits an equal one hands over its velocity", "[in_plane]") {
  for (const double spacing : {1.0 / 40, 1.0 / 80}) {
    const auto found = hit({.spacing = spacing});
    CAPTURE(spacing, found.duration, found.force, found.speed[0], found.speed[1], found.lost);
    CHECK(found.duration == Approx(1).epsilon(0.02));  // 1.3, 1.2 %
    CHECK(found.force == Approx(1).epsilon(0.02));     // 1.6, 1.0 %
    CHECK(found.speed[0] == Approx(0).margin(0.015));  // 0.010, 0.007
    CHECK(found.speed[1] == Approx(1).epsilon(0.015));
    CHECK(std::abs(found.across) < 1e-10);
    CHECK(found.momentum < 1e-10);        // 4e-12
    CHECK(found.imbalance < 1e-10);       // 8e-14
    CHECK(std::abs(found.lost) < 1e-10);  // points have given back all that they held
  }
}

TEST_CASE("contact in motion: bars do the same turned and mirrored", "[in_plane]") {
  const Bars bars{.turn = GENERATE(0.0, 45.0, 90.0, 200.0), .mirrored = GENERATE(false, true)};
  const auto straight = hit({}), found = hit(bars);
  CAPTURE(bars.turn, bars.mirrored, found.force / straight.force - 1, found.speed[1] / straight.speed[1] - 1,
          found.duration, found.lost);
  const double near = std::fmod(bars.turn, 90) == 0 ? 1e-9 : 5e-3;
  CHECK(found.speed[0] == Approx(straight.speed[0]).margin(near));
  CHECK(found.speed[1] == Approx(straight.speed[1]).margin(near));
  CHECK(found.force == Approx(straight.force).epsilon(near));
  CHECK(std::abs(found.lost) < 1e-3);
  CHECK(found.momentum < 1e-10);
}

TEST_CASE("contact in motion: a crack that opens and closes keeps energy and momentum", "[in_plane]") {
  static const std::vector<std::vector<geometry::Polyline>> scenes{
      {{{-0.4, -0.1}, {0.45, 0.2}}},
      {{{-1.0, 0.1}, {0.2, 0.15}}},
      {{{-0.5, 0.0}, {0.5, 0.0}}, {{0.0, 0.0}, {0.2, 0.5}}},
      {{{-0.5, 0.0}, {0.5, 0.0}}, {{0.0, -0.5}, {0.0, 0.5}}}};
  const auto [scene, stretches] =
      GENERATE(table<std::size_t, bool>({{0, false}, {0, true}, {1, false}, {2, false}, {3, false}, {3, true}}));
  const auto& cracks = scenes[scene];
  const double h = 0.1;
  const auto found = breathe(breathing(h, stretches, cracks), 0.3 * h, 0.002, stretches ? 1 : 4);
  CAPTURE(cracks.size(), stretches, found.imbalance, found.lost, found.overlap, found.opening, found.momentum,
          found.steps, found.meetings);
  CHECK(found.steps > 1500);
  CHECK(found.meetings > 400);
  CHECK(found.imbalance < (stretches ? 2e-3 : 1e-10));  // 6e-4; 5e-15
  CHECK(found.overlap > -1e-13);                        // -6e-16
  CHECK(found.opening > 1e-3);
  CHECK(found.lost > 0);
  CHECK(found.lost < (cracks.size() > 1 ? 0.2 : 0.05));  // 0.11 where cracks cross; 0.013
  CHECK(found.momentum < 1e-10);                         // 7e-14
}

TEST_CASE("contact in motion: bars of bonds hand over their velocity, turned and mirrored too", "[in_plane]") {
  const auto bars = GENERATE(Bars{.formulation = &ordinary}, Bars{.mirrored = true, .formulation = &ordinary},
                             Bars{.turn = 90, .formulation = &ordinary}, Bars{.turn = 27, .formulation = &ordinary},
                             Bars{.spacing = 1.0 / 80, .formulation = &ordinary});
  const auto found = hit(bars);
  CAPTURE(bars.spacing, bars.turn, found.duration, found.force, found.speed[0], found.speed[1], found.lost);
  const bool along = bars.turn != 27;
  CHECK(found.duration == Approx(1).epsilon(along ? 0.012 : 0.025));  // 0.9 %; 1.9 % oblique
  CHECK(found.force == Approx(1).epsilon(along ? 0.012 : 0.06));      // 0.8, 0.6 %; 4.3 %
  CHECK(found.speed[0] == Approx(0).margin(0.01));                    // 0.003, 0.004; 0.007
  CHECK(found.speed[1] == Approx(1).epsilon(0.005));                  // 0.3, 0.4 %; 0.1 %
  CHECK(std::abs(found.across) < 1e-10);                              // 4e-14
  CHECK(found.momentum < 1e-10);                                      // 2e-12
  CHECK(found.imbalance < 1e-10);                                     // 2e-13
  CHECK(std::abs(found.lost) < 1e-10);                                // places have given back all that they held
}

TEST_CASE("contact in motion: a crack in bonds that opens and closes keeps energy and momentum", "[in_plane]") {
  const double h = 0.1;
  const auto found = breathe(breathing(h, false, {{{-0.4, -0.1}, {0.45, 0.2}}}, &ordinary), 0.3 * h, 0.002, 1);
  CAPTURE(found.imbalance, found.lost, found.overlap, found.opening, found.momentum, found.steps, found.meetings);
  CHECK(found.steps > 1000);
  CHECK(found.meetings > 100);
  CHECK(found.imbalance < 1e-10);  // 5e-15
  CHECK(found.overlap > -1e-5);    // -6e-6, of the start
  CHECK(found.opening > 1e-3);
  CHECK(found.lost > 0);
  CHECK(found.lost < 0.01);  // 0.0007; 0.005 in four times as long
  CHECK(found.momentum < 1e-10);
}

namespace {

const std::string slow = R"([section]
young = 210e9
poisson = 0.3
thickness = 0.1
density = 7800.0
[geometry]
outline = { rectangle = [0.0, 0.0, 1.0, 0.5] }
cracks = [[[0.3, 0.25], [0.7, 0.25]]]
[cracks]
contact = true
[discretization]
spacing = 0.025
[[support]]
kind = "clamped"
edges = ["bottom"]
in_plane = "fixed"
[[load]]
kind = "edge_moment"
edges = ["top"]
value = 500.0
[[load]]
kind = "edge_traction"
edges = ["top"]
value = -300.0
[srif]
)";

struct Run {
  post::ResultsInMemory results;
  post::Summary summary;

  Run(const std::string& formulation, const std::string& analysis, std::vector<std::string> settings = {}) {
    settings.push_back("discretization.formulation=" + formulation);
    if (formulation == "galerkin") settings.push_back("discretization.refine_tips=false");
    const auto file = cases::read_case_text(slow + analysis, "contact", settings);
    summary = cases::run(file, {.folder = {}, .quiet = true, .in_memory = &results});
  }
  const post::Srif& tip(std::size_t which) const { return *post::recommended(summary.srif).at(which); }
  std::vector<double> column(const std::string& name) const {
    const auto found = std::ranges::find(results.tables, "contact", &std::pair<std::string, post::Table>::first);
    REQUIRE(found != results.tables.end());
    std::vector<double> values;
    for (const auto& row : found->second.rows) values.push_back(std::get<double>(row[found->second.column(name)]));
    return values;
  }
};

}  // namespace

TEST_CASE("contact in motion: slow loads bring a damped plate to its equilibrium with contact", "[in_plane]") {
  const auto formulation = GENERATE(as<std::string>(), "galerkin", "ordinary");
  INFO(formulation);
  const Run rest(formulation, "[analysis]\nkind = \"static\"\n");
  const Run moving(
      formulation, "[analysis]\nkind = \"dynamic\"\nduration = 0.03\ndamping = { mass = 900.0 }\n",
      {"load[0].history=ramp", "load[0].rise_time=0.01", "load[1].history=ramp", "load[1].rise_time=0.01"});
  for (const std::size_t which : {0, 1}) {
    CAPTURE(which, moving.tip(which).K1 / rest.tip(which).K1 - 1, moving.tip(which).membrane->N[0]);
    CHECK(moving.tip(which).K1 == Approx(rest.tip(which).K1).epsilon(1e-3));
    CHECK(moving.tip(which).membrane->N[0] == Approx(rest.tip(which).membrane->N[0]).epsilon(1e-3));
  }
  for (const std::string face : {"top", "bottom"}) {
    const auto at_rest = rest.column("pressure_" + face), found = moving.column("pressure_" + face);
    const double largest = rest.summary.contact->largest_pressure;
    REQUIRE(found.size() == at_rest.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(at_rest[i]).margin(1e-3 * largest));
  }
  CHECK(moving.summary.contact->closed_share == Approx(rest.summary.contact->closed_share));
  CHECK(moving.summary.contact->least_opening > -1e-15);
}

TEST_CASE("contact in motion: bonds and the Galerkin plate have the same factors in the first swing", "[in_plane]") {
  const auto swing = [](const std::string& formulation) {
    return Run(formulation, "[analysis]\nkind = \"dynamic\"\nduration = 0.0015\n",
               {"output.history_every=0.0005", "geometry.outline={rectangle=[0.0,0.0,2.0,1.0]}",
                "geometry.cracks=[[[0.6,0.5],[1.4,0.5]]]", "load[0].history=ramp", "load[0].rise_time=0.0005",
                "load[1].history=ramp", "load[1].rise_time=0.0005"});
  };
  const Run bonds = swing("ordinary"), cells = swing("galerkin");
  for (const std::size_t which : {0, 1}) {
    CAPTURE(which, bonds.tip(which).K1 / cells.tip(which).K1 - 1);
    CHECK(bonds.tip(which).K1 == Approx(cells.tip(which).K1).epsilon(0.02));  // 0.1, 0.4 %
    CHECK(bonds.tip(which).membrane->N[0] == Approx(cells.tip(which).membrane->N[0]).epsilon(0.02));
  }
}

TEST_CASE("contact in motion: bonds whose crack stays open move as without contact", "[in_plane]") {
  const auto pulled = [](const std::string& contact) {
    return Run("ordinary", "[analysis]\nkind = \"dynamic\"\nstart = \"equilibrium\"\nduration = 0.001\n",
               {"output.history_every=0.0001", "cracks.contact=" + contact, "load[0].value=1", "load[0].history=ramp",
                "load[0].rise_time=0.0005", "load[1].value=3000"});
  };
  const Run closing = pulled("true"), open = pulled("false");
  CHECK(closing.summary.contact->largest_pressure == 0);
  CHECK(closing.summary.contact->least_opening > 0);
  REQUIRE(closing.summary.energy.size() > 3);
  for (std::size_t i = 0; i < open.summary.energy.size(); ++i) {
    CAPTURE(open.summary.energy[i].first);
    CHECK(closing.summary.energy[i].second == Approx(open.summary.energy[i].second).epsilon(1e-9));  // 3e-13
  }
}
