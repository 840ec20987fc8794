#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plate/model/problem.hpp"

namespace plate {
struct Analysis;
}

namespace post {
struct SrifOptions;
}

namespace fracture {

using plate::KeyFault;

/// Invalid keys of a motion: those that only time steps have, and those that only Lanczos vectors have. `given`: does
/// the case state this key?
std::vector<KeyFault> faults_of_motion(const plate::Problem& problem, const plate::Analysis& analysis, bool grows,
                                       const std::function<bool(const std::string&)>& given);

/// Invalid keys of a harmonic analysis: features that have no harmonic response.
std::vector<KeyFault> faults_of_response(const plate::Problem& problem, const plate::Analysis& analysis);

/// Settlements where they cannot go: Lanczos vectors, frequencies, and in motion a support that is moved at once.
std::vector<KeyFault> faults_beside_settlements(const plate::Problem& problem, const plate::Analysis& analysis);

/// Loads that move and soil that lifts off where they cannot go: Lanczos vectors, frequencies, beside settlements; soil
/// that lifts off beside growth and combinations too.
std::vector<KeyFault> faults_beside_contact(const plate::Problem& problem, const plate::Analysis& analysis, bool grows);

/// Keys that cannot be combined with load cases, and why.
std::vector<KeyFault> faults_beside_load_cases(const plate::Problem& problem, const plate::Analysis& analysis,
                                               bool grows, const std::optional<post::SrifOptions>& srif);

/// Keys that prevent the discretisation from being found. `formulation_reason`: why the formulation is what it is.
std::vector<KeyFault> faults_of_accuracy(const plate::Problem& problem, const plate::Analysis& analysis, bool grows,
                                         const std::optional<post::SrifOptions>& srif,
                                         const std::string& formulation_reason);

}  // namespace fracture

namespace plate {
struct Analysis;
}

namespace post {
struct SrifOptions;
}

namespace fracture {

struct Growth;

/// Invalid keys of a growth, beside the plate, its analysis and the factors that are wanted. `given`: does the case
/// state this key?
std::vector<KeyFault> faults_of_growth(const plate::Problem& problem, const plate::Analysis& analysis,
                                       const Growth& growth, const std::optional<post::SrifOptions>& srif,
                                       const std::function<bool(const std::string&)>& given);

}  // namespace fracture

namespace plate {
struct Analysis;
}

namespace post {
struct SrifOptions;
}

namespace fracture {

/// Keys that a section that varies or has directions does not support: growth, stated accuracies, a toughness, factors
/// at tips beside which it changes. Empty for other sections.
std::vector<KeyFault> faults_of_section(const plate::Problem& problem, bool grows,
                                        const std::optional<post::SrifOptions>& srif);

}  // namespace fracture
