#pragma once
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace post {

/// One step of a dotted key: a name in a table or an index in a list.
using KeyStep = std::variant<std::string, std::size_t>;

/// load[0].value and load.0.value are the same key.
std::vector<KeyStep> steps(const std::string& key);

/// load[0].value
std::string dotted(const std::vector<KeyStep>& path);

}  // namespace post
