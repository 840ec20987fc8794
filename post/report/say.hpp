#pragma once
#include <string>

namespace post {

/// Writes to standard error at once. What cannot be written, to a full disk or a closed terminal, is lost: no run ends
/// for it.
void say(const std::string& text) noexcept;

}  // namespace post
