#include "fracture/growth/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fracture {

std::string in_words(const Ended& ended, bool by_bonds) {
  using enum End;
  switch (ended.how) {
    case no_tip_left:
      return "no tip is left";
    case cannot_grow:
      return by_bonds ? "no bond can break" : "no tip can grow";
    case no_growth:
      return by_bonds ? "no bond breaks under the whole load" : "no growth under the whole load";
    case arrested:
      return "arrested under the whole load";
    case most_advances:
      return "the largest number of advances";
    case longest:
      return by_bonds ? "the largest length of cracks" : "the largest length of a crack";
    case unstable:
      return by_bonds ? "the next bond breaks unstably" : "the next advance is unstable";
    case not_resolved:
      return "the next advance is not resolved: " + ended.detail;
    case split:
      return "the plate split: " + ended.detail;
    case interrupted:
      return "interrupted";
    case failed:
      return "failed: " + ended.detail;
  }
  return "";
}

std::string in_words(const Moved& moved) {
  std::string result;
  if (moved.broken)
    result = *moved.broken == 0 ? "no bond broke" : fmt::format("{} bonds broken", *moved.broken);
  else
    result = moved.advances == 0 ? "no growth" : fmt::format("{} pieces of crack", moved.advances);
  if (!moved.reached.empty()) result += fmt::format(", {} reached", fmt::join(moved.reached, ", "));
  for (const auto* stopped : {&moved.stopped, &moved.unsteady})
    if (!stopped->empty()) result += fmt::format("; not resolved, and stopped there: {}", fmt::join(*stopped, "; "));
  if (moved.parts > moved.parts_before)
    result += fmt::format("; the plate split in {} parts{}", moved.parts, moved.frozen ? "" : ", which move on");
  return result;
}

}  // namespace fracture
