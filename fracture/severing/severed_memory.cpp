#include "fracture/severing/severed_memory.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "plate/model/ranks/ranks.hpp"
#include "plate/solve/archive.hpp"

namespace fracture {

PointKeys::PointKeys(const plate::Boundary& boundary)
    : boundary_(boundary),
      plate_({boundary.lattice.begin(), boundary.lattice.begin() + std::ptrdiff_t(boundary.cloud.plate_points)}) {
  for (auto k = std::uint32_t(boundary.cloud.plate_points); k < boundary.cloud.size(); ++k)
    fictitious_[geometry::cell_of(boundary.lattice[k])].push_back(k);
}

PointKey PointKeys::of(std::uint32_t k) const {
  const auto cell = geometry::cell_of(boundary_.lattice[k]);
  if (boundary_.is_plate(k)) return {cell[0], cell[1], 0};
  const auto& there = fictitious_.at(cell);
  return {cell[0], cell[1], std::ranges::find(there, k) - there.begin() + 1};
}

std::optional<std::uint32_t> PointKeys::point(const PointKey& key) const {
  const auto& [column, row, which] = key;
  if (which == 0) return plate_.at({double(column) + 0.5, double(row) + 0.5});
  const auto found = fictitious_.find({long(column), long(row)});
  if (found == fictitious_.end() || found->second.size() < std::size_t(which)) return std::nullopt;
  return found->second[std::size_t(which) - 1];
}

std::vector<SeveredFamily> of_all(std::vector<SeveredFamily> own) {
  const auto* all = plate::ranks();
  if (!all) return own;
  std::ostringstream text;
  {
    plate::OutArchive archive(text);
    archive(own);
  }
  std::vector<SeveredFamily> result;
  for (const auto& one : all->exchanged(std::vector<std::string>(std::size_t(all->size()), text.str()))) {
    std::istringstream in(one);
    plate::InArchive archive(in);
    std::vector<SeveredFamily> theirs;
    archive(theirs);
    std::ranges::move(theirs, std::back_inserter(result));
  }
  return result;
}

}  // namespace fracture
