#include "cases/input/keys.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/response/harmonic.hpp"

namespace cases {
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

}  // namespace

const Words<Analysis::Kind>& analysis_kinds() {
  static const Words<Analysis::Kind> words = [] {
    Words<Analysis::Kind> result;
    for (const auto kind : any_kind) result.allowed.emplace_back(plate::name_of(kind), kind);
    return result;
  }();
  return words;
}

Fields<Analysis> analysis_fields() {
  using A = Analysis;
  const Kinds iterative{A::Kind::static_, A::Kind::frequencies};
  const auto unless = [](Field<A> field, A::Method method) {
    field.write = [write = field.write, method](const A& analysis, A::Kind kind) {
      return analysis.method == method ? std::string() : write(analysis, kind);
    };
    return field;
  };
  return {
      choice<A, A::Kind>("kind", &A::kind, analysis_kinds(),
                         "what is sought: equilibrium, motion, eigenfrequencies, or harmonic (steady-state) response")
          .required(),
      choice<A, A::Method>("method", &A::method, methods,
                           "static: adaptive dynamic relaxation, conjugate gradients or a factorisation; dynamic: "
                           "steps, or Lanczos vectors "
                           "that move exactly")
          .standard(
              "static: \"cg\"; dynamic: \"central_difference\", \"lanczos\" with graded points or stiffness damping; "
              "frequencies: \"lanczos\""),
      choice<A, plate::Preconditioning>(
          "preconditioner", &A::preconditioner, preconditioners,
          "of cg: the diagonal; the factor of a plate with a horizon of 1.5 spacings; the same on every "
          "second point each way; or what is likely to be fastest of first and last (theory.md, \"Statics\")")
          .in({A::Kind::static_}),
      unless(number<A>(
                 "tolerance", "-", &A::tolerance, {1e-14, 0.1},
                 "static: residual / load at which a solution is accepted; frequencies: of the eigenpairs; "
                 "dynamic, with lanczos: of "
                 "the motion, rms over the mass, relative to the largest; harmonic: likewise, of the response at every "
                 "frequency, and of factors")
                 .standard("static: 1e-06; frequencies: 0.0001; dynamic, harmonic: 0.0003"),
             A::Method::central_difference),
      number<A>("max_iterations", "-", &A::max_iterations, {1, 1e9}, "limit of iterations of each solution")
          .in(iterative),
      number<A>("modes", "-", &A::modes, {1, 1000}, "number of frequencies, from the lowest")
          .in({A::Kind::frequencies}),
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
  if (*kind == Analysis::Kind::frequencies || *kind == Analysis::Kind::harmonic) possible = {lanczos};
  const std::string key = given.below("method");
  if (!given.reading().given(key)) analysis.method = possible.front();
  if (!given.reading().given(given.below("tolerance"))) {
    if (*kind == Analysis::Kind::frequencies) analysis.tolerance = plate::FrequencyOptions{}.tolerance;
    if (*kind == Analysis::Kind::dynamic) analysis.tolerance = plate::LanczosOptions{}.tolerance;
    if (*kind == Analysis::Kind::harmonic) analysis.tolerance = plate::HarmonicOptions{}.tolerance;
  }
  for (const char* name : {"damping", "sweep"})
    if (*kind == Analysis::Kind::harmonic && !given.reading().given(given.below(name)))
      given.complain(fmt::format("'{}' is missing, {}", name,
                                 name[0] == 'd' ? "without it nothing limits a resonance"
                                                : "the frequencies of the loads: { from, to, count }"));
  if (!given.reading().sound(key) || std::find(possible.begin(), possible.end(), analysis.method) != possible.end())
    return;
  std::vector<std::string> names;
  for (const auto method : possible) names.push_back(quoted(methods.name(method)));
  given.reading().complain(key, fmt::format("\"{}\" given, must be {} in {}", methods.name(analysis.method),
                                            fmt::join(names, " or "), analyses({*kind})));
}

}  // namespace cases
