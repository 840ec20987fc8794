#include "cases/input/case_file.hpp"
#include "cases/input/keys.hpp"
#include "post/factors/srif.hpp"

namespace cases {
namespace {

using post::Normalization;
using post::SrifOptions;

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

Field<SrifOptions> srif_methods() {
  using enum post::SrifMethod;
  static const auto words = [] {
    Words<post::SrifMethod> result;
    for (const auto method :
         {virtual_crack_extension, domain_integral, displacement_extrapolation, opening_series, series_fit})
      result.allowed.emplace_back(name_of(method), method);
    return result;
  }();
  return value<SrifOptions>(
      {"methods", "-", "a list of " + words.text(), "", "how the intensity factors are found"},
      [](const Value& given, SrifOptions& options) {
        auto found = chosen(given, words);
        if (!found.empty())
          options.methods = std::move(found);
        else if (given.reading().sound(given.key()))
          given.refuse("a list of at least one of " + words.text());
      },
      [](const SrifOptions& options) {
        std::vector<std::string> names;
        for (const auto method : options.methods) names.push_back(name_of(method));
        return text_of(names);
      });
}

}  // namespace

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
      boolean<S>("richardson", &S::richardson,
                 "statics: also solve with twice the spacing; the difference counts in the estimated error")
          .in({Analysis::Kind::static_}),
      boolean<S>("second_formulation", &S::second_formulation,
                 "also run the case in the other formulation, into a folder of its name within the results; the "
                 "difference counts in the estimated error")
          .used_in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      number<S>("accuracy", "-", &S::accuracy, {1e-5, 0.2},
                "find the discretisation by which every factor is known to this share of the largest of K1, K2, K3 "
                "thickness, in the plane of N1, N2; spacings and their growth need not be given, and are not used; "
                "formulation = galerkin")
          .in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      number<S>("accuracy_seconds", "s", &S::accuracy_seconds, positive,
                "with accuracy: no finer discretisation is begun that would be expected to end later")
          .in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      number<S>("toughness", "stress length^(1/2)", &S::toughness, positive,
                "K_Ic, as K at the faces: how much of it every tip uses")
          .used_in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      table<S, Normalization>("normalize", Layout::inline_, &S::normalize, normalization_fields(), check_normalization)
          .used_in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      number<S>("half_length", "length", &S::half_length, positive,
                "the a of the normalisation; required with normalize"),
  };
}

void check_srif(const Value& given, SrifOptions& options) {
  auto& reading = given.reading();
  const bool normalize = reading.given(given.below("normalize")), length = reading.given(given.below("half_length"));
  if (normalize && !length)
    reading.report_error(given.below("half_length"), "is missing, must be a number > 0 beside normalize");
  if (length && !normalize)
    reading.report_error(given.below("half_length"), "'half_length' is used with normalize only: remove it");
  if (options.window && reading.given(given.below("window_horizons")))
    reading.report_error(given.below("window_horizons"),
                         "'window_horizons' is given beside 'window', which replaces it: remove one");
}

namespace {

Field<Output> report() {
  return value<Output>(
             {"report", "-", "true or false", "", "report.html, a page of results to look at and to hand on"},
             [](const Value& given, Output& output) { output.report = given.boolean(); },
             [](const Output& output) { return std::string(output.reports() ? "true" : "false"); })
      .standard("true where fields are written");
}

Field<Output> fields() {
  static const Words<bool Output::*> words{{{"vtk", &Output::vtk}, {"hdf5", &Output::hdf5}}};
  return value<Output>(
      {"fields", "-", "a list of " + words.text(), "", "files of fields: for ParaView, for HDF5"},
      [](const Value& given, Output& output) {
        output.vtk = output.hdf5 = false;
        for (const auto member : chosen(given, words)) output.*member = true;
      },
      [](const Output& output) {
        std::vector<std::string> names;
        for (const auto& [name, member] : words.allowed)
          if (output.*member) names.push_back(name);
        return text_of(names);
      });
}

Field<Output> probes() {
  return value<Output>(
      {"probes", "length", "{ name = [x, y], ... } in the plate", "", "points whose w and rotations are recorded"},
      [](const Value& given, Output& output) {
        const auto* entries = given.table();
        if (!entries) return;
        for (const auto& [name, node] : *entries) {
          const Value probe(node, given.below(std::string(name.str())), given.reading());
          if (!bare(std::string(name.str())))
            probe.report_error("the name of a probe has letters, digits, _ and - only");
          if (const auto point = probe.point()) output.probes[std::string(name.str())] = *point;
        }
      },
      [](const Output& output) {
        std::vector<std::string> texts;
        for (const auto& [name, point] : output.probes) texts.push_back(name + " = " + text_of(point));
        return texts.empty() ? "" : fmt::format("{{ {} }}", fmt::join(texts, ", "));
      });
}

Field<Output> lines() {
  return value<Output>(
      {"lines", "length", "{ name = [[x, y], [x, y]], ... }", "",
       "straight lines, from one point to the other, along which displacements, moments and forces are recorded and "
       "summed up"},
      [](const Value& given, Output& output) {
        const auto* entries = given.table();
        if (!entries) return;
        for (const auto& [name, node] : *entries) {
          const Value line(node, given.below(std::string(name.str())), given.reading());
          if (!bare(std::string(name.str()))) line.report_error("the name of a line has letters, digits, _ and - only");
          const auto ends = line.points();
          if (!ends) continue;
          if (ends->size() != 2 || (*ends)[0] == (*ends)[1])
            line.report_error("must be two points, [[x, y], [x, y]]");
          else
            output.lines[std::string(name.str())] = {(*ends)[0], (*ends)[1]};
        }
      },
      [](const Output& output) {
        std::vector<std::string> texts;
        for (const auto& [name, ends] : output.lines)
          texts.push_back(fmt::format("{} = [{}, {}]", name, text_of(ends[0]), text_of(ends[1])));
        return texts.empty() ? "" : fmt::format("{{ {} }}", fmt::join(texts, ", "));
      });
}

}  // namespace

Fields<AccuracyTargets> accuracy_fields() {
  using A = AccuracyTargets;
  constexpr Bounds shares{1e-4, 0.5};
  const Kinds at_rest{Analysis::Kind::static_};
  return {
      number<A>("deflection", "-", &A::deflection, shares,
                "find the discretisation by which the error of the largest deflection is no larger than this share of "
                "it; spacings and their growth need not be given, and are not used")
          .in(at_rest),
      number<A>("stress", "-", &A::stress, shares,
                "the same of the largest von Mises stress, output.stress_distance or farther from singular places")
          .in(at_rest),
      number<A>("reactions", "-", &A::reactions, shares,
                "the same of the forces of supports, as a share of the largest")
          .in(at_rest),
      number<A>("frequencies", "-", &A::frequencies, shares, "the same of every frequency")
          .in({Analysis::Kind::frequencies}),
      number<A>("seconds", "s", &A::seconds, positive,
                "no finer discretisation is begun that would be expected to end later"),
  };
}

void check_accuracy(const Value& given, AccuracyTargets& targets) {
  if (!given.reading().sound(given.key())) return;
  if (!targets.deflection && !targets.stress && !targets.reactions && !targets.frequencies)
    given.report_error("names no result: give deflection, stress or reactions at rest, or frequencies");
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
                "run --resume goes on; longer where they would take more than 1 % of the run; 0: none"),
      boolean<O>("errors", &O::errors,
                 "estimate the errors of deflections, stresses, reactions and frequencies from a second run with other "
                 "points, which takes about a tenth of the time of the first; of bonds, 0.4 to 0.8 of it")
          .used_in({Analysis::Kind::static_, Analysis::Kind::frequencies}),
      probes().used_in({Analysis::Kind::static_, Analysis::Kind::dynamic, Analysis::Kind::harmonic}),
      lines().in({Analysis::Kind::static_}),
      number<O>("edge_reactions", "-", &O::edge_reactions, {1, 1000},
                "pieces of every held edge along which its force, moment and twist per length are recorded, with the "
                "forces at corners")
          .in({Analysis::Kind::static_}),
      number<O>("stress_distance", "length", &O::stress_distance, positive,
                "distance from tips, sharp corners, pins and point forces at which the stress there is stated; given, "
                "the largest stress leaves out what is nearer")
          .standard("the thickness")
          .in({Analysis::Kind::static_}),
  };
}

}  // namespace cases
