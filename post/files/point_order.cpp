#include "post/files/point_order.hpp"

#include <algorithm>
#include <numeric>

#include "plate/formulation/mesh.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/reduction.hpp"

namespace post {
namespace {

/// Points of one process in one row of the lattice.
struct OfRow {
  double y, x;  // of the first
  std::int64_t points, rank;
};

}  // namespace

PointOrder::PointOrder(const plate::Communicator& all, const std::vector<geometry::Point>& own) : all_(all) {
  std::vector<OfRow> rows;
  for (const auto& x : own) {
    if (rows.empty() || rows.back().y != x.y()) rows.push_back({x.y(), x.x(), 0, all.rank()});
    ++rows.back().points;
  }
  auto of_all = plate::gathered(all, rows);
  std::ranges::sort(of_all, [](const OfRow& a, const OfRow& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  std::size_t begin = 0;
  for (const auto& one : of_all) {
    const auto count = std::size_t(one.points);
    if (one.rank == all.rank()) own_.push_back({points_, begin, count}), begin += count;
    points_ += count;
  }
}

PointOrder::PointOrder(const plate::Communicator& all, const std::vector<std::uint32_t>& numbers) : all_(all) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k == 0 || numbers[k] != numbers[k - 1] + 1) own_.push_back({numbers[k], k, 0});
    ++own_.back().points;
  }
  points_ = std::size_t(plate::count_of_all(all, std::int64_t(numbers.size())));
}

std::vector<double> PointOrder::at_first(std::size_t first, std::size_t count, std::size_t width,
                                         const std::function<void(std::size_t k, double* to)>& numbers) const {
  if (!all_.distributed()) {
    std::vector<double> result(count * width);
    for (std::size_t i = 0; i < count; ++i) numbers(first + i, result.data() + i * width);
    return result;
  }
  std::vector<double> sent;  // of every run: where it begins in this part, how many points, their numbers
  const auto behind = std::ranges::upper_bound(own_, first, {}, &PointRun::first);
  for (auto one = behind == own_.begin() ? behind : behind - 1; one != own_.end() && one->first < first + count;
       ++one) {
    const auto low = std::max(one->first, first), high = std::min(one->first + one->points, first + count);
    if (low >= high) continue;
    sent.push_back(double(low - first)), sent.push_back(double(high - low));
    for (auto number = low; number < high; ++number) {
      sent.resize(sent.size() + width);
      numbers(one->begin + number - one->first, sent.data() + sent.size() - width);
    }
  }
  std::vector<std::string> texts(std::size_t(all_.size()));
  texts[0] = plate::text_of(sent);
  const auto received = all_.exchanged(std::move(texts));
  if (all_.rank() > 0) return {};
  std::vector<double> result(count * width);
  for (const auto& text : received) {
    const auto values = plate::values_of<double>(text);
    for (std::size_t i = 0; i < values.size();) {
      const auto place = std::ptrdiff_t(values[i]) * std::ptrdiff_t(width);
      const auto length = std::ptrdiff_t(values[i + 1]) * std::ptrdiff_t(width);
      const auto from = values.begin() + std::ptrdiff_t(i) + 2;
      std::copy(from, from + length, result.begin() + place);
      i += std::size_t(length) + 2;
    }
  }
  return result;
}

PointOrder order_of(const plate::Communicator& all, const plate::Mesh& mesh) {
  if (!all.distributed()) {
    std::vector<std::uint32_t> as_they_are(mesh.positions.size());
    std::iota(as_they_are.begin(), as_they_are.end(), 0u);
    return {all, as_they_are};
  }
  const auto own = std::ptrdiff_t(mesh.own.value_or(mesh.positions.size()));
  if (!mesh.numbers.empty()) return {all, std::vector<std::uint32_t>(mesh.numbers.begin(), mesh.numbers.begin() + own)};
  return {all, std::vector<geometry::Point>(mesh.positions.begin(), mesh.positions.begin() + own)};
}

}  // namespace post
