#pragma once
#include <string>

namespace plate {
struct Problem;
}

namespace post {

/// What a report draws of a plate, as JSON: `edges`, each with `name`, `from`, `to` and the plate on its left,
/// `outline` as vertices, `holes` as vertices or `centre` and `radius`, `cracks`, `supports`, `loads`, `section`.
std::string plate_json(const plate::Problem& problem);

}  // namespace post
