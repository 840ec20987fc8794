#include "cases/input/keys.hpp"
#include "cases/input/output.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "post/factors/srif.hpp"

namespace cases {

namespace {

using post::Normalization;
using post::SrifOptions;

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

Fields<Normalization> normalization_fields() {
  using N = Normalization;
  return {
      number<N>("pressure", "force/length^2", &N::pressure, positive,
                "with width: F = K / (pressure (width/2)^2 sqrt(half_length))"),
      number<N>("width", "length", &N::width, positive, "width of the plate, with pressure"),
      number<N>("moment", "force", &N::moment, positive,
                "F = K / (moment sqrt(half_length)), instead of pressure and width"),
  };
}

void check_normalization(const Value& given, Normalization& n) {
  if (!given.reading().sound(given.key())) return;
  const bool pressure = n.pressure && n.width && !n.moment, moment = n.moment && !n.pressure && !n.width;
  if (!pressure && !moment) given.refuse("either { pressure = .., width = .. } or { moment = .. }");
}

/// A list of words without repetition.
std::vector<std::string> chosen(const Value& given, const Words<int>& words) {
  std::vector<std::string> result;
  const auto names = given.texts();
  if (!names) return result;
  for (const auto& name : *names) {
    if (!words.find(given, name)) continue;
    if (std::find(result.begin(), result.end(), name) == result.end())
      result.push_back(name);
    else
      given.complain(fmt::format("\"{}\" is named twice", name));
  }
  return result;
}

Field<SrifOptions> srif_methods() {
  static const Words<int> words{{{"virtual_crack_extension", 0},
                                 {"domain_integral", 0},
                                 {"displacement_extrapolation", 0},
                                 {"opening_series", 0},
                                 {"series_fit", 0}}};
  return value<SrifOptions>(
      {"methods", "-", "a list of " + words.text(), "", "how the intensity factors are found"},
      [](const Value& given, SrifOptions& options) {
        const auto found = chosen(given, words);
        if (!found.empty())
          options.methods = found;
        else if (given.reading().sound(given.key()))
          given.refuse("a list of at least one of " + words.text());
      },
      [](const SrifOptions& options) { return text_of(options.methods); });
}

Field<SrifOptions> boolean(const std::string& name, bool SrifOptions::*member, const std::string& help) {
  return value<SrifOptions>(
      {name, "-", "true or false", "", help},
      [=](const Value& given, SrifOptions& options) { options.*member = given.boolean().value_or(options.*member); },
      [=](const SrifOptions& options) { return std::string(options.*member ? "true" : "false"); });
}

Field<Output> report() {
  return value<Output>(
             {"report", "-", "true or false", "", "report.html, a page of results to look at and to hand on"},
             [](const Value& given, Output& output) { output.report = given.boolean(); },
             [](const Output& output) { return std::string(output.reports() ? "true" : "false"); })
      .standard("true where fields are written");
}

Field<Output> fields() {
  static const Words<int> words{{{"vtk", 0}, {"hdf5", 1}}};
  return value<Output>(
      {"fields", "-", "a list of " + words.text(), "", "files of fields: for ParaView, for HDF5"},
      [](const Value& given, Output& output) {
        const auto found = chosen(given, words);
        output.vtk = std::find(found.begin(), found.end(), "vtk") != found.end();
        output.hdf5 = std::find(found.begin(), found.end(), "hdf5") != found.end();
      },
      [](const Output& output) {
        std::vector<std::string> names;
        if (output.vtk) names.push_back("vtk");
        if (output.hdf5) names.push_back("hdf5");
        return text_of(names);
      });
}

bool bare(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

Field<Output> probes() {
  return value<Output>(
      {"probes", "length", "{ name = [x, y], ... } in the plate", "", "points whose w and rotations are recorded"},
      [](const Value& given, Output& output) {
        const auto* entries = given.table();
        if (!entries) return;
        for (const auto& [name, node] : *entries) {
          const Value probe(node, given.below(std::string(name.str())), given.reading());
          if (!bare(std::string(name.str()))) probe.complain("the name of a probe has letters, digits, _ and - only");
          if (const auto point = probe.point()) output.probes[std::string(name.str())] = *point;
        }
      },
      [](const Output& output) {
        std::vector<std::string> texts;
        for (const auto& [name, point] : output.probes) texts.push_back(name + " = " + text_of(point));
        return texts.empty() ? "" : fmt::format("{{ {} }}", fmt::join(texts, ", "));
      });
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
      choice<A, A::Kind>("kind", &A::kind, analysis_kinds(), "what is sought: rest, motion, eigenfrequencies")
          .required(),
      choice<A, A::Method>("method", &A::method, methods,
                           "static: adaptive dynamic relaxation, conjugate gradients or a factorisation; dynamic: "
                           "steps, or Lanczos vectors "
                           "that move exactly")
          .standard("static: \"cg\"; dynamic: \"central_difference\", \"lanczos\" with graded points; frequencies: "
                    "\"lanczos\""),
      choice<A, plate::Preconditioning>(
          "preconditioner", &A::preconditioner, preconditioners,
          "of cg: the diagonal; the factor of a plate with a horizon of 1.5 spacings; the same on every "
          "second point each way; or what is likely to be fastest of first and last (theory.md, \"Statics\")")
          .in({A::Kind::static_}),
      unless(number<A>("tolerance", "-", &A::tolerance, {1e-14, 0.1},
                       "static: residual / load at which a solution is accepted; frequencies: of the eigenpairs; "
                       "dynamic, with lanczos: of "
                       "the motion, rms over the mass, relative to the largest")
                 .standard("static: 1e-06; frequencies: 0.0001; dynamic: 0.0003"),
             A::Method::central_difference),
      number<A>("max_iterations", "-", &A::max_iterations, {1, 1e9}, "limit of iterations of each solution")
          .in(iterative),
      number<A>("modes", "-", &A::modes, {1, 1000}, "number of frequencies, from the lowest")
          .in({A::Kind::frequencies}),
      number<A>("duration", "time", &A::duration, positive, "simulated time").required().in_dynamics(),
      choice<A, A::Start>("start", &A::start, starts,
                          "the plate at time 0: without deformation, or in equilibrium with the loads of that time")
          .in({A::Kind::dynamic}),
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
  if (*kind == Analysis::Kind::frequencies) possible = {lanczos};
  const std::string key = given.below("method");
  if (!given.reading().given(key)) analysis.method = possible.front();
  if (!given.reading().given(given.below("tolerance"))) {
    if (*kind == Analysis::Kind::frequencies) analysis.tolerance = plate::FrequencyOptions{}.tolerance;
    if (*kind == Analysis::Kind::dynamic) analysis.tolerance = plate::LanczosOptions{}.tolerance;
  }
  if (!given.reading().sound(key) || std::find(possible.begin(), possible.end(), analysis.method) != possible.end())
    return;
  std::vector<std::string> names;
  for (const auto method : possible) names.push_back(quoted(methods.name(method)));
  given.reading().complain(key, fmt::format("\"{}\" given, must be {} in {}", methods.name(analysis.method),
                                            fmt::join(names, " or "), analyses({*kind})));
}

Fields<SrifOptions> srif_fields() {
  using S = SrifOptions;
  auto horizons = number<S>("window_horizons", "horizon", &S::window_horizons, positive,
                            "the fit uses points up to this distance from the tip");
  horizons.write = [write = horizons.write](const S& options, Analysis::Kind kind) {
    return options.window ? std::string() : write(options, kind);
  };
  return {
      srif_methods(),
      std::move(horizons),
      number<S>("window", "length", &S::window, positive, "the same as a length, instead of window_horizons"),
      number<S>("skip", "-", &S::skip, {0, 1000000}, "samples next to the tip left out"),
      number<S>("rows", "-", &S::rows, {1, 2},
                "rows of points on each side: 1 nearest row, 2 extrapolated to the crack"),
      boolean("richardson", &S::richardson,
              "statics: also solve with twice the spacing; the difference counts in the estimated error")
          .in({Analysis::Kind::static_}),
      boolean("second_formulation", &S::second_formulation,
              "also run the case in the other formulation, into a folder of its name within the results; the "
              "difference counts in the estimated error"),
      number<S>("accuracy", "-", &S::accuracy, {1e-5, 0.2},
                "find the discretisation by which every factor is known to this share of the largest of K1, K2, K3 "
                "thickness; "
                "spacings and their growth need not be given, and are not used; formulation = galerkin")
          .in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      number<S>("accuracy_seconds", "s", &S::accuracy_seconds, positive,
                "with accuracy: no finer discretisation is begun that would be expected to end later")
          .in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      number<S>("toughness", "stress length^(1/2)", &S::toughness, positive,
                "K_Ic, as K at the faces: how much of it every tip uses"),
      table<S, Normalization>("normalize", Layout::inline_, &S::normalize, normalization_fields(), check_normalization),
      number<S>("half_length", "length", &S::half_length, positive,
                "the a of the normalisation; required with normalize"),
  };
}

void check_srif(const Value& given, SrifOptions& options) {
  auto& reading = given.reading();
  const bool normalize = reading.given(given.below("normalize")), length = reading.given(given.below("half_length"));
  if (normalize && !length)
    reading.complain(given.below("half_length"), "is missing, must be a number > 0 beside normalize");
  if (length && !normalize)
    reading.complain(given.below("half_length"), "'half_length' is used with normalize only: remove it");
  if (options.window && reading.given(given.below("window_horizons")))
    reading.complain(given.below("window_horizons"),
                     "'window_horizons' is given beside 'window', which replaces it: remove one");
}

Fields<Output> output_fields() {
  using O = Output;
  return {
      fields(),
      report(),
      number<O>("every", "time", &O::every, positive, "time between frames; absent: first and last only").in_dynamics(),
      number<O>("history_every", "time", &O::history_every, positive,
                "time between rows of histories, probes and intensity factors")
          .standard("duration / 400")
          .in_dynamics(),
      number<O>("checkpoint_every", "s", &O::checkpoint_every, {0, 86400},
                "time of the clock between checkpoints of a motion by steps or a quasi-static growth, from which "
                "run --resume goes on; 0: none"),
      probes().used_in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
  };
}

}  // namespace cases
