#pragma once
#include "cases/input/case_file.hpp"
#include "cases/runs/analyses.hpp"
#include "plate/formulation/discretised.hpp"
#include "post/factors/tip_methods.hpp"

namespace cases {

/// The plate of a case, and what its user should know of it. Throws CaseError where the discretisation cannot carry the
/// case, where the plate is not held in statics, in whole or in a piece that cracks cut off, and where it has fewer
/// modes than frequencies are asked for.
plate::Discretised discretised(const CaseFile& file, const plate::Communicator& communicator = plate::single_process());

/// Throws CaseError where so many processes cannot share the plate of a case.
void require_distributable(const CaseFile& file, int processes);

/// Cracks that grow by their tips need the energy release rate of each from the start, whatever methods [srif] names.
/// Tips too near to an edge, a load or another crack for it: CaseError in statics, a warning in motion, where they
/// stay.
void check_growing_tips(const CaseFile& file, const plate::Formulation& plate, std::vector<std::string>& warnings);

/// The methods for the intensity factors of every tip; none without [srif]. `plate` must outlive them. Throws CaseError
/// where no method can work at any tip.
std::vector<post::TipMethods> tip_methods(const CaseFile& file, const plate::Formulation& plate);

/// A case with all that can be refused behind it. Stays where it is made.
struct Prepared : ValidatedPlate {
  /// Throws CaseError.
  explicit Prepared(CaseFile wanted, const plate::Communicator& communicator = plate::single_process());
  Prepared(const Prepared&) = delete;

  CaseFile file;
};

/// Steps that end exactly on the rows of history, none above `limit`. Throws CaseError where the file asks for more.
plate::TimeGrid time_grid(const CaseFile& file, double limit);

}  // namespace cases
