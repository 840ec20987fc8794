#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace post {

/// A share of the runs of a study: the `number`-th, from 1, of `of`.
struct Part {
  std::size_t number = 1, of = 1;

  std::string text() const { return std::to_string(number) + "/" + std::to_string(of); }
};

/// "3/16": decimal digits, 1 <= 3 <= 16 <= 10,000; nothing where it is none.
std::optional<Part> part_of(const std::string& text);

/// What is wrong with the text of a part; empty where nothing is.
std::string wrong_part(const std::string& text);

/// The runs of a part, as indices in rising order: the dearest first, each to the part that has least to do so far, of
/// equals the first. Whole numbers, so that all machines find the same shares; every run is in one of them.
std::vector<std::size_t> share(const std::vector<std::uint64_t>& weights, const Part& part);

/// What a run is taken to cost beside others of its study: (sqrt(area) / spacing)^3, the points of an even plate
/// times its iterations or steps, which go with the points across it. `area` [length^2], `spacing` [length].
std::uint64_t weight(double area, double spacing);

}  // namespace post
