#include "plate/galerkin/shared/sum_by_owners.hpp"

#include "plate/model/ranks/gathered.hpp"

namespace plate {

SumByOwners::SumByOwners(const Ranks& all, std::vector<Copy> copies) : all_(all), sent_(std::size_t(all.size())) {
  std::vector<std::vector<std::uint32_t>> there(sent_.size());
  for (const auto& copy : copies)
    sent_[std::size_t(copy.owner)].push_back(copy.point), there[std::size_t(copy.owner)].push_back(copy.of_owner);
  std::vector<std::string> texts;
  for (const auto& numbers : there) texts.push_back(text_of(numbers));
  for (const auto& text : all.exchanged(std::move(texts))) received_.push_back(values_of<std::uint32_t>(text));
}

void SumByOwners::add(Forces& forces) const {
  std::vector<std::string> texts;
  for (const auto& points : sent_) {
    std::vector<double> values;
    values.reserve(3 * points.size());
    for (const auto k : points)
      for (Eigen::Index c = 0; c < 3; ++c) values.push_back(forces(c, k));
    texts.push_back(text_of(values));
    for (const auto k : points) forces.col(k).setZero();
  }
  const auto found = all_.exchanged(std::move(texts));
  for (std::size_t from = 0; from < found.size(); ++from) {
    const auto values = values_of<double>(found[from]);
    for (std::size_t i = 0; i < received_[from].size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) forces(Eigen::Index(c), received_[from][i]) += values[3 * i + c];
  }
}

}  // namespace plate
