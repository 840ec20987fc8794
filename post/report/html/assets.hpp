#pragma once
#include <map>
#include <string>
#include <string_view>

namespace post {

/// The files of post/report/html that make up a report, by their names: scripts, styles, the frame of the page. The
/// build makes them part of the program (cases/embed.cmake).
const std::map<std::string, std::string_view>& assets();

}  // namespace post
