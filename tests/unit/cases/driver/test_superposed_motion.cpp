// Whatever moves a linear plate adds up: supports that move beside an initial velocity, a moving load and a mass that
// stays in contact.
#include <fmt/format.h>

#include "cases/driver/run.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"

namespace {

const std::string plate_in_motion = R"(
[section]
young = 1000.0
poisson = 0.3
thickness = 0.1
density = 1.0
[geometry]
outline = { rectangle = [-1.0, -1.0, 1.0, 1.0] }
cracks = [[[-0.3, 0.1], [0.4, 0.1]]]
[discretization]
spacing = 0.1
[[support]]
kind = "clamped"
edges = ["left", "bottom"]
[[support]]
kind = "simply_supported"
edges = ["right"]
[analysis]
kind = "dynamic"
method = "central_difference"
duration = 0.25
[output]
fields = []
history_every = 0.025
probes = { a = [0.5, 0.7], b = [0.0, 0.15] }
)";
const std::string ground = R"([[load]]
kind = "settlement"
support = 0
value = -0.02
history = [[0.0, 0.0], [0.1, 0.3], [0.5, 1.0]]
[[load]]
kind = "settlement"
support = 1
value = -0.02
history = [[0.0, 0.0], [0.1, 0.3], [0.5, 1.0]]
)";
const std::string beginning = "[initial]\nvelocity = \"0.3 * (1 - x * x) * (1 + y)\"\n";
const std::string wheel = R"([[load]]
kind = "point_force"
value = -2.0
path = [[-0.7, -0.5], [0.6, 0.4]]
speed = 3.0
)";

std::string mass_with(double velocity) {
  return fmt::format("[impact]\nposition = [0.5, 0.5]\nmass = 40.0\nvelocity = {}\nstiffness = 20.0\n", velocity);
}

struct Moved {
  post::ResultsInMemory kept;
  post::Summary summary;

  /// Numbers of a column of a table.
  std::vector<double> column(const std::string& table, const std::string& name) const {
    std::vector<double> result;
    for (const auto& [own, rows] : kept.tables)
      if (own == table)
        for (const auto& row : rows.rows) result.push_back(std::get<double>(row[rows.column(name)]));
    return result;
  }
};

Moved moved(const std::string& more, const std::string& formulation) {
  Moved result;
  const auto file = case_text::read(plate_in_motion + more, {"discretization.formulation=" + formulation});
  result.summary = cases::run(file, {{}, true, &result.kept});
  return result;
}

/// Every number of `table` is the sum of those of the parts.
void require_sum(const Moved& whole, const Moved& one, const Moved& other, const std::string& table,
                 const std::vector<std::string>& columns) {
  for (const auto& name : columns) {
    const auto all = whole.column(table, name), a = one.column(table, name), b = other.column(table, name);
    REQUIRE(!all.empty());
    REQUIRE((all.size() == a.size() && all.size() == b.size()));
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      largest = std::max(largest, std::max(std::abs(a[i]), std::abs(b[i])));
      apart = std::max(apart, std::abs(all[i] - a[i] - b[i]));
    }
    CAPTURE(table, name, apart, largest);
    CHECK(apart < 1e-9 * largest);
  }
}

}  // namespace

TEST_CASE("supports that move, an initial velocity, a moving load and a mass in contact add up") {
  const std::vector<std::string> displacements{"w", "theta_x", "theta_y"}, forces{"force", "moment_x", "moment_y"};
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    INFO(formulation);
    const auto settled = moved(ground, formulation);
    for (const auto& more : {beginning, wheel}) {
      const auto alone = moved(more, formulation), both = moved(ground + more, formulation);
      CHECK(both.summary.outcome == "done");
      require_sum(both, settled, alone, "probes", displacements);
      require_sum(both, settled, alone, "reactions", forces);
    }
    // the mass is hit upwards and the ground sinks, and it stays in contact: then the contact is a linear spring
    const auto hit = moved(mass_with(0.5), formulation), both = moved(ground + mass_with(0.5), formulation),
               again = moved(ground + mass_with(1.0), formulation);
    const auto forces_of_both = both.column("impact", "force"), forces_of_hit = hit.column("impact", "force");
    REQUIRE(!forces_of_both.empty());
    CHECK(forces_of_both != forces_of_hit);
    // again - both = hit, as each has the ground once more than the difference
    require_sum(again, both, hit, "impact", {"force"});
    require_sum(again, both, hit, "probes", displacements);
    require_sum(again, both, hit, "reactions", forces);
  }
}
