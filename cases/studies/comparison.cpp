#include "cases/studies/comparison.hpp"

#include <fmt/format.h>

#include "cases/input/case_file.hpp"
#include "post/files/whole_file.hpp"
#include "post/report/html/comparison_page.hpp"
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
  const auto plot = post::plot(rows, post::title_of(options.folder));
  if (options.plot.extension() == ".html")
    post::write_whole(options.plot, post::comparison_page(plot, post::to_text(rows)));
  else if (!options.plot.empty())
    post::write_whole(options.plot, post::to_svg(plot));
  if (!options.json.empty()) post::write_whole(options.json, post::to_json(rows, above));
  return above.empty();
}

}  // namespace cases
