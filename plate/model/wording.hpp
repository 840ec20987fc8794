#pragma once
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"

/// Words, numbers and points in messages.
namespace plate {

/// The candidate nearest to a word by edit distance (also to a beginning of a candidate), as
/// " (did you mean 'x'?)"; empty where none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// The shortest text that reads as the same double.
std::string number_text(double x);
std::string quoted(const std::string& text);
std::string listed(const std::vector<std::string>& words);
std::string text_of(const geometry::Point& x);
std::string text_of(const std::vector<geometry::Point>& points);
std::string text_of(const std::vector<std::string>& words);

}  // namespace plate
