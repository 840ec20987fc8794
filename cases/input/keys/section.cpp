#include "plate/model/section.hpp"
#include "cases/input/keys.hpp"

namespace cases {
namespace {

using plate::Orthotropy;
using plate::Ply;
using plate::Section;
using plate::SectionRegion;

/// Of a whole section or of a ply.
template <typename Material>
Fields<Material> orthotropy_fields() {
  const auto modulus = [](const char* name, double Orthotropy::*member, const char* help) {
    return number<Material>(name, "force/length^2", member, positive, help).required();
  };
  return {
      modulus("E1", &Orthotropy::E1, "Young's modulus along axis 1"),
      modulus("E2", &Orthotropy::E2, "Young's modulus along axis 2"),
      number<Material>("nu12", "-", &Orthotropy::nu12, finite,
                       "Poisson's ratio: contraction along 2 under stress along 1; nu12^2 < E1 / E2")
          .required(),
      modulus("G12", &Orthotropy::G12, "shear modulus in the plane"),
      modulus("G13", &Orthotropy::G13, "transverse shear modulus along axis 1"),
      modulus("G23", &Orthotropy::G23, "transverse shear modulus along axis 2"),
      number<Material>("angle", "degrees", &Orthotropy::angle, finite, "of axis 1 from x, counter-clockwise"),
  };
}

void check_orthotropy(const Value& given, const Orthotropy& m) {
  const auto& reading = given.reading();
  for (const char* name : {"E1", "E2", "nu12"})
    if (!reading.given(given.below(name)) || !reading.sound(given.below(name))) return;
  if (!m.stable())
    given.reading().complain(given.below("nu12"),
                             fmt::format("{:g} given, must be below sqrt(E1 / E2) = {:.6g} in size: strains would cost "
                                         "no energy",
                                         m.nu12, std::sqrt(m.E1 / m.E2)));
}

Fields<Ply> ply_fields() {
  auto fields = orthotropy_fields<Ply>();
  fields.push_back(number<Ply>("thickness", "length", &Ply::thickness, positive, "thickness of the ply").required());
  fields.push_back(
      number<Ply>("density", "mass/length^3", &Ply::density, positive, "of the ply; without it section.density"));
  return fields;
}

Fields<SectionRegion> region_fields() {
  using R = SectionRegion;
  auto shape = table<R, geometry::Hole>(
      "on", Layout::inline_, &R::shape,
      hole_fields("the disc that has these numbers", "the polygon that has these numbers"), check_hole);
  shape.needed = any_kind;
  return {
      std::move(shape),
      number<R>("thickness", "length", &R::thickness, positive, "thickness there"),
      number<R>("young", "force/length^2", &R::young, positive, "Young's modulus there"),
      number<R>("poisson", "-", &R::poisson, {-1, 0.5, true, true}, "Poisson's ratio there"),
      number<R>("density", "mass/length^3", &R::density, positive, "mass density there"),
  };
}

Field<Section> factor(const std::string& name, plate::Formula Section::*member, const std::string& of) {
  return value<Section>(
      {name, "-", "an expression in x, y and pi", "", of + " at a place over section." + of + ", as \"1 + 0.2 * x\""},
      [=](const Value& given, Section& section) {
        if (const auto formula = formula_of(given)) section.*member = *formula;
      },
      [=](const Section& section) {
        return (section.*member).given() ? quoted((section.*member).text()) : std::string();
      });
}

void check_region(const Value& given, SectionRegion& region) {
  if (given.reading().sound(given.key()) && !region.thickness && !region.young && !region.poisson && !region.density)
    given.complain("changes nothing: give thickness, young, poisson or density");
}

/// Plies of the same material, angle and thickness at the same distance above and below the middle?
bool symmetric(const std::vector<Ply>& plies) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); };
  for (std::size_t i = 0, j = plies.size(); i < j--; ++i) {
    const Ply &a = plies[i], &b = plies[j];
    const double turns = (a.angle - b.angle) / 180;
    if (!same(a.thickness, b.thickness) || !same(a.E1, b.E1) || !same(a.E2, b.E2) || !same(a.nu12, b.nu12) ||
        !same(a.G12, b.G12) || !same(a.G13, b.G13) || !same(a.G23, b.G23) ||
        std::abs(turns - std::round(turns)) > 1e-9 || a.density.value_or(0) != b.density.value_or(0))
      return false;
  }
  return true;
}

void check_plies(const Value& given, Section& section) {
  auto& reading = given.reading();
  const auto key = given.below("plies");
  section.thickness = 0;
  for (const auto& ply : section.plies) section.thickness += ply.thickness;
  if (reading.sound(key) && !symmetric(section.plies))
    reading.complain(key,
                     "must be symmetric about the middle: other plates stretch where they bend, and this plate has no "
                     "displacements in its plane");
}

}  // namespace

Fields<Section> section_fields() {
  const Condition<Section> isotropic{"orthotropic", "neither orthotropic nor plies",
                                     [](const Section& s) { return s.isotropic(); }};
  const Condition<Section> of_one{"plies", "one material over the thickness",
                                  [](const Section& s) { return s.plies.empty(); }};
  return {
      table<Section, Orthotropy>("orthotropic", Layout::inline_, &Section::orthotropic, orthotropy_fields<Orthotropy>(),
                                 [](const Value& given, Orthotropy& m) { check_orthotropy(given, m); }),
      tables<Section, Ply>("plies", Layout::inline_, &Section::plies, ply_fields(),
                           [](const Value& given, Ply& ply) { check_orthotropy(given, ply); }),
      number<Section>("young", "force/length^2", &Section::young, positive, "Young's modulus")
          .required()
          .with(isotropic),
      number<Section>("poisson", "-", &Section::poisson, {-1, 0.5, true, true}, "Poisson's ratio")
          .required()
          .with(isotropic),
      number<Section>("thickness", "length", &Section::thickness, positive, "thickness of the plate")
          .required()
          .with(of_one),
      number<Section>("shear_correction", "-", &Section::shear_correction, {0, 1, true},
                      "factor of the transverse shear stiffness"),
      number<Section>("thermal_expansion", "1/temperature", &Section::thermal_expansion, positive,
                      "strain per temperature, of loads of kind = temperature"),
      number<Section>("density", "mass/length^3", &Section::density, positive,
                      "mass density; in statics of own weight alone")
          .required({Analysis::Kind::dynamic, Analysis::Kind::frequencies, Analysis::Kind::harmonic}),
      factor("thickness_factor", &Section::thickness_factor, "thickness").with(of_one),
      factor("young_factor", &Section::young_factor, "young").with(isotropic),
      tables<Section, SectionRegion>("regions", Layout::inline_, &Section::regions, region_fields(), check_region)
          .with(of_one),
  };
}

void check_section(const Value& given, Section& section) {
  auto& reading = given.reading();
  if (!section.plies.empty()) check_plies(given, section);
  if (section.orthotropic && !section.plies.empty())
    reading.complain(given.below("orthotropic"),
                     "is given beside plies, which have materials of their own: remove one");
  for (std::size_t i = 0; section.orthotropic && i < section.regions.size(); ++i)
    for (const char* name : {"young", "poisson"})
      if (const auto key = fmt::format("section.regions[{}].{}", i, name); reading.given(key))
        reading.complain(key, "is of isotropic sections: remove it");
}

}  // namespace cases
