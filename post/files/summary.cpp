#include "post/files/summary.hpp"

#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include "plate/solve/analysis.hpp"
#include "post/files/processes.hpp"
#include "post/files/table.hpp"

namespace post {
namespace {

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

/// Adds the values that are present: names and values by turns.
template <typename Value, typename... Others>
void add(Json& json, const char* name, const std::optional<Value>& value, const Others&... others) {
  if (value) json[name] = *value;
  if constexpr (sizeof...(others) > 0) add(json, others...);
}

Json json_of(const Summary::Analysis& analysis) {
  Json json{{"kind", plate::name_of(analysis.kind)}, {"method", analysis.method}};
  add(json, "preconditioner", analysis.preconditioner, "iterations", analysis.iterations, "steps", analysis.steps,
      "time_step", analysis.time_step, "time_step_limit", analysis.time_step_limit, "residual", analysis.residual,
      "tolerance", analysis.tolerance, "duration", analysis.duration);
  json["stop_reason"] = analysis.stop_reason;
  return json;
}

Json json_of(const Srif& srif) {
  Json json{{"tip", srif.tip}, {"x", srif.position.x()}, {"y", srif.position.y()}, {"method", name_of(srif.method)},
            {"K1", nullptr},   {"K2", nullptr},          {"K3", nullptr}};
  const std::array<const char*, 3> K{"K1", "K2", "K3"}, F{"F1", "F2", "F3"},
      error{"estimated_error_K1", "estimated_error_K2", "estimated_error_K3"};
  const std::array factor{srif.K1, srif.K2, srif.K3};
  const std::array normalized{srif.F1, srif.F2, srif.F3};
  for (std::size_t i = 0; i < 3; ++i)
    if (srif.resolved[i]) json[K[i]] = factor[i];
  for (std::size_t i = 0; i < 3; ++i)
    if (srif.resolved[i]) add(json, F[i], normalized[i]);
  add(json, "estimated_error", srif.estimated_error);
  for (std::size_t i = 0; i < 3; ++i) add(json, error[i], srif.errors[i]);
  add(json, "accuracy_reached", srif.accuracy_reached, "G", srif.G);
  if (const auto& membrane = srif.membrane) {
    for (std::size_t i = 0; i < 2; ++i) {
      json[i == 0 ? "N1" : "N2"] = membrane->resolved[i] ? Json(membrane->N[i]) : Json();
      add(json, i == 0 ? "estimated_error_N1" : "estimated_error_N2", membrane->errors[i]);
    }
    add(json, "G_in_plane", membrane->G);
  }
  if (const auto where = overlap(srif); where != Overlap::unknown) json["overlaps_at"] = name_of(where);
  if (const auto& second = srif.second)
    json["second_formulation"] = {{"formulation", second->formulation},
                                  {"method", name_of(second->method)},
                                  {"K1", second->K1},
                                  {"K2", second->K2},
                                  {"K3", second->K3},
                                  {"difference", second->difference}};
  if (srif.second && srif.second->in_plane) {
    const auto& [N, difference] = *srif.second->in_plane;
    auto& entry = json["second_formulation"];
    entry["N1"] = N[0], entry["N2"] = N[1], entry["difference_in_plane"] = difference;
  }
  for (const auto& f : srif.fits)
    json["fits"].push_back({{"inner", f.inner}, {"outer", f.outer}, {"K1", f.K1}, {"K2", f.K2}, {"K3", f.K3}});
  if (srif.rings.empty()) {
    json["fit_residual"] = srif.fit_residual;
    json["samples"] = srif.samples;
    return json;
  }
  for (const auto& r : srif.rings)
    json["rings"].push_back(
        {{"inner", r.inner}, {"outer", r.outer}, {"G", r.G}, {"K1", r.K1}, {"K2", r.K2}, {"K3", r.K3}});
  return json;
}

Json json_of(const FaceFactors& faces) {
  constexpr std::array names{"K_I", "K_II", "K_III"};
  Json json;
  for (std::size_t i = 0; i < 3; ++i) json[names[i]] = faces.K[i] ? Json(*faces.K[i]) : Json();
  if (faces.below) {
    const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    json["KI_top"] = number(faces.K[0]), json["KI_bottom"] = number((*faces.below)[0]);
    json["KII_top"] = number(faces.K[1]), json["KII_bottom"] = number((*faces.below)[1]);
    json["KIII"] = number(faces.K[2]);
  }
  json["K_eq"] = faces.equivalent ? Json(*faces.equivalent) : Json();
  add(json, "K_eq_height", faces.height, "estimated_error_K_eq", faces.error, "utilisation", faces.utilisation,
      "estimated_error_utilisation", faces.utilisation_error, "overlap", faces.overlap);
  return json;
}

Json json_of(const FaceOverlaps& one) {
  Json json{{"tip", one.tip}, {"rows", one.rows}, {"rows_above", one.above}};
  add(json, "first_above", one.first_above, "first_change", one.first_change, "least_K1", one.least);
  return json;
}

/// `moves`: at a time.
Json json_of(const Peak& peak, bool moves) {
  Json json{{"quantity", peak.quantity}};
  add(json, "tip", peak.tip);
  json["value"] = peak.value;
  if (peak.position) json["x"] = peak.position->x(), json["y"] = peak.position->y();
  add(json, "outside", peak.outside);
  if (moves) json["time"] = peak.time;
  add(json, "estimated_error", peak.error);
  return json;
}

Json json_of(const StressAtDistance& one) {
  Json json{{"place", one.place},     {"x", one.singular.x()},    {"y", one.singular.y()},   {"distance", one.distance},
            {"von_mises", one.value}, {"at_x", one.position.x()}, {"at_y", one.position.y()}};
  add(json, "estimated_error", one.error);
  return json;
}

Json json_of(const ProbeValue& one) {
  Json json{{"probe", one.probe},
            {"x", one.position.x()},
            {"y", one.position.y()},
            {"quantity", one.quantity},
            {"value", one.value}};
  add(json, "estimated_error", one.error);
  return json;
}

Json json_of(const Wrench& wrench) {
  return {{"force", wrench.force}, {"moment_x", wrench.moment_x}, {"moment_y", wrench.moment_y}};
}

/// `rows`: there may be more than one.
Json json_of(const ReactionSummary& reactions, bool rows) {
  Json json;
  if (rows) json["time"] = reactions.time;
  json["supports"] = Json::array();
  for (std::size_t i = 0; i < reactions.supports.size(); ++i) {
    const auto& [name, position] = reactions.supports[i];
    Json one{{"support", name}};
    if (position) one["x"] = position->x(), one["y"] = position->y();
    one.update(json_of(reactions.supports[i].written(reactions.balance.supports[i])));
    if (rows)
      one["largest_force"] = reactions.largest[i].force, one["time_of_largest_force"] = reactions.largest[i].time;
    if (!reactions.errors.empty()) {
      const auto& error = reactions.errors[i];
      one["estimated_error"] = error.force;
      one["estimated_error_moment_x"] = error.moment_x, one["estimated_error_moment_y"] = error.moment_y;
    }
    json["supports"].push_back(std::move(one));
  }
  json["sum"] = json_of(reactions.balance.sum());
  json["loads"] = json_of(reactions.balance.loads);
  if (const auto& inertia = reactions.balance.inertia) json["inertia"] = json_of(*inertia);
  json["residual"] = reactions.balance.residual;
  if (rows) json["largest_residual"] = reactions.largest_residual;
  if (reactions.truncation) json["truncation"] = *reactions.truncation;
  for (const auto& [edge, quantity, value, s, x, error] : reactions.edges) {
    Json one{{"support", edge}, {"quantity", quantity}, {"value", value}, {"s", s}, {"x", x.x()}, {"y", x.y()}};
    add(one, "estimated_error", error);
    json["edge_reactions"].push_back(std::move(one));
  }
  for (const auto& [corner, x, force, error] : reactions.corners) {
    Json one{{"corner", corner}, {"x", x.x()}, {"y", x.y()}, {"force", force}};
    add(one, "estimated_error", error);
    json["corner_forces"].push_back(std::move(one));
  }
  return json;
}

Json json_of(const Frequency& frequency) {
  Json json{{"mode", frequency.mode},
            {"frequency", frequency.frequency},
            {"omega", frequency.omega},
            {"residual", frequency.residual}};
  add(json, "share_in_plane", frequency.share_in_plane, "estimated_error", frequency.error);
  return json;
}

Json json_of(const GrowthSummary& growth) {
  Json json{{"outcome", growth.outcome}, {"resolved", growth.resolved}, {"advances", growth.advances}};
  add(json, "first_load_factor", growth.first_load_factor, "first_load_factor_error", growth.first_load_factor_error,
      "largest_load_factor", growth.largest_load_factor, "spent", growth.spent, "largest_speed", growth.largest_speed,
      "broken_bonds", growth.broken_bonds);
  json["lengths"] = growth.lengths;
  return json;
}

Json json_of(const BucklingFactor& one) {
  Json json{{"mode", one.mode}, {"factor", one.factor}, {"residual", one.residual}};
  add(json, "estimated_error", one.error);
  return json;
}

/// A list of the rows, by the names of the columns.
Json json_of(const Table& table) {
  Json list = Json::array();
  for (const auto& row : table.rows) {
    Json one;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto* number = std::get_if<double>(&row[i]);
      const auto* word = std::get_if<std::string>(&row[i]);
      one[table.columns[i]] = number ? Json(*number) : word ? Json(*word) : Json();
    }
    list.push_back(std::move(one));
  }
  return list;
}

Json json_of(const MembraneSummary& membrane) {
  Json json{{"strain_energy", membrane.strain_energy},
            {"external_work", membrane.external_work},
            {"residual", membrane.residual},
            {"largest_displacement", membrane.largest_displacement}};
  add(json, "estimated_error_largest_displacement", membrane.error);
  json["reactions"] = Json::array();
  for (const auto& [name, force, error] : membrane.reactions) {
    json["reactions"].push_back({{"name", name}, {"force_x", force.x()}, {"force_y", force.y()}});
    add(json["reactions"].back(), "estimated_error", error);
  }
  return json;
}

Json json_of(const AccuracyStep& one) {
  Json json{{"points", one.points}, {"spacing", one.spacing}, {"tip_spacing", one.tip_spacing}};
  add(json, "hole_spacing", one.hole_spacing);
  json["spacing_growth"] = one.spacing_growth;
  json["seconds"] = one.seconds;
  add(json, "estimated_error", one.error);
  return json;
}

Json json_of(const TargetsSummary::Target& one) {
  Json json{{"of", one.of}, {"asked", one.asked}};
  add(json, "accuracy_reached", one.reached);
  return json;
}

Json json_of(const ScenePart& part) {
  return {{"name", part.name}, {"bytes_per_point", part.bytes_per_point}, {"time_share", part.time_share}};
}

Json json_of(const std::vector<std::pair<std::string, double>>& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = value;
  return json;
}

template <typename Element>
Json list_of(const std::vector<Element>& elements) {
  Json json = Json::array();
  for (const Element& element : elements) json.push_back(json_of(element));
  return json;
}

Json json_of(const std::vector<Peak>& peaks, bool moves) {
  Json json = Json::array();
  for (const auto& peak : peaks) json.push_back(json_of(peak, moves));
  return json;
}

/// The factors, each with what it is at the faces.
Json json_of(const std::vector<Srif>& srifs, const std::vector<FaceFactors>& faces) {
  Json json = list_of(srifs);
  for (std::size_t i = 0; i < std::min(srifs.size(), faces.size()); ++i) json[i]["faces"] = json_of(faces[i]);
  return json;
}

Json json_of(const Spread& one) {
  return {{"least", one.least}, {"mean", one.mean}, {"largest", one.largest}};
}

Json json_of(const ProcessesSummary& all) {
  Json json{{"count", all.count}, {"threads", all.threads}};
  json["points"] = json_of(all.points), json["peak_memory_bytes"] = json_of(all.memory);
  for (const auto& [stage, seconds] : all.seconds) json["seconds"][stage] = json_of(seconds);
  json["waiting"] = json_of(all.waiting);
  json[all.steps ? "per_step" : "in_all"] = {
      {"messages", json_of(all.messages)}, {"bytes", json_of(all.bytes)}, {"sums", json_of(all.sums)}};
  return json;
}

Json json_of(const AccuracySummary& accuracy) {
  Json json{{"asked", accuracy.asked}};
  add(json, "reached", accuracy.reached);
  json["outcome"] = accuracy.outcome();
  json["path"] = list_of(accuracy.path);
  return json;
}

Json json_of(const TargetsSummary& all) {
  Json json{{"outcome", all.outcome()}, {"results", list_of(all.targets)}};
  for (const auto& step : all.path) {
    Json one{{"points", step.points}, {"spacing", step.spacing}};
    add(one, "tip_spacing", step.tip_spacing, "hole_spacing", step.hole_spacing);
    one["seconds"] = step.seconds;
    for (const auto& target : step.targets) add(one, ("error_of_" + target.of).c_str(), target.reached);
    json["path"].push_back(one);
  }
  return json;
}

Json json_of(const ContactSummary& contact) {
  return {{"least_opening", contact.least_opening},
          {"largest_pressure", contact.largest_pressure},
          {"closed_share", contact.closed_share}};
}

Json json_of(const plate::LiftedSupports& lifted) {
  return {{"share", lifted.share}, {"largest_gap", lifted.largest_gap}};
}

/// Integrals along lines.
Json sums_json(const std::vector<ProbeValue>& sums) {
  Json json = Json::array();
  for (const auto& one : sums) {
    json.push_back({{"line", one.probe}, {"quantity", one.quantity}, {"value", one.value}});
    add(json.back(), "estimated_error", one.error);
  }
  return json;
}

/// Stresses near singular places, of those that the points resolve.
void add_stress_near(Json& json, const std::vector<StressAtDistance>& all) {
  for (const auto& one : all)
    if (one.resolved) json["stress_near"].push_back(json_of(one));
}

Json json_of(const LoadCaseSummary& one) {
  Json json{{"name", one.name}};
  if (!one.of.empty()) json["of"] = json_of(one.of);
  if (!one.of.empty() && !one.superposed()) json["superposed"] = false;
  add(json, "iterations", one.iterations, "residual", one.residual);
  json["srif"] = json_of(one.srif, one.faces);
  json["extremes"] = json_of(one.extremes, false);
  add_stress_near(json, one.stress_near);
  if (!one.probes.empty()) json["probes"] = list_of(one.probes);
  if (!one.lines.empty()) json["lines"] = sums_json(one.lines);
  if (one.reactions) json["reactions"] = json_of(*one.reactions, false);
  auto& energy = json["energy"] = {{"strain", one.strain_energy}};
  for (const auto& [name, value] : one.energy_parts) energy[name] = value;
  energy["external_work"] = one.external_work;
  add(json, "estimated_error_energy", one.energy_error);
  if (one.membrane) json["membrane"] = json_of(*one.membrane);
  if (one.contact) json["contact"] = json_of(*one.contact);
  if (one.lifted) json["lifted"] = json_of(*one.lifted);
  return json;
}

Json json_of(const EnvelopeEntry& one) {
  Json json{{"tip", one.tip},           {"x", one.position.x()}, {"y", one.position.y()},
            {"quantity", one.quantity}, {"value", one.value},    {"case", one.of}};
  add(json, "estimated_error", one.error);
  return json;
}

Json json_of(const ResponsePeak& one) {
  Json json{
      {"place", one.place}, {"quantity", one.quantity}, {"amplitude", one.amplitude}, {"frequency", one.frequency}};
  add(json, "estimated_error", one.error);
  return json;
}

}  // namespace

Wrench& Wrench::operator+=(const Wrench& other) {
  force += other.force, moment_x += other.moment_x, moment_y += other.moment_y;
  return *this;
}

Wrench ReactionSummary::Support::written(Wrench wrench) const {
  const bool hub = position && (name.starts_with("hub") || name.starts_with("hole"));  // edges have no position
  if (hub) wrench.moment_x -= position->y() * wrench.force, wrench.moment_y += position->x() * wrench.force;
  return wrench;
}

Wrench Balance::sum() const {
  Wrench result;
  for (const auto& one : supports) result += one;
  return result;
}

std::string to_json(const Summary& summary) {
  Json json;
  json["title"] = summary.title;
  json["units"] = summary.units;
  json["outcome"] = summary.outcome;
  json["formulation"] = summary.formulation;
  json["formulation_reason"] = summary.formulation_reason;
  if (!summary.recipe.empty()) json["recipe"] = summary.recipe;
  json["points"] = summary.points;
  json["bonds"] = summary.bonds;
  json["fictitious_points"] = summary.fictitious_points;
  json["fictitious_bonds"] = summary.fictitious_bonds;
  json["spacing"] = summary.spacing;
  json["horizon"] = summary.horizon;
  if (const auto& matched = summary.position_aware)
    json["position_aware"] = {
        {"exact", matched->exact}, {"blended", matched->blended}, {"arbitrary_horizon", matched->arbitrary_horizon}};
  json["analysis"] = json_of(summary.analysis);
  json["seconds"] = json_of(summary.seconds);
  json["peak_memory_bytes"] = summary.peak_memory_bytes;
  if (summary.processes) json["processes"] = json_of(*summary.processes);
  json["srif"] = json_of(summary.srif, summary.faces);
  add(json, "toughness", summary.toughness);
  if (!summary.overlaps.empty()) json["overlaps"] = list_of(summary.overlaps);
  if (!summary.peaks.empty()) json["peaks"] = json_of(summary.peaks, true);
  if (!summary.extremes.empty()) json["extremes"] = json_of(summary.extremes, false);
  add_stress_near(json, summary.stress_near);
  if (!summary.probes.empty()) json["probes"] = list_of(summary.probes);
  if (!summary.lines.empty()) json["lines"] = sums_json(summary.lines);
  if (const auto& reactions = summary.reactions)
    json["reactions"] = json_of(*reactions, summary.growth || summary.analysis.kind == plate::Analysis::Kind::dynamic);
  for (const auto& one : summary.load_cases) json["load_cases"].push_back(json_of(one));
  for (const auto& one : summary.envelope) json["envelope"].push_back(json_of(one));
  if (summary.deflection_over_thickness)
    json["sanity"] = {{"deflection_over_thickness", *summary.deflection_over_thickness}};
  if (summary.linear_theory_off) json["sanity"]["linear_theory_off"] = *summary.linear_theory_off;
  if (summary.touching) json["touching"] = *summary.touching;
  if (summary.lifted) json["lifted"] = json_of(*summary.lifted);
  if (summary.multipliers) json["multipliers"] = *summary.multipliers;
  if (summary.accuracy) json["accuracy"] = json_of(*summary.accuracy);
  if (summary.targets) json["targets"] = json_of(*summary.targets);
  if (summary.analysis.kind == plate::Analysis::Kind::frequencies) json["frequencies"] = list_of(summary.frequencies);
  if (summary.analysis.kind == plate::Analysis::Kind::buckling) json["buckling"] = list_of(summary.buckling);
  if (summary.contact) json["contact"] = json_of(*summary.contact);
  if (!summary.load_steps.rows.empty()) json["load_steps"] = json_of(summary.load_steps);
  for (const auto& one : summary.response) json["response"].push_back(json_of(one));
  if (!summary.resonances.empty()) json["resonances"] = summary.resonances;
  if (summary.membrane) json["membrane"] = json_of(*summary.membrane);
  if (summary.growth) json["growth"] = json_of(*summary.growth);
  json["energy"] = json_of(summary.energy);
  add(json, "estimated_error_energy", summary.energy_error);
  json["scene"] = list_of(summary.scene);
  json["warnings"] = summary.warnings;
  json["version"] = summary.version;
  json["digest"] = summary.digest;
  // a title that is not UTF-8 is no reason to lose the results: its odd bytes are replaced
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace post
