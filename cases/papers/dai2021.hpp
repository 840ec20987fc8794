#pragma once
#include <map>
#include <string>
#include <string_view>

#include "cases/papers/paper_rows.hpp"

namespace cases {

/// Examples of Dai, Tanaka, S. Oterkus and E. Oterkus 2021 through their case files, which are written into the folder.
/// Throws plate::NumericalError where a run came to nothing.
PaperResults dai2021(const std::filesystem::path& folder);

/// Case files, studies and reference curves of these examples, by their paths below `cases`. The build makes them part
/// of the program (cases/embed.cmake).
const std::map<std::string, std::string_view>& paper_files();

}  // namespace cases
