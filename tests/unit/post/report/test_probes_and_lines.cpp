#include "post/report/probes_and_lines.hpp"

#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/problem.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

TEST_CASE("lines: pieces within the plate, and integrals over them without what lies beside") {
  auto content = case_text::read(case_text::plain, {"geometry.cracks=[]", "discretization.spacing=0.1"}).content;
  content.outline.holes = {geometry::Circle{{0, 0}, 0.25, {}}};
  const auto plate = plate::discretise(content).plate;
  const auto line = post::sampled_line("cut", {-1.5, 0}, {1.5, 0}, *plate);
  REQUIRE(!line.places.empty());
  std::vector<post::ProbeValue> values;
  for (const auto& place : line.places) {
    const double r = place.position.norm();
    CHECK(r > 0.25 - 1e-9);
    CHECK(std::abs(place.position.x()) < 1 + 1e-9);
    for (const auto& [quantity, value] : {std::pair{"Mxx", 1.0}, {"Myy", 2.0}, {"Mxy", 0.5}, {"Qx", 3.0}, {"Qy", -4.0}})
      values.push_back({"cut", quantity, place.position, value});
  }
  const auto sums = post::sums_along(line, values);  // n = (0, -1), s = (1, 0) along 1.5
  const auto sum = [&](const std::string& quantity) {
    return std::ranges::find(sums, quantity, &post::ProbeValue::quantity)->value;
  };
  CHECK(sum("moment") == Approx(1.5 * 2));
  CHECK(sum("twist") == Approx(-1.5 * 0.5));
  CHECK(sum("shear") == Approx(1.5 * 4));
  post::Table table;
  post::add_rows(table, 2, line, values);
  CHECK(table.rows.size() == line.places.size());
  CHECK(std::get<double>(table.rows.front()[table.column("Qy")]) == -4);
}

TEST_CASE("places in frames: by points of the plate alone, exact for linear fields, also at edges") {
  const auto plate =
      plate::discretise(case_text::read(case_text::plain,
                                        {"geometry.cracks=[]", "discretization.formulation=ordinary",
                                         "discretization.boundary=surface_nodes", "discretization.spacing=0.1",
                                         "support=[{ kind = 'clamped', edges = ['left', 'right', 'bottom', 'top'] }]"})
                            .content)
          .plate;
  const auto points = plate->cloud().plate_points;
  REQUIRE(plate->points() > points);
  const auto beyond = [&](const plate::PlaceShare& share) { return share.point >= points; };
  for (const auto& at : {geometry::Point(1, 0.3), geometry::Point(0.97, -0.4), geometry::Point(0.1, 0.2)}) {
    const auto shares = post::place_in_frames(*plate, at);
    CHECK(std::ranges::none_of(shares, beyond));
    double sum = 0, along = 0;
    for (const auto& share : shares) {
      sum += share.weight;
      along += share.weight * plate->cloud().positions[share.point].x();
    }
    CHECK(sum == Approx(1));
    CHECK(along == Approx(at.x()));
  }
  CHECK(std::ranges::any_of(plate->interpolation({1, 0.3}), beyond));
}
