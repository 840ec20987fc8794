#pragma once
#include <string>
#include <string_view>

/// The text with one of its lines or values changed as a careless or a hostile user might, chosen by `seed`.
std::string mutated(std::string_view text, unsigned seed);
