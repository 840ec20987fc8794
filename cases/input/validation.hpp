#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/problems.hpp"
#include "plate/model/problem.hpp"

namespace plate {
struct Analysis;
}

namespace post {
struct SrifOptions;
}

namespace fracture {
struct Growth;
}

namespace cases {

/// Invalid keys of a motion: those that only time steps have, and those that only Lanczos vectors have. `given`: does
/// the case state this key?
std::vector<KeyError> errors_in_motion(const plate::Problem& problem, const plate::Analysis& analysis, bool grows,
                                       const std::function<bool(const std::string&)>& given);

/// Loads that bend a plate whose frequencies or buckling loads are sought.
std::vector<KeyError> errors_in_prestress(const plate::Problem& problem, const plate::Analysis& analysis);

/// A harmonic analysis by a formulation without Lanczos vectors.
std::vector<KeyError> errors_in_response(const plate::Problem& problem, const plate::Analysis& analysis);

/// Supports and loads that move which do not begin at 0.
std::vector<KeyError> errors_in_beginning(const plate::Problem& problem, const plate::Analysis& analysis);

/// Constant loads without large deflections, and without another load that grows.
std::vector<KeyError> errors_in_constant_loads(const plate::Problem& problem, const plate::Analysis& analysis);

/// Names of load cases and combinations that are given twice or unknown, load cases without loads, combinations of
/// nothing or of loads that all load cases share, which would be counted as often as the factors say, and load cases by
/// a formulation whose stiffness is not symmetric.
std::vector<KeyError> errors_in_load_cases(const plate::Problem& problem);

/// Keys that prevent the discretisation from being found. `formulation_reason`: why the formulation is what it is.
std::vector<KeyError> errors_in_accuracy(const plate::Problem& problem, const plate::Analysis& analysis,
                                         const std::optional<post::SrifOptions>& srif,
                                         const std::string& formulation_reason);

/// Invalid keys of a growth, beside the plate, its analysis and the factors that are wanted. `given`: does the case
/// state this key?
std::vector<KeyError> errors_in_growth(const plate::Problem& problem, const plate::Analysis& analysis,
                                       const fracture::Growth& growth, const std::optional<post::SrifOptions>& srif,
                                       const std::function<bool(const std::string&)>& given);

/// Sections that change about a tip whose factors are wanted.
std::vector<KeyError> errors_in_section(const plate::Problem& problem);

}  // namespace cases
