#include "cases/studies/study.hpp"

#include <algorithm>
#include <random>

#include "tests/catch.hpp"

TEST_CASE("parts: what is one is read, and what is none is said") {
  const auto part = cases::part_of("3/16");
  REQUIRE(part);
  CHECK(part->number == 3);
  CHECK(part->of == 16);
  CHECK(cases::part_of("03/3")->text() == "3/3");
  CHECK(cases::part_of("10000/10000"));
  CHECK(cases::wrong_part("1/1").empty());
  for (const char* text : {"", "x", "3", "/", "3/", "/3", "0/3", "4/3", "3/0", "-1/3", "+1/3", " 1/3", "1/3 ", "1/3/3",
                           "1.0/3", "1/10001", "1/99999999999999999999999"}) {
    INFO(text);
    CHECK_FALSE(cases::part_of(text));
    CHECK_FALSE(cases::wrong_part(text).empty());
  }
}

TEST_CASE("parts: every run is in one share, and no share is more than a run above the mean") {
  std::mt19937 random(7);
  for (const std::size_t of : {1, 2, 3, 7, 40}) {
    std::vector<std::uint64_t> weights(30);
    for (auto& weight : weights) weight = 1 + random() % 1000;
    std::vector<std::size_t> all;
    std::uint64_t total = 0, most = 0;
    for (const auto weight : weights) total += weight;
    for (std::size_t number = 1; number <= of; ++number) {
      const auto own = cases::share(weights, {number, of});
      CHECK(std::ranges::is_sorted(own));
      all.insert(all.end(), own.begin(), own.end());
      std::uint64_t sum = 0;
      for (const auto i : own) sum += weights[i];
      most = std::max(most, sum);
    }
    std::ranges::sort(all);
    REQUIRE(all.size() == weights.size());
    for (std::size_t i = 0; i < all.size(); ++i) CHECK(all[i] == i);
    CHECK(most <= total / of + 1000);
  }
}

TEST_CASE("parts: the finest runs of a study go to different parts") {
  std::vector<std::uint64_t>
      weights;  // of two loads, each with four spacings: in turn, all of the finest would be one's
  for (int load = 0; load < 2; ++load)
    for (const double spacing : {0.2, 0.1, 0.05, 0.025}) weights.push_back(cases::weight(4, spacing));
  CHECK(weights[0] == 1000);
  CHECK(weights[3] == 512000);
  CHECK(cases::share(weights, {1, 4}) == std::vector<std::size_t>{3});
  CHECK(cases::share(weights, {2, 4}) == std::vector<std::size_t>{7});
  CHECK(cases::share(weights, {3, 4}) == std::vector<std::size_t>{0, 1, 2});
  CHECK(cases::share(weights, {4, 4}) == std::vector<std::size_t>{4, 5, 6});
}

TEST_CASE("parts: weights stay within 64 bits, and are above nothing") {
  CHECK(cases::weight(1, 1e-300) == 1000000000000000);
  CHECK(cases::weight(1, 10) == 1);
  CHECK(cases::weight(1, 0) == 1000000000000000);
}
