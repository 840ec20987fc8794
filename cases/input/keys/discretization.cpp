#include "plate/model/discretization.hpp"
#include "cases/input/keys.hpp"
#include "plate/formulations.hpp"
#include "plate/model/formulation_kind.hpp"

namespace cases {
namespace {

/// "auto" is settled when all is read: settle_formulation.
Words<const plate::FormulationKind*> formulation_words() {
  Words<const plate::FormulationKind*> words;
  for (const auto* kind : plate::formulations()) words.allowed.emplace_back(kind->name, kind);
  std::ranges::reverse(words.allowed);
  words.allowed.emplace_back("auto", plate::formulations().front());
  return words;
}

Field<plate::Discretization> refine_tips() {
  using D = plate::Discretization;
  return value<D>(
      {"refine_tips", "-", "true or false", "",
       "at rest without tip_spacing: closer points at tips where the plate is thinner than 12 spacings, or something "
       "lies within 24 spacings of a tip"},
      [](const Value& given, D& d) { d.refine_tips = given.boolean().value_or(d.refine_tips); },
      [](const D& d) { return std::string(d.refine_tips ? "true" : "false"); });
}

}  // namespace

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
          "formulation", &D::formulation, formulation_words(),
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
      choice<D, EdgeMethod>("boundary", &D::boundary, {edge_methods},
                            "held edges by mirror images and rows that follow or by layers, or all edges by surface "
                            "nodes or fictitious nodes; bonds only"),
      number<D>("tip_spacing", "length", &D::tip_spacing, positive,
                "distance of the points at crack tips, and at forces and pins next to them")
          .with(graded),
      number<D>("hole_spacing", "length", &D::hole_spacing, positive,
                "distance of the points at holes and at parts that are held")
          .with(graded),
      refine_tips().with(graded),
      number<D>("spacing_growth", "-", &D::spacing_growth, {0.02, 1}, "growth of that distance per length from there")
          .with(graded),
  };
}

}  // namespace cases
