#include "cases/driver/second_formulation.hpp"

#include "cases/input/formulations.hpp"
#include "cases/input/keys.hpp"
#include "plate/formulations.hpp"

namespace cases {

CaseFile in_other_formulation(const CaseFile& file) {
  CaseFile result = file;
  Case& c = result.content;
  const auto given = c.discretization;
  c.discretization = {};
  c.discretization.spacing = given.spacing;
  c.discretization.formulation = &plate::other_formulation(*given.formulation);
  c.formulation_reason = "the other one of srif.second_formulation";
  c.analysis.preconditioner = plate::Preconditioning::automatic;
  c.analysis.precision = Analysis::Precision::double_;
  if (c.analysis.method == Analysis::Method::lanczos) c.analysis.method = Analysis::Method::central_difference;
  c.output.vtk = c.output.hdf5 = false;
  c.srif->second_formulation = c.srif->richardson = false;

  Reading reading("");
  reading.found().places = file.source.places;
  reading.kind = c.analysis.kind;
  settle_grading(c, reading);
  check_case(c, reading);
  auto problems = reading.problems();
  for (auto& problem : problems) problem.what = "srif.second_formulation: " + problem.what;
  if (!problems.empty()) throw CaseError(problems);
  return result;
}

}  // namespace cases
