#include "plate/formulation/parts/shared_sets.hpp"

#include <map>
#include <set>

#include "plate/model/ranks/gathered.hpp"

namespace plate {
namespace {

/// Numbers that stand for one set, each known by the smallest of them.
class Same {
public:
  std::int64_t first(std::int64_t a) const {
    for (auto at = smaller_.find(a); at != smaller_.end(); at = smaller_.find(a)) a = at->second;
    return a;
  }
  void join(std::int64_t a, std::int64_t b) {
    a = first(a), b = first(b);
    if (a != b) smaller_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::map<std::int64_t, std::int64_t> smaller_;
};

}  // namespace

std::vector<std::int64_t> set_numbers(DisjointSets& sets, const Boundary& boundary) {
  std::vector<std::int64_t> result(boundary.cloud.size());
  const Ranks* all = ranks();
  const std::int64_t begin = all ? std::int64_t(all->rank()) << 32 : 0;  // exact as a double below 2^21 processes
  for (std::uint32_t k = 0; k < result.size(); ++k) result[k] = begin + sets.root(k);
  if (!all) return result;
  State theirs = State::Zero(3, Eigen::Index(result.size()));
  for (std::size_t k = 0; k < result.size(); ++k) theirs(0, Eigen::Index(k)) = double(result[k]);
  boundary.constraints.fetch(theirs);
  std::set<std::pair<std::int64_t, std::int64_t>> joined;
  for (std::size_t k = 0; k < result.size(); ++k)
    if (const auto other = std::int64_t(theirs(0, Eigen::Index(k))); other != result[k])
      joined.emplace(result[k], other);
  std::vector<std::int64_t> own;
  for (const auto& [a, b] : joined) own.insert(own.end(), {a, b});
  Same same;
  const auto pairs = gathered(*all, own);
  for (std::size_t i = 0; i < pairs.size(); i += 2) same.join(pairs[i], pairs[i + 1]);
  for (auto& number : result) number = same.first(number);
  return result;
}

}  // namespace plate
