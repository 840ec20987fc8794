#include "fracture/runs/faults/analysis_faults.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plate/model/formulation_kind.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"

namespace fracture {

using plate::Analysis;

std::vector<KeyFault> faults_of_motion(const plate::Problem& problem, const Analysis& analysis, bool grows,
                                       const std::function<bool(const std::string&)>& given) {
  std::vector<KeyFault> result;
  const auto refuse = [&](const std::string& key, const std::string& what) { result.push_back({key, what}); };
  if (analysis.kind != Analysis::Kind::dynamic) return result;
  if (analysis.method != Analysis::Method::lanczos) {
    if (given("analysis.tolerance"))
      refuse("analysis.tolerance", "is of method = \"lanczos\"; steps have analysis.time_step: remove it");
    return result;
  }
  const auto complain = [&](const char* key) {
    refuse(key, "is of method = \"central_difference\"; Lanczos vectors take no steps: remove it");
  };
  if (analysis.time_step) complain("analysis.time_step");
  if (given("analysis.safety")) complain("analysis.safety");
  if (analysis.precision == Analysis::Precision::mixed)
    refuse("analysis.precision", "\"mixed\" is of method = \"central_difference\"; choose \"double\"");
  if (const auto& kind = *problem.discretization.formulation; !kind.offers(plate::Feature::lanczos) && !grows)
    refuse("analysis.method", kind.lacks.at(plate::Feature::lanczos) + "; choose \"central_difference\"");
  if (grows)
    refuse("analysis.method", "\"lanczos\" given: growth in motion takes steps; choose \"central_difference\"");
  return result;
}

std::vector<KeyFault> faults_of_accuracy(const plate::Problem& problem, const Analysis& analysis, bool grows,
                                         const std::optional<post::SrifOptions>& srif,
                                         const std::string& formulation_reason) {
  std::vector<KeyFault> result;
  if (!srif || !srif->accuracy) return result;
  const auto complain = [&](const std::string& what) { result.push_back({"srif.accuracy", what}); };
  if (const auto& kind = *problem.discretization.formulation; !kind.offers(plate::Feature::graded_points))
    complain(kind.lacks.at(plate::Feature::graded_points) + " (formulation " + formulation_reason +
             "): remove it or that");
  else if (analysis.kind == Analysis::Kind::dynamic && analysis.method != Analysis::Method::lanczos)
    complain("moves the plate by Lanczos vectors: remove what asks for steps (analysis.method, time_step, safety)");
  if (grows) complain("is not available with [growth]");
  if (srif->richardson || srif->second_formulation)
    complain("has estimates of its own: remove srif.richardson and srif.second_formulation");
  for (const char* method : {"virtual_crack_extension", "domain_integral", "series_fit"})
    if (std::ranges::find(srif->methods, method) == srif->methods.end())
      complain(fmt::format("compares methods: add \"{}\" to srif.methods, or remove these", method));
  return result;
}

}  // namespace fracture
