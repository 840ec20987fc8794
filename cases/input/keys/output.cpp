#include "cases/input/case.hpp"
#include "cases/input/keys.hpp"

namespace cases {
namespace {

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
      probes().used_in({Analysis::Kind::static_, Analysis::Kind::dynamic, Analysis::Kind::harmonic}),
  };
}

}  // namespace cases
