#pragma once
#include "cases/input/case_file.hpp"
#include "plate/model/refused.hpp"

namespace cases {

/// The key that a refusal is about.
std::string key_of(const plate::Refusal& refusal, const plate::Problem& problem);

/// What a plate refuses, as problems of the case.
std::vector<Problem> problems_of(const CaseFile& file, const std::vector<plate::Refusal>& refusals);

/// What `make` gives. Throws CaseError where a plate refuses it.
template <class Make>
auto unless_refused(const CaseFile& file, const Make& make) {
  try {
    return make();
  } catch (const plate::Refused& error) {
    throw CaseError(problems_of(file, error.reasons()));
  }
}

}  // namespace cases
