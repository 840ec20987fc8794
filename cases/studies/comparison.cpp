#include "cases/studies/comparison.hpp"

#include <fmt/format.h>

#include "cases/input/case_file.hpp"
#include "post/files/whole_file.hpp"
#include "post/report/html/comparison_page.hpp"
#include "post/studies/compare.hpp"

namespace cases {
namespace {

std::vector<post::ComparedQuantity> compared(const ComparisonOptions& options) {
  if (!std::filesystem::exists(options.reference))
    throw CaseError({{options.reference.string(), "compare", "no such file"}});
  try {
    return post::compare(options.folder, options.reference);
  } catch (const std::exception& error) {  // it reads and compares what the arguments name, and does nothing else
    throw CaseError({{options.reference.string(), "compare", error.what()}});
  }
}

/// As far as the case of the run is there, and can be read.
bool is_si(const std::filesystem::path& folder) {
  const auto file = folder / "case.resolved.toml";
  try {
    return std::filesystem::exists(file) && read_case(file, {}).content.units == "SI";
  } catch (const CaseError&) {
    return false;
  }
}

}  // namespace

bool compare(const ComparisonOptions& options) {
  post::Tolerances tolerances;
  try {
    tolerances = post::tolerances(options.tolerances, options.within);
  } catch (const std::invalid_argument& error) {
    throw CaseError({{"compare", "--tolerance", error.what()}});
  }
  const auto rows = compared(options);
  const auto above = post::exceeded(rows, tolerances);
  fmt::print("{}{}", post::to_text(rows), post::to_text(above));
  if (!options.plot.empty()) {
    const auto plot = post::plot(rows, post::title_of(options.folder), is_si(options.folder));
    const bool page = options.plot.extension() == ".html";
    post::write_whole(options.plot, page ? post::comparison_page(plot, post::to_text(rows)) : post::to_svg(plot));
  }
  if (!options.json.empty()) post::write_whole(options.json, post::to_json(rows, above));
  return above.empty();
}

}  // namespace cases
