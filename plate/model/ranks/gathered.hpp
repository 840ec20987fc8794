#pragma once
#include <cstring>
#include <type_traits>

#include "plate/model/ranks/ranks.hpp"

namespace plate {

/// Values of one kind as what processes send each other, and back.
template <typename T>
std::string text_of(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::string text(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(text.data(), values.data(), text.size());
  return text;
}

template <typename T>
std::vector<T> values_of(const std::string& text) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> values(text.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), text.data(), text.size());
  return values;
}

/// What all processes have, one after the other.
template <typename T>
std::vector<T> gathered(const Ranks& all, const std::vector<T>& own) {
  std::vector<T> result;
  for (const auto& text : all.exchanged(std::vector<std::string>(std::size_t(all.size()), text_of(own)))) {
    const auto theirs = values_of<T>(text);
    result.insert(result.end(), theirs.begin(), theirs.end());
  }
  return result;
}

}  // namespace plate
