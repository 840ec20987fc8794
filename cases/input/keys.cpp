#include "cases/input/keys.hpp"
#include "cases/input/case_file.hpp"

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/galerkin/galerkin_plate.hpp"

namespace cases {

namespace {

Fields<plate::Section> section_fields() {
  using plate::Section;
  return {
      number<Section>("young", "force/length^2", &Section::young, positive, "Young's modulus").required(),
      number<Section>("poisson", "-", &Section::poisson, {-1, 0.5, true, true}, "Poisson's ratio").required(),
      number<Section>("thickness", "length", &Section::thickness, positive, "thickness of the plate").required(),
      number<Section>("shear_correction", "-", &Section::shear_correction, {0, 1, true},
                      "factor of the transverse shear stiffness"),
      number<Section>("density", "mass/length^3", &Section::density, positive,
                      "mass density; without effect in statics")
          .required({Analysis::Kind::dynamic, Analysis::Kind::frequencies}),
  };
}

Fields<plate::Discretization> discretization_fields() {
  using namespace plate;
  using D = Discretization;
  const Condition<D> graded{"formulation", "formulation = galerkin",
                            [](const D& d) { return d.formulation->offers(Feature::graded_points); }};
  return {
      number<D>("spacing", "length", &D::spacing, positive, "distance of the points; at least 4 across the plate")
          .required()
          .unless_found(),
      number<D>("horizon_ratio", "-", &D::horizon_ratio, {1.5, 20}, "horizon / spacing"),
      choice<D, const FormulationKind*>(
          "formulation", &D::formulation,
          {{{"ordinary", &ordinary},
            {"galerkin", &plate::galerkin},
            {"auto", &plate::galerkin}}},  // until all is read: settle_formulation
          "bonds of the ordinary state-based plate, the Galerkin plate, or the latter unless the case asks "
          "for what only bonds have; see \"Formulations\"")
          .standard("\"auto\""),
      choice<D, Influence>("influence", &D::influence,
                           {{{"inverse", Influence::inverse}, {"constant", Influence::constant}}},
                           "influence function: horizon / length, or 1"),
      choice<D, VolumeCorrection>(
          "volume_correction", &D::volume_correction,
          {{{"none", VolumeCorrection::none},
            {"linear", VolumeCorrection::linear},
            {"lattice_fitted", VolumeCorrection::lattice_fitted}}},
          "share of a neighbour's cell inside the horizon; lattice_fitted: isotropic in bending"),
      choice<D, SurfaceCorrection>("surface_correction", &D::surface_correction,
                                   {{{"none", SurfaceCorrection::none},
                                     {"volume", SurfaceCorrection::volume},
                                     {"arbitrary_horizon", SurfaceCorrection::arbitrary_horizon},
                                     {"position_aware", SurfaceCorrection::position_aware}}},
                                   "how bond constants follow a family cut by edges and cracks"),
      choice<D, FullHorizon>("full_horizon", &D::full_horizon,
                             {{{"continuum", FullHorizon::continuum}, {"lattice", FullHorizon::lattice}}},
                             "constants of a full family: integrals over the disc, or sums over the lattice"),
      choice<D, TwistMatch>("twist_match", &D::twist_match,
                            {{{"frame_invariant", TwistMatch::frame_invariant}, {"paper", TwistMatch::paper}}},
                            "calibration of the twist constant: independent of the axes, or as in Dai 35"),
      number<D>("tip_spacing", "length", &D::tip_spacing, positive, "distance of the points at crack tips")
          .with(graded),
      number<D>("hole_spacing", "length", &D::hole_spacing, positive, "distance of the points at holes").with(graded),
      number<D>("spacing_growth", "-", &D::spacing_growth, {0.02, 1}, "growth of that distance per length from there")
          .with(graded),
  };
}

Field<Case> text(const std::string& name, std::string Case::*member, const std::string& standard,
                 const std::string& help) {
  return value<Case>(
      {name, "-", "a string", standard, help},
      [=](const Value& given, Case& content) {
        if (const auto words = given.text()) content.*member = *words;
      },
      [=](const Case& content) { return quoted(content.*member); });
}

}  // namespace

const Fields<Case>& case_fields() {
  static const Kinds loaded{Analysis::Kind::static_, Analysis::Kind::dynamic};
  static const Fields<Case> fields{
      text("title", &Case::title, "the file's name", "title of the case"),
      text("source", &Case::source, "\"\"", "where the case comes from"),
      choice<Case, std::string>("units", &Case::units, {{{"none", "none"}, {"SI", "SI"}}},
                                "unit system named in the results"),
      table<Case, plate::Section>("section", Layout::block, &Case::section, section_fields()),
      table<Case, Case>("geometry", Layout::block, std::identity{}, geometry_fields(), name_holes),
      table<Case, plate::Discretization>("discretization", Layout::block, &Case::discretization,
                                         discretization_fields()),
      tables<Case, plate::Support>("support", Layout::block, &Case::supports, support_fields()),
      tables<Case, plate::Load>("load", Layout::block, &Case::loads, load_fields(), check_load).used_in(loaded),
      table<Case, Analysis>("analysis", Layout::block, &Case::analysis, analysis_fields(), check_analysis),
      table<Case, fracture::Growth>("growth", Layout::block, &Case::growth, growth_fields()).used_in(loaded),
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

std::string key_table_markdown() {
  std::string text = "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
  for (const auto& key : keys())
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.unit, key.allowed, key.standard, key.help);
  return text;
}

std::string analyses(const Kinds& kinds) {
  std::vector<std::string> names;
  for (const auto kind : kinds)
    names.push_back(kind == Analysis::Kind::static_   ? "statics"
                    : kind == Analysis::Kind::dynamic ? "dynamics"
                                                      : "frequencies");
  return fmt::format("{}", fmt::join(names, " and "));
}

std::string kind_names(const Kinds& kinds) {
  std::vector<std::string> names;
  for (const auto kind : kinds) names.push_back(analysis_kinds().name(kind));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string Bounds::text(bool whole) const {
  const char* number = whole ? "an integer" : "a number";
  if (std::isinf(low) && std::isinf(high)) return "a finite number";
  if (std::isinf(high)) return fmt::format("{} {} {}", number, low_open ? ">" : ">=", low);
  return fmt::format("{} in {}{}, {}{}", number, low_open ? '(' : '[', low, high, high_open ? ')' : ']');
}

void complain_about_unknown(const Value& table, const std::vector<std::string>& names) {
  constexpr std::size_t most = 100;  // of a table: each is looked for among all keys
  std::size_t found = 0;
  for (const auto& [name, node] : *table.table()) {
    const std::string word(name.str());
    if (std::find(names.begin(), names.end(), word) != names.end()) continue;
    if (++found > most) return table.complain("has further unknown keys");
    std::string hint = did_you_mean(word, names);
    for (const auto& key : keys())
      if (hint.empty() && key.name.ends_with("." + word)) hint = fmt::format(" (did you mean '{}'?)", key.name);
    if (hint.empty()) hint = fmt::format("; known here: {}", fmt::join(names, ", "));
    const Value unknown(node, table.below(word), table.reading());
    unknown.complain(fmt::format("unknown key '{}'{}", word, hint));
  }
}

}  // namespace cases
