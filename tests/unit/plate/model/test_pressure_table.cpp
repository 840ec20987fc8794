#include "plate/model/loads.hpp"

#include <random>
#include <sstream>

#include "tests/catch.hpp"

using geometry::Point;
using plate::PressureTable;

namespace {

std::string message_of(const std::string& text) {
  const auto found = PressureTable::parsed(text, "pressure.csv");
  const auto* error = std::get_if<std::string>(&found);
  return error ? *error : "";
}

}  // namespace

TEST_CASE("a grid in any order is bilinear") {
  const PressureTable table(
      "# pressures of a wind tunnel\nx, y, pressure\n0,0,1\n2,0,5\n\n0,1,3\n2,1,-1\n1,1,7\n1,0,2\n", "/there/wind.csv");
  CHECK(table.gridded());
  CHECK(table({0, 0}) == 1);
  CHECK(table({0.5, 0}) == 1.5);
  CHECK(table({0.5, 0.5}) == Approx((1 + 2 + 3 + 7) / 4.0));
  CHECK(table({1.25, 0.5}) == Approx(0.75 * 4.5 + 0.25 * 2));
  CHECK(table({2, 1}) == -1);
  CHECK(table.times(-2)({2, 1}) == 2);
  CHECK(table.reaches({2, 1}));
  CHECK(!table.reaches({2.01, 1}));
  CHECK(table.digest().size() == 16);
  CHECK(table.file() == "/there/wind.csv");
}

TEST_CASE("scattered places are linear on triangles, and a linear pressure is exact") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::stringstream text;
  text.precision(17);
  text << "x,y,pressure\n";
  const auto pressure = [](const Point& x) { return 2 - 3 * x.x() + 400 * x.y(); };
  std::vector<Point> places{{0, 0}, {10, 0}, {10, 0.1}, {0, 0.1}};
  for (int i = 0; i < 60; ++i) places.emplace_back(10 * uniform(random), 0.1 * uniform(random));
  for (const auto& x : places) text << x.x() << "," << x.y() << "," << pressure(x) << "\n";
  const PressureTable table(text.str(), "pressure.csv");
  CHECK(!table.gridded());
  for (int i = 0; i < 200; ++i) {
    const Point x(10 * uniform(random), 0.1 * uniform(random));
    CHECK(table.reaches(x));
    CHECK(table(x) == Approx(pressure(x)).margin(1e-9));
  }
  CHECK(table.reaches({10, 0.1}));
  CHECK(table.reaches({5, 0.1}));
  CHECK(!table.reaches({5, 0.101}));
}

TEST_CASE("places on oblique borders, which are lines but for rounding, are all heard") {
  const auto along = [](double s) { return 100 + 40 * s * s; };  // s: the place along a border
  for (const double slope : {1 / 3.7, -0.61, 7.3, 1e-4}) {
    std::stringstream text;
    text.precision(17);
    text << "x,y,pressure\n";
    constexpr int count = 40;
    for (const int side : {0, 1})
      for (int i = 0; i <= count; ++i)
        text << 0.03 * i + side << "," << 0.03 * i * slope + 2 * side << "," << along(double(i) / count) << "\n";
    const PressureTable table(text.str(), "pressure.csv");
    for (double s = 0.0031; s < 1; s += 0.0071) {
      INFO(slope << " " << s);
      const double x = 0.03 * count * s, below = std::floor(s * count) / count, above = below + 1.0 / count;
      const double linear = along(below) + (along(above) - along(below)) * (s - below) * count;
      for (const int side : {0, 1}) {
        CHECK(table.reaches({x + side, x * slope + 2 * side}));
        CHECK(table({x + side, x * slope + 2 * side}) == Approx(linear).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("a table as a spreadsheet writes it, with a mark of the order of bytes, is read") {
  const PressureTable table("\xEF\xBB\xBFx,y,pressure\r\n0,0,1\r\n1,0,+2.5e0\r\n0,1,3\r\n", "pressure.csv");
  CHECK(table({1, 0}) == 2.5);
  CHECK_THROWS_AS(PressureTable("x,y\xEF\xBB\xBF,pressure\n0,0,1\n1,0,2\n0,1,3\n", "pressure.csv"),
                  std::invalid_argument);
}

TEST_CASE("what is wrong with a table is said with its line") {
  using Catch::Contains;
  for (const char* word : {"0x10", "+-1", "+", "1e", "1 2", "0b1", "1_000", "1.2.3", "--1"})
    CHECK_THAT(message_of(std::string("x,y,pressure\n1,2,") + word + "\n"), Contains("is no number"));
  for (const char* word : {"1e400", "-1e999", "inf", "nan"})
    CHECK_THAT(message_of(std::string("x,y,pressure\n1,2,") + word + "\n"), Contains("is not finite"));
  CHECK_THAT(message_of("x,y\n1,2\n"), Contains("line 1") && Contains("must be x,y,pressure"));
  CHECK_THAT(message_of("x,y,pressure\n1,2,3\n# a word\n1,2\n"), Contains("line 4: 2 values given"));
  CHECK_THAT(message_of("x,y,pressure\n1,2,3a\n"), Contains("line 2: \"3a\" is no number"));
  CHECK_THAT(message_of("x,y,pressure\n1,2,3" + std::string(1, 0) + "7\n"),
             Contains("line 2") && Contains("is no number"));
  CHECK_THAT(message_of("x,y,pressure\n" + std::string(1, 0) + ",2,3\n"),
             Contains("line 2") && Contains("is no number"));
  CHECK_THAT(message_of("x,y,pressure\n0,-1,0\n1,4.4e23,1\n0,0.1,1.5\n"), Contains("at one place"));
  CHECK_THAT(message_of("x,y,pressure\n1,2e100,3\n"), Contains("line 2: a place beyond 1e+100"));
  CHECK_THAT(message_of("x,y,pressure\n1,2,nan\n"), Contains("line 2: nan is not finite"));
  CHECK_THAT(message_of("x,y,pressure\n1,2,3\n2,2,3\n1,2,4\n"),
             Contains("line 4: the place (1, 2) is given in line 2"));
  CHECK_THAT(message_of("x,y,pressure\n1,2,3\n2,2,3\n"), Contains("2 places given"));
  CHECK_THAT(message_of("x,y,pressure\n1,2,3\n2,2,3\n3,2,3\n"), Contains("on one line"));
  CHECK_THAT(message_of("x,y,pressure\n1,1,3\n2,2,3\n3,3,3\n"), Contains("on one line"));
}
