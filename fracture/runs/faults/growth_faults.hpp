#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plate/model/loading/load_cases.hpp"

namespace plate {
struct Analysis;
}

namespace post {
struct SrifOptions;
}

namespace fracture {

struct Growth;

using plate::KeyFault;

/// What of a growth cannot be, beside the plate, its analysis and the factors that are wanted. `given`: does the case
/// state this key?
std::vector<KeyFault> faults_of_growth(const plate::Problem& problem, const plate::Analysis& analysis,
                                       const Growth& growth, const std::optional<post::SrifOptions>& srif,
                                       const std::function<bool(const std::string&)>& given);

}  // namespace fracture
