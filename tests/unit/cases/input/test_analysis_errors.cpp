#include "cases/input/validation.hpp"

#include <set>

#include "plate/formulations.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"
#include "tests/catch.hpp"

namespace {

using Keys = std::multiset<std::string>;

Keys keys_of(const std::vector<cases::KeyError>& errors) {
  Keys keys;
  for (const auto& error : errors) keys.insert(error.key);
  return keys;
}

}  // namespace

TEST_CASE("analysis faults: steps and Lanczos vectors have keys of their own") {
  plate::Problem problem;
  problem.discretization.formulation = plate::formulations().back();
  const auto all = [](const std::string&) { return true; };
  plate::Analysis analysis;
  CHECK(cases::errors_in_motion(problem, analysis, false, all).empty());
  analysis.kind = plate::Analysis::Kind::dynamic;
  analysis.method = plate::Analysis::Method::central_difference;
  CHECK(keys_of(cases::errors_in_motion(problem, analysis, false, all)) == Keys{"analysis.tolerance"});
  analysis.method = plate::Analysis::Method::lanczos;
  analysis.time_step = 0.1, analysis.precision = plate::Analysis::Precision::mixed;
  CHECK(keys_of(cases::errors_in_motion(problem, analysis, false, all)) ==
        Keys{"analysis.time_step", "analysis.safety", "analysis.method"});
}

TEST_CASE("analysis faults: what stands in the way of a stated accuracy") {
  plate::Problem problem;
  problem.discretization.formulation = plate::formulations().front();
  post::SrifOptions srif;
  CHECK(cases::errors_in_accuracy(problem, {}, srif, "").empty());
  srif.accuracy = 0.01;
  CHECK(cases::errors_in_accuracy(problem, {}, srif, "").empty());
  srif.methods = {post::SrifMethod::series_fit};
  CHECK(cases::errors_in_accuracy(problem, {}, srif, "").size() == 2);
  problem.discretization.formulation = plate::formulations().back();
  CHECK_THAT(cases::errors_in_accuracy(problem, {}, srif, "as it is").at(0).what,
             Catch::Contains("formulation as it is"));
}
