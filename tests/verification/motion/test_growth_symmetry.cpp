// Symmetric plates whose cracks grow: mirror images stay mirror images, whatever row of points a crack runs along.
#include <cmath>

#include "cases/driver/run.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using fracture::Growth;
namespace vp = verified_plate;

namespace {

cases::Case square(int cells, const std::vector<geometry::Polyline>& cracks, bool in_motion) {
  auto c = vp::square(2.0 / cells);
  c.section.density = 1;
  c.cracks = cracks;
  c.supports = {vp::held_all_round(plate::SupportKind::simply_supported)};
  c.loads[0].as<plate::Pressure>()->value = in_motion ? 6 : 1;
  auto& growth = c.growth.emplace();
  growth.fracture_energy = 1;
  if (in_motion) {
    c.loads[0].history.kind = plate::History::Kind::ramp, c.loads[0].history.rise_time = 0.6;
    c.analysis.duration = 0.5;
  } else {
    c.analysis.kind = cases::Analysis::Kind::static_;
    c.analysis.tolerance = 1e-9;
    growth.control = Growth::Control::equilibrium;
    growth.max_advances = 12;
  }
  c.output.vtk = c.output.hdf5 = false;
  return c;
}

std::vector<geometry::Point> grown(const cases::Case& c) {
  post::ResultsInMemory kept;
  kept.wants_fields = false;
  cases::run({c, {}}, {{}, true, &kept});
  const auto& table = std::ranges::find(kept.tables, "cracks", &std::pair<std::string, post::Table>::first)->second;
  std::vector<geometry::Point> result;
  for (const auto& row : table.rows)
    result.emplace_back(std::get<double>(row[table.column("x")]), std::get<double>(row[table.column("y")]));
  return result;
}

/// Largest distance from a vertex to the mirror image of the nearest one.
double apart(const std::vector<geometry::Point>& vertices, double x, double y) {
  double result = 0;
  for (const auto& one : vertices) {
    double least = INFINITY;
    for (const auto& other : vertices)
      least = std::min(least, (geometry::Point(x * one.x(), y * one.y()) - other).norm());
    result = std::max(result, least);
  }
  return result;
}

const std::vector<std::vector<geometry::Polyline>> scenes{{{{-0.25, 0}, {0.25, 0}}},
                                                          {{{-1, 0}, {-0.5, 0}}, {{1, 0}, {0.5, 0}}}};

}  // namespace

TEST_CASE("cracks in symmetric plates of bonds grow symmetrically, at rest and in motion, on any grid") {
  for (const int cells : {40, 41, 51})
    for (const bool in_motion : {false, true})
      for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
        const auto c = square(cells, scenes[scene], in_motion);
        const auto vertices = grown(c);
        double reach = 0;
        for (const auto& x : vertices) reach = std::max(reach, std::abs(std::abs(x.x()) - (scene == 0 ? 0.25 : 0.5)));
        CAPTURE(cells, in_motion, scene, reach);
        CHECK(reach > 0.1);
        const double spacing = c.discretization.spacing;
        CHECK(apart(vertices, 1, -1) < 1e-6 * spacing);  // were up to 2.8 at rest, 10 in motion
        CHECK(apart(vertices, -1, 1) < 1e-6 * spacing);
      }
}
