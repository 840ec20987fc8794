#pragma once
#include <optional>
#include "cases/input/output.hpp"
#include "fracture/growth/criteria.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"

/// The application: case files in, results out.
namespace cases {

using plate::Analysis;

/// One whole simulation, as plain data: a plate, and what is done with it.
struct Case : plate::Problem {
  std::string title, source, units = "none";
  std::string formulation_reason = "as the case says";  // why discretization.formulation is what it is
  Analysis analysis;
  std::optional<fracture::Growth> growth;
  std::optional<post::SrifOptions> srif;
  Output output;
};

}  // namespace cases
