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

using plate::KeyFault;

/// What only steps have, and what only Lanczos vectors. `given`: does the case state this key?
std::vector<KeyFault> faults_of_motion(const plate::Problem& problem, const plate::Analysis& analysis, bool grows,
                                       const std::function<bool(const std::string&)>& given);

/// What stands in the way of finding the discretisation. `formulation_reason`: why the formulation is what it is.
std::vector<KeyFault> faults_of_accuracy(const plate::Problem& problem, const plate::Analysis& analysis, bool grows,
                                         const std::optional<post::SrifOptions>& srif,
                                         const std::string& formulation_reason);

}  // namespace fracture
