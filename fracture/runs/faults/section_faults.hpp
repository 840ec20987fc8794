#pragma once
#include <optional>
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

/// What a section that varies or has directions cannot serve: growth, stated accuracies, a toughness, factors at tips
/// beside which it changes. Nothing of others.
std::vector<KeyFault> faults_of_section(const plate::Problem& problem, bool grows,
                                        const std::optional<post::SrifOptions>& srif);

}  // namespace fracture
