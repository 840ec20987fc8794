#include "cases/input/keys.hpp"
#include "plate/formulations.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/motion/harmonic.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/motion/time_grid.hpp"

namespace cases {
namespace {

/// "auto" is resolved when all is read: resolve_formulation.
Words<const plate::FormulationKind*> formulation_words() {
  Words<const plate::FormulationKind*> words;
  for (const auto* kind : plate::formulations()) words.allowed.emplace_back(kind->name, kind);
  std::ranges::reverse(words.allowed);
  words.allowed.emplace_back("auto", plate::formulations().front());
  return words;
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
      boolean<D>("refine_tips", &D::refine_tips,
                 "at rest without tip_spacing: closer points at tips where the plate is thinner than 12 spacings, or "
                 "something lies within 24 spacings of a tip, and, also for frequencies, at corners of the outline "
                 "and of polygon holes of more than 200 degrees")
          .with(graded),
      number<D>("spacing_growth", "-", &D::spacing_growth, {0.02, 1}, "growth of that distance per length from there")
          .with(graded),
  };
}

namespace {

const Words<Analysis::Method> methods{{{"adr", Analysis::Method::adr},
                                       {"cg", Analysis::Method::cg},
                                       {"central_difference", Analysis::Method::central_difference},
                                       {"direct", Analysis::Method::direct},
                                       {"lanczos", Analysis::Method::lanczos}}};

const Words<plate::Preconditioning> preconditioners{{{"auto", plate::Preconditioning::automatic},
                                                     {"diagonal", plate::Preconditioning::diagonal},
                                                     {"local", plate::Preconditioning::local},
                                                     {"two_level", plate::Preconditioning::two_level},
                                                     {"levels", plate::Preconditioning::levels}}};

const Words<Analysis::Precision> precisions{
    {{"double", Analysis::Precision::double_}, {"mixed", Analysis::Precision::mixed}}};

const Words<plate::LoadControl> load_controls{
    {{"load", plate::LoadControl::load}, {"arc_length", plate::LoadControl::arc_length}}};

const Words<Analysis::Start> starts{
    {{"undeformed", Analysis::Start::undeformed}, {"equilibrium", Analysis::Start::equilibrium}}};

Field<Analysis> time_step() {
  return value<Analysis>(
      {"time_step", "time", "\"auto\" or a number > 0", "\"auto\"", "time step; auto: safety times the stable step"},
      [](const Value& given, Analysis& analysis) {
        if (given.is_text() && *given.text() == "auto") return;
        const auto step = given.is_text() ? std::nullopt : given.number();
        if (step && *step > 0)
          analysis.time_step = *step;
        else if (given.is_text() || step)
          given.refuse("\"auto\" or a number > 0");
      },
      [](const Analysis& analysis) { return analysis.time_step ? number_text(*analysis.time_step) : quoted("auto"); });
}

/// Two numbers that become mass and stiffness, and are not written again.
Field<plate::Damping> pair(const std::string& name, const std::string& unit, const std::string& help) {
  return value<plate::Damping>(
      {name, unit, "[a, b], both > 0", "", help},
      [](const Value& given, plate::Damping&) {
        const auto both = given.numbers(2, "[a, b], both > 0");
        if (both && !((*both)[0] > 0 && (*both)[1] > 0)) given.refuse("[a, b], both > 0");
      },
      [](const plate::Damping&) { return ""; });
}

Fields<plate::Sweep> sweep_fields() {
  using S = plate::Sweep;
  return {number<S>("from", "1/time", &S::from, positive, "the lowest frequency of the loads")
              .required({Analysis::Kind::harmonic}),
          number<S>("to", "1/time", &S::to, positive, "the highest").required({Analysis::Kind::harmonic}),
          number<S>("count", "-", &S::count, {2, 100000},
                    "how many, equally far from each other; resonances between them come beside")};
}

void check_sweep(const Value& given, plate::Sweep& sweep) {
  if (given.reading().sound(given.key()) && !(sweep.to > sweep.from)) given.report_error("'to' must be above 'from'");
}

Fields<plate::Damping> damping_fields() {
  using D = plate::Damping;
  return {number<D>("mass", "1/time", &D::mass, {0}, "alpha of C = alpha M + beta K"),
          number<D>("stiffness", "time", &D::stiffness, {0}, "beta of C = alpha M + beta K"),
          pair("ratio", "-", "of the critical damping at the two frequencies, instead of mass and stiffness"),
          pair("frequencies", "1/time", "where the plate has these ratios")};
}

void check_damping(const Value& given, plate::Damping& damping) {
  auto& reading = given.reading();
  const auto has = [&](const char* name) { return reading.given(given.below(name)); };
  const auto two = [&](const char* name) -> std::array<double, 2> {
    const auto both = Value(*given.table()->get(name), given.below(name), reading).numbers(2, "[a, b]");
    return {both->at(0), both->at(1)};
  };
  if (has("ratio") != has("frequencies"))
    return given.report_error("'ratio' and 'frequencies' belong together: give both, or mass and stiffness");
  if (!has("ratio")) {
    if (damping.none() && reading.sound(given.key()))
      given.report_error("damps nothing: give mass and stiffness, or ratio and frequencies");
    return;
  }
  if (has("mass") || has("stiffness"))
    return given.report_error(
        "'mass' and 'stiffness' follow from 'ratio' and 'frequencies': give one pair or the other");
  if (!reading.sound(given.key())) return;
  const auto frequencies = two("frequencies");
  if (!(frequencies[0] < frequencies[1])) return given.report_error("the second frequency must be above the first");
  damping = plate::damping_of(two("ratio"), frequencies);
  if (damping.mass < 0 || damping.stiffness < 0)
    given.report_error(
        fmt::format("no plate has such ratios: mass = {:.4g} and stiffness = {:.4g} would be needed, and none "
                    "may be negative; bring the ratios nearer to each other",
                    damping.mass, damping.stiffness));
}

}  // namespace

const Words<Analysis::Kind>& analysis_kinds() {
  static const Words<Analysis::Kind> words = [] {
    Words<Analysis::Kind> result;
    for (const auto kind : any_kind) result.allowed.emplace_back(plate::name_of(kind), kind);
    return result;
  }();
  return words;
}

namespace {

/// A field that is not written where the method has no use for it.
Field<Analysis> unless(Field<Analysis> field, Analysis::Method method) {
  field.write = [write = field.write, method](const Analysis& analysis, Analysis::Kind kind) {
    return analysis.method == method ? std::string() : write(analysis, kind);
  };
  return field;
}

Field<Analysis> control() {
  return choice<Analysis, plate::LoadControl>("control", &Analysis::control, load_controls,
                                              "what a step of the loads holds: their factor, or the length of the "
                                              "path, which goes through limit points")
      .with({"nonlinear", "nonlinear = true", [](const Analysis& analysis) { return analysis.nonlinear; }})
      .in({Analysis::Kind::static_});
}

Field<Analysis> max_steps() {
  return number<Analysis>("max_steps", "-", &Analysis::max_steps, {1, 100000}, "limit of the steps")
      .with({"control", "control = arc_length",
             [](const Analysis& analysis) { return analysis.control == plate::LoadControl::arc_length; }})
      .in({Analysis::Kind::static_});
}

}  // namespace

Fields<Analysis> analysis_fields() {
  using A = Analysis;
  const Kinds iterative{A::Kind::static_, A::Kind::frequencies};
  return {
      choice<A, A::Kind>(
          "kind", &A::kind, analysis_kinds(),
          "what is sought: equilibrium, motion, eigenfrequencies, harmonic (steady-state) response, or the "
          "loads in the plane at which it buckles")
          .required(),
      choice<A, A::Method>("method", &A::method, methods,
                           "static: adaptive dynamic relaxation, conjugate gradients or a factorisation; dynamic: "
                           "steps, or Lanczos vectors "
                           "that move exactly")
          .standard("static: \"cg\"; dynamic: \"central_difference\", of galerkin plates with graded points or "
                    "stiffness damping "
                    "\"lanczos\"; "
                    "frequencies, buckling: \"lanczos\""),
      choice<A, plate::Preconditioning>(
          "preconditioner", &A::preconditioner, preconditioners,
          "of cg: the diagonal; the factor of a plate with a horizon of 1.5 spacings; the same on every "
          "second point each way; or what is likely to be fastest of first and last (theory.md, \"Statics\")")
          .in({A::Kind::static_}),
      unless(number<A>(
                 "tolerance", "-", &A::tolerance, {1e-14, 0.1},
                 "static: residual / load at which a solution is accepted; frequencies, buckling: of the eigenpairs; "
                 "dynamic, with lanczos: of "
                 "the motion, rms over the mass, relative to the largest; harmonic: likewise, of the response at every "
                 "frequency, and of factors")
                 .standard("static, buckling: 1e-06; frequencies: 0.0001; dynamic, harmonic: 0.0003"),
             A::Method::central_difference),
      number<A>("max_iterations", "-", &A::max_iterations, {1, 1e9}, "limit of iterations of each solution")
          .in(iterative),
      number<A>("modes", "-", &A::modes, {1, 1000}, "number of frequencies or of buckling loads, from the lowest")
          .in({A::Kind::frequencies, A::Kind::buckling}),
      boolean<A>("nonlinear", &A::nonlinear, "large deflections: the middle plane stretches with them (von Karman)")
          .in({A::Kind::static_, A::Kind::dynamic}),
      control(),
      max_steps(),
      number<A>("duration", "time", &A::duration, positive, "simulated time").required().in_dynamics(),
      choice<A, A::Start>("start", &A::start, starts,
                          "the plate at time 0: without deformation, or in equilibrium with the loads of that time")
          .in({A::Kind::dynamic}),
      table<A, plate::Damping>("damping", Layout::inline_, &A::damping, damping_fields(), check_damping)
          .in({A::Kind::dynamic, A::Kind::harmonic}),
      table<A, plate::Sweep>("sweep", Layout::inline_, &A::sweep, sweep_fields(), check_sweep).in({A::Kind::harmonic}),
      unless(time_step().in_dynamics(), A::Method::lanczos),
      number<A>("rotary_inertia", "-", &A::rotary_inertia, {1, 1e6},
                "factor of the rotary inertia: above 1 thin plates take longer steps, and short waves run slower")
          .in_dynamics(),
      choice<A, A::Precision>("precision", &A::precision, precisions,
                              "mixed has internal forces in single precision, displacements in double; refused "
                              "where rounding would show")
          .in({A::Kind::dynamic}),
      unless(number<A>("safety", "-", &A::safety, {0, 1, true}, "share of the stable step that is used").in_dynamics(),
             A::Method::lanczos),
  };
}

void check_analysis(const Value& given, Analysis& analysis) {
  using enum Analysis::Method;
  const auto kind = given.reading().kind;
  if (!kind) return;
  std::vector<Analysis::Method> possible{cg, adr, direct};
  if (*kind == Analysis::Kind::dynamic) possible = {central_difference, lanczos};
  if (*kind != Analysis::Kind::dynamic && *kind != Analysis::Kind::static_) possible = {lanczos};
  const std::string key = given.below("method");
  if (!given.reading().given(key)) analysis.method = possible.front();
  if (!given.reading().given(given.below("tolerance"))) {
    if (*kind == Analysis::Kind::frequencies) analysis.tolerance = plate::FrequencyOptions{}.tolerance;
    if (*kind == Analysis::Kind::dynamic) analysis.tolerance = plate::LanczosOptions{}.tolerance;
    if (*kind == Analysis::Kind::harmonic) analysis.tolerance = plate::HarmonicOptions{}.tolerance;
  }
  for (const char* name : {"damping", "sweep"})
    if (*kind == Analysis::Kind::harmonic && !given.reading().given(given.below(name)))
      given.report_error(fmt::format("'{}' is missing, {}", name,
                                     name[0] == 'd' ? "without it nothing limits a resonance"
                                                    : "the frequencies of the loads: { from, to, count }"));
  if (!given.reading().sound(key) || std::find(possible.begin(), possible.end(), analysis.method) != possible.end())
    return;
  std::vector<std::string> names;
  for (const auto method : possible) names.push_back(quoted(methods.name(method)));
  given.reading().report_error(key, fmt::format("\"{}\" given, must be {} in {}", methods.name(analysis.method),
                                                fmt::join(names, " or "), analyses({*kind})));
}

}  // namespace cases
