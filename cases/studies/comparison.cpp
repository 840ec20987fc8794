#include "cases/studies/comparison.hpp"

#include <fmt/format.h>

#include "cases/input/problems.hpp"
#include "post/files/whole_file.hpp"
#include "post/studies/compare.hpp"

namespace cases {

bool compare(const ComparisonOptions& options) {
  post::Tolerances tolerances;
  try {
    tolerances = post::tolerances(options.tolerances, options.within);
  } catch (const std::invalid_argument& error) {
    throw CaseError({{"compare", "--tolerance", error.what()}});
  }
  const auto rows = post::compare(options.folder, options.reference);
  const auto above = post::exceeded(rows, tolerances);
  fmt::print("{}{}", post::to_text(rows), post::to_text(above));
  if (!options.plot.empty())
    post::write_whole(options.plot, post::to_svg(post::plot(rows, post::title_of(options.folder))));
  if (!options.json.empty()) post::write_whole(options.json, post::to_json(rows, above));
  return above.empty();
}

}  // namespace cases
