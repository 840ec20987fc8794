#pragma once
#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

#include "plate/model/reduction.hpp"
#include "plate/solve/archive.hpp"

namespace plate {

/// Gathers the values of all ranks, one rank after the other; `shared`: as in reductions. Collective.
template <typename Shared, typename T>
std::vector<T> gathered_archives(const Shared& shared, std::vector<T> own) {
  if (!shared.distributed()) return own;
  std::ostringstream text;
  {
    OutArchive archive(text);
    archive(own);
  }
  std::vector<T> result;
  for (const auto& one : texts_of_all(shared, text.str())) {
    std::istringstream in(one);
    InArchive archive(in);
    std::vector<T> theirs;
    archive(theirs);
    std::ranges::move(theirs, std::back_inserter(result));
  }
  return result;
}

}  // namespace plate
