#pragma once
#include "cases/input/case_file.hpp"
#include "fracture/runs/ready.hpp"

namespace cases {

/// A case with all that can be refused behind it. Stays where it is made.
struct Prepared : fracture::Ready {
  /// Throws CaseError.
  explicit Prepared(CaseFile wanted);
  Prepared(const Prepared&) = delete;

  CaseFile file;
};

/// Steps that end exactly on the rows of history, none above `limit`. Throws CaseError where the file asks for more.
plate::TimeGrid time_grid(const CaseFile& file, double limit);

}  // namespace cases
