#include "cases/driver/fatigue.hpp"

#include <cmath>

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace cases;
using post::Cell, post::Table;

TEST_CASE("cycles: exact where K grows with a power of the length") {
  // K = 5 sqrt a, exponent 3: N = 2 (1 / sqrt a0 - 1 / sqrt a) / (C 125); exponent 2: N = ln(a / a0) / (C 25)
  const std::vector<double> lengths{0.1, 0.13, 0.2, 0.5};
  std::vector<double> ranges;
  for (const double a : lengths) ranges.push_back(5 * std::sqrt(a));
  const auto cubic = cycles({1e-3, 3, 0}, lengths, ranges), square = cycles({1e-3, 2, 0}, lengths, ranges);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    CHECK(cubic[i] == Approx(2 * (1 / std::sqrt(0.1) - 1 / std::sqrt(lengths[i])) / (1e-3 * 125)));
    CHECK(square[i] == Approx(std::log(lengths[i] / 0.1) / (1e-3 * 25)));
  }
}

TEST_CASE("cycles: none grow below the threshold, and lengths must ascend") {
  const auto found = cycles({1, 2, 1.5}, {1, 2, 3}, {2, 2, 1});
  CHECK(found[1] == Approx(0.25));
  CHECK(std::isinf(found[2]));
  CHECK_THROWS_AS(cycles({1, 2, 0}, {1, 1}, {2, 2}), std::invalid_argument);
  CHECK_THROWS_AS(cycles({1, 2, 0}, {1, 2}, {2}), std::invalid_argument);
}

TEST_CASE("cycles: rates that no number holds are an error, not a result") {
  CHECK_THROWS_AS(cycles({1, 300, 0}, {1, 2}, {1e3, 2e3}), plate::NumericalError);  // infinite
  CHECK_THROWS_AS(cycles({1, 300, 0}, {1, 2}, {1e-3, 2e-3}),
                  plate::NumericalError);  // zero, though above the threshold
  CHECK_THROWS_AS(cycles({1, 2, 0}, {1, 2}, {1, std::nan("")}), plate::NumericalError);
}

TEST_CASE("fatigue: K range of the case's loads from energy release rates at other loads, tip by tip") {
  const plate::Section section{1000, 0.3, 0.1, 5.0 / 6, 0};
  // K = 7 at factor 1, for every length: G = K^2 h / (3 E)
  const double G = 49 * 0.1 / 3000;
  // both tips of a crack move, then the first alone
  Table growth{{"advance", "load_factor"}, {}}, tips{{"advance", "tip", "crack", "length", "G", "moves"}, {}};
  const double lengths[] = {0.6, 0.8, 1.0};
  for (const double advance : {0.0, 1.0, 2.0}) {
    const double length = lengths[int(advance)];
    growth.rows.push_back({advance, 2 * length});
    for (const double tip : {0.0, 1.0}) {
      const double moves = advance == 0 || (advance == 1 && tip == 0);
      tips.rows.push_back({advance, tip, 0.0, length, 4 * length * length * G, moves});
    }
  }
  const auto found = fatigue(growth, tips, section, {1e-4, 2, 0}, 0.5, 0.2);
  REQUIRE(found.rows.size() == 5);
  CHECK(std::get<double>(found.rows[0][1]) == Approx(0.3));
  CHECK(std::get<double>(found.rows[2][1]) == Approx(0.6));
  const double range = 0.8 * 0.5 * 7;
  CHECK(std::get<double>(found.rows[2][2]) == Approx(range));
  CHECK(std::get<double>(found.rows[2][3]) == Approx(0.3 / (1e-4 * range * range)));
  CHECK(std::get<double>(found.rows[4][3]) == Approx(0.1 / (1e-4 * range * range)));
  CHECK(found.rows[4][4] == Cell());  // no errors are known
  growth.columns.push_back("critical_load_factor_error");
  for (auto& row : growth.rows) row.push_back(0.1);
  const auto doubtful = fatigue(growth, tips, section, {1e-4, 2, 0}, 0.5, 0.2);
  CHECK(std::get<double>(doubtful.rows[2][4]) == Approx(0.1 * range));
  CHECK(std::get<double>(doubtful.rows[2][5]) == Approx(0.3 / (1e-4 * 1.21 * range * range)));
  CHECK(std::get<double>(doubtful.rows[2][6]) == Approx(0.3 / (1e-4 * 0.81 * range * range)));
  tips.rows.resize(2);
  CHECK_THROWS_AS(fatigue(growth, tips, section, {1e-4, 2, 0}, 1, 0), std::runtime_error);
}

TEST_CASE("fatigue: damaged tables are named with their row and column") {
  const plate::Section section{1000, 0.3, 0.1, 5.0 / 6, 0};
  const Table growth{{"advance", "load_factor"}, {{0.0, 1.0}, {1.0, 1.5}}};
  const Table tips{{"advance", "tip", "crack", "length", "G", "moves"},
                   {{0.0, 0.0, 0.0, 0.5, 1.0, 1.0}, {1.0, 0.0, 0.0, 0.7, 1.2, 1.0}}};
  const auto said = [&](const Table& one, const Table& other) {
    try {
      fatigue(one, other, section, {1e-4, 2, 0}, 1, 0);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(said(growth, tips).empty());
  for (std::size_t column = 0; column < 6; ++column)
    for (const Cell& bad : {Cell(), Cell("word"), Cell(std::nan("")), Cell(INFINITY)}) {
      auto damaged = tips;
      damaged.rows[1][column] = bad;
      CHECK(said(growth, damaged) == "tips.csv, row 2: " + tips.columns[column] + " is no number");
    }
  auto other = tips;
  other.rows[1][0] = 7.0;
  CHECK_THAT(said(growth, other), Catch::Contains("the advance 7 of tips.csv has no load factor"));
  auto factor = growth;
  for (const Cell& bad : {Cell(), Cell("word"), Cell(0.0)}) {
    factor.rows[1][1] = bad;
    CHECK_THAT(said(factor, tips), Catch::Contains("the advance 1 of tips.csv has no load factor"));
  }
  other = tips;
  other.columns[4] = "H";
  CHECK_THAT(said(growth, other), Catch::Contains("tips.csv: there is no column G"));
}
