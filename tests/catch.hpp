#pragma once
// Catch2 3, with the names of Catch2 2 that the tests use; or Catch2 2 itself.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>

using Catch::Approx;

namespace Catch {

inline auto Contains(const std::string& text) {
  return Matchers::ContainsSubstring(text);
}
using Matchers::EndsWith, Matchers::Equals, Matchers::StartsWith, Matchers::VectorContains;

}  // namespace Catch
#else
#include <catch2/catch.hpp>
#endif
