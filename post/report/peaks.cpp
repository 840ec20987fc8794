#include "post/report/peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace post {
namespace {

/// Of one quantity of one tip.
using Key = std::pair<std::size_t, std::size_t>;  // tip, 0 to 2 of K1 to K3, 3 of the utilisation

void look(std::map<Key, Peak>& found, std::size_t tip, std::size_t quantity, double value, double time) {
  static const std::array names{"K1", "K2", "K3", "utilisation"};
  auto& peak = found.try_emplace({tip, quantity}, Peak{names[quantity], tip, 0, time, {}, {}}).first->second;
  if (std::abs(value) > std::abs(peak.value)) peak.value = value, peak.time = time;
}

void miss(std::map<Key, double>& missed, std::size_t tip, std::size_t quantity, double value) {
  auto& most = missed[{tip, quantity}];
  most = std::max(most, value);
}

Srif as_resolved(Srif srif) {
  srif.resolved.fill(true);
  return srif;
}

}  // namespace

std::vector<Peak> peaks(const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows,
                        const plate::Section& section, std::optional<double> toughness) {
  std::map<Key, Peak> found;
  std::map<Key, double> missed;  // what a value that is not resolved may be
  for (std::size_t n = 0; n < std::min(times.size(), rows.size()); ++n)
    for (std::size_t i = 0; i < rows[n].size(); ++i) {
      const Srif& srif = rows[n][i];
      if (i > 0 && rows[n][i - 1].tip == srif.tip) continue;
      const std::array values{srif.K1, srif.K2, srif.K3};
      for (std::size_t which = 0; which < 3; ++which)
        if (srif.resolved[which])
          look(found, srif.tip, which, values[which], times[n]);
        else
          miss(missed, srif.tip, which, std::abs(values[which]) + srif.errors[which].value_or(0));
      if (!toughness) continue;
      if (const auto used = at_faces(srif, section, toughness).utilisation)
        look(found, srif.tip, 3, *used, times[n]);
      else
        miss(missed, srif.tip, 3, at_faces(as_resolved(srif), section, toughness).utilisation.value_or(0));
    }
  std::vector<Peak> result;
  for (auto& [key, peak] : found)
    if (const auto more = missed.find(key); more == missed.end() || more->second <= std::abs(peak.value))
      result.push_back(std::move(peak));
  return result;
}

}  // namespace post
