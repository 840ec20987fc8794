#include "cases/input/keys.hpp"

#include "cases/input/case.hpp"

namespace cases {
namespace {

Field<Case> text(const std::string& name, std::string Case::*member, const std::string& standard,
                 const std::string& help) {
  return value<Case>(
      {name, "-", "a string", standard, help},
      [=](const Value& given, Case& content) {
        if (const auto words = given.text()) content.*member = *words;
      },
      [=](const Case& content) { return quoted(content.*member); });
}

plate::Problem& problem_of(Case& content) {
  return content;
}
const plate::Problem& problem_of(const Case& content) {
  return content;
}

/// Of [[load]]: to read them all, to write them without those of load cases.
std::vector<plate::Load>& own_loads(Case& content) {
  return content.loads;
}
std::vector<plate::Load> own_loads(const Case& content) {
  return {content.loads.begin(), content.loads.begin() + std::ptrdiff_t(plate::shared_loads(content))};
}

}  // namespace

const Fields<Case>& case_fields() {
  const auto plate_of = [](auto& content) -> auto& {
    return problem_of(content);
  };
  const auto loads_of = [](auto& content) -> decltype(auto) { return own_loads(content); };
  static const Kinds loaded{Analysis::Kind::static_, Analysis::Kind::dynamic, Analysis::Kind::harmonic};
  static const Fields<Case> fields{
      text("title", &Case::title, "the file's name", "title of the case"),
      text("source", &Case::source, "\"\"", "where the case comes from"),
      choice<Case, std::string>("units", &Case::units, {{{"none", "none"}, {"SI", "SI"}}},
                                "unit system named in the results"),
      table<Case, plate::Section>("section", Layout::block, &Case::section, section_fields(), check_section),
      table<Case, plate::Problem>("geometry", Layout::block, plate_of, geometry_fields(), name_holes),
      table<Case, plate::Discretization>("discretization", Layout::block, &Case::discretization,
                                         discretization_fields()),
      tables<Case, plate::Support>("support", Layout::block, &Case::supports, support_fields()),
      tables<Case, plate::Foundation>("foundation", Layout::block, &Case::foundations, foundation_fields()),
      tables<Case, plate::Spring>("spring", Layout::block, &Case::springs, spring_fields()),
      tables<Case, plate::Stiffener>("stiffener", Layout::block, &Case::stiffeners, stiffener_fields()),
      tables<Case, plate::Load>("load", Layout::block, loads_of, load_fields(), check_load).used_in(loaded),
      tables<Case, plate::LoadCase>("case", Layout::block, &Case::load_cases, load_case_fields()),
      tables<Case, plate::Combination>("combination", Layout::block, &Case::combinations, combination_fields()),
      table<Case, plate::Initial>("initial", Layout::block, &Case::initial, initial_fields()).in_dynamics(),
      table<Case, plate::Impact>("impact", Layout::block, &Case::impact, impact_fields()).in_dynamics(),
      table<Case, Analysis>("analysis", Layout::block, &Case::analysis, analysis_fields(), check_analysis),
      table<Case, fracture::Growth>("growth", Layout::block, &Case::growth, growth_fields())
          .used_in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      table<Case, post::SrifOptions>("srif", Layout::block, &Case::srif, srif_fields(), check_srif).used_in(loaded),
      table<Case, Output>("output", Layout::block, &Case::output, output_fields()),
  };
  return fields;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> rows = [] {
    std::vector<Key> result;
    for (const auto& field : case_fields()) result.insert(result.end(), field.rows.begin(), field.rows.end());
    return result;
  }();
  return rows;
}

}  // namespace cases
