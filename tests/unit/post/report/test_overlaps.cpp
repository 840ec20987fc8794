// Faces of a crack that pass through each other: on which side, by how much, and when that changes.
#include "post/report/overlaps.hpp"

#include <cmath>
#include <numbers>

#include "plate/model/section.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

const plate::Section overlap_section{1000, 0.3, 0.1, 5.0 / 6, 0};

Srif overlapping(std::size_t tip, double K1, double error, SrifMethod method = SrifMethod::domain_integral) {
  Srif srif;
  srif.tip = tip, srif.K1 = K1, srif.method = method, srif.position = {double(tip), 2};
  srif.errors[0] = error;
  return srif;
}

Table table_of(const std::vector<std::vector<Srif>>& rows) {
  Table table{srif_columns(), {}};
  for (std::size_t i = 0; i < rows.size(); ++i) append(table, 0.5 * double(i), rows[i]);
  return table;
}

}  // namespace

TEST_CASE("overlaps: the side is that of the sign of K1, where it has one") {
  CHECK(overlap(overlapping(0, 1, 0.1)) == Overlap::below);
  CHECK(overlap(overlapping(0, -1, 0.1)) == Overlap::above);
  CHECK(overlap(overlapping(0, -1, 1.5)) == Overlap::unknown);
  CHECK(overlap(overlapping(0, 0, 0)) == Overlap::unknown);
  Srif twisted = overlapping(0, -1e-9, 0);
  twisted.K2 = 1;
  CHECK(overlap(twisted) == Overlap::unknown);
  Srif lost = overlapping(0, 1, 0.1);
  lost.resolved[0] = false;
  CHECK(overlap(lost) == Overlap::unknown);
  CHECK_FALSE(at_faces(lost, overlap_section, {}).overlap.has_value());
}

TEST_CASE("overlaps: closing the faces again takes the energy that the tip releases") {
  const double K1 = -3, h = overlap_section.thickness;
  const double overlap = *at_faces(overlapping(0, K1, 0), overlap_section, {}).overlap;
  const double turn = overlap / (h / 2) / std::sqrt(2 * h);  // [psi] = turn sqrt(2 r)
  double G = 0;  // Irwin: half the moments ahead of the tip times the turn of the faces, as if the tip had gone on by 1
  constexpr int slices = 4000;
  for (int i = 0; i < slices; ++i) {
    const double angle = (i + 0.5) / slices * std::numbers::pi / 2, x = std::sin(angle) * std::sin(angle);
    const double dx = 2 * std::sin(angle) * std::cos(angle) * std::numbers::pi / 2 / slices;
    G += 0.5 * std::abs(K1) / std::sqrt(2 * x) * turn * std::sqrt(2 * (1 - x)) * dx;
  }
  CHECK(G ==
        Approx(12 * std::numbers::pi * K1 * K1 / (overlap_section.young * h * h * h)).epsilon(1e-5));  // theory (50)
}

TEST_CASE("overlaps: rows count by the recommended method, with the times of the first and of the first change") {
  const auto found = face_overlaps(
      table_of({{overlapping(1, 0, 0), overlapping(0, 1, 0.1), overlapping(0, -9, 0.1, SrifMethod::series_fit)},
                {overlapping(1, -4, 0.1), overlapping(0, -2, 0.1)},
                {overlapping(1, -0.001, 0), overlapping(0, 3, 0.1)},
                {overlapping(1, -5, 0.1), overlapping(0, -0.5, 0.1)}}));
  REQUIRE(found.size() == 2);
  CHECK(found[0].tip == 0);
  CHECK(found[0].rows == 4);
  CHECK(found[0].above == 2);
  CHECK(found[0].first_above == 0.5);
  CHECK(found[0].first_change == 0.5);
  CHECK(found[0].least == -2.0);
  CHECK(found[1].above == 2);  // a thousandth of the largest has no sign
  CHECK_FALSE(found[1].first_change);
  CHECK(found[1].position.x() == 1);
}

TEST_CASE("overlaps: one line for every crack, none where K1 is positive") {
  const auto found = face_overlaps(table_of({{overlapping(0, 1, 0), overlapping(1, -2, 0), overlapping(2, -3, 0),
                                              overlapping(3, 4, 0), overlapping(4, 5, 0)}}));
  const auto crack = [](std::size_t tip) { return tip / 2; };
  const auto lines = warnings_about_faces(found, overlap_section, crack, {}, true);
  REQUIRE(lines.size() == 2);
  CHECK_THAT(lines[0], Catch::StartsWith("crack 0: K1 is negative") &&
                           Catch::Contains("at 1 tip, -2 at tip 1 (1, 2)") &&
                           Catch::EndsWith("; set `contact` = true"));
  CHECK_THAT(lines[1], Catch::StartsWith("crack 1: ") && Catch::Contains("tip 2") && !Catch::Contains("tip 3"));
  const auto moving = face_overlaps(table_of({{overlapping(0, 1, 0)}, {overlapping(0, -2, 0)}}));
  const auto at = [](double time) { return "t = " + std::to_string(time).substr(0, 3); };
  CHECK_THAT(warnings_about_faces(moving, overlap_section, crack, at, false).at(0),
             Catch::Contains("K1 is negative in 1 of 2 rows at tip 0, first at t = 0.5: faces overlap; set loads"));
  CHECK_THAT(warnings_about_faces(moving, overlap_section, {}, at, false).at(0), Catch::StartsWith("cracks: "));
  CHECK(warnings_about_faces({}, overlap_section, {}, {}, true).empty());
}
