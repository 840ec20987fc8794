#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace post {

/// 64-bit FNV-1a of a text, as hexadecimal: the same settings have the same digest on every machine.
inline std::string digest(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

}  // namespace post
