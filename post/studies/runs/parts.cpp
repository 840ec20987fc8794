#include "post/studies/runs/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace post {
namespace {

constexpr std::size_t most_parts = 10000;  // as many as a study has runs

std::optional<std::size_t> number_in(const char* begin, const char* end) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<Part> part_of(const std::string& text) {
  const char *begin = text.data(), *end = begin + text.size(), *stroke = std::find(begin, end, '/');
  if (stroke == end) return std::nullopt;
  const auto number = number_in(begin, stroke), of = number_in(stroke + 1, end);
  if (!number || !of || *number < 1 || *number > *of || *of > most_parts) return std::nullopt;
  return Part{*number, *of};
}

std::string wrong_part(const std::string& text) {
  if (part_of(text)) return {};
  return fmt::format("{} given, must be a part as 3/16: from 1/16 to 16/16, of at most {}", text, most_parts);
}

std::vector<std::size_t> share(const std::vector<std::uint64_t>& weights, const Part& part) {
  std::vector<std::size_t> order(weights.size()), own;
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return weights[i]; });
  std::vector<std::uint64_t> sums(part.of);
  for (const std::size_t i : order) {
    const auto least = std::ranges::min_element(sums);
    *least += weights[i];
    if (least - sums.begin() == std::ptrdiff_t(part.number - 1)) own.push_back(i);
  }
  std::ranges::sort(own);
  return own;
}

std::uint64_t weight(double area, double spacing) {
  constexpr double most = 1e5;  // across the plate: 10,000 runs of it do not exceed 64 bits
  const double across = std::sqrt(area) / spacing;
  const auto n = std::uint64_t(std::llround(across > 1 ? std::min(across, most) : 1));
  return n * n * n;
}

}  // namespace post
