#include "post/report/printed.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>

#include "post/files/processes.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/response.hpp"

namespace post {
namespace {

constexpr double nothing = 1e-6, rounding = 1e-8;  // of the largest factor of a tip

using Text = std::back_insert_iterator<std::string>;

/// The first of the texts, `most` of them; where there are more, how many there are in all.
std::string shortened(std::vector<std::string> texts, std::size_t most) {
  const auto all = texts.size();
  if (all > most) texts.resize(most), texts.push_back(fmt::format("... ({} in all)", all));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// `of`: empty, or the load case.
void contact(Text out, const ContactSummary& contact, const std::string& of, bool si) {
  fmt::format_to(out, "faces of cracks touch along {:.1f} % of their length, pressed by {:.4g}{} at most{}\n",
                 100 * contact.closed_share, contact.largest_pressure, si ? " N/m" : "", of);
}

/// `of`: empty, or the load case.
void lifted(Text out, const plate::LiftedSupports& lifted, const std::string& of, bool si) {
  fmt::format_to(out, "off its supports: {:.1f} % of the points that only push{}; largest gap {:.4g}{}\n",
                 100 * lifted.share, of, lifted.largest_gap, si ? " m" : "");
}

void growth(Text out, const GrowthSummary& growth) {
  constexpr std::size_t most = 8;
  std::vector<std::string> lengths;
  for (const double length : growth.lengths) lengths.push_back(fmt::format("{:.4g}", length));
  fmt::format_to(out, "growth: {}; lengths of the cracks: {}", growth.outcome,
                 lengths.empty() ? "none" : shortened(std::move(lengths), most));
  if (growth.first_load_factor && *growth.first_load_factor > 0)
    fmt::format_to(out, "; load factor {:.5g}{} at the first advance, {:.5g} at most", *growth.first_load_factor,
                   growth.first_load_factor_error ? fmt::format(" +- {:.2g}", *growth.first_load_factor_error) : "",
                   *growth.largest_load_factor);
  if (growth.spent) fmt::format_to(out, "; energy spent {:.3f} of the fracture energy", *growth.spent);
  if (growth.largest_speed) fmt::format_to(out, "; largest speed {:.4g}", *growth.largest_speed);
  fmt::format_to(out, "\n");
}

/// The largest estimated error of the factors that are resolved, relative to the largest of them; where no errors of
/// single factors are known, that of all.
std::optional<double> error_of(const Srif& srif, double thickness) {
  const std::array values{srif.K1, srif.K2, srif.K3 * thickness};
  double largest = 0, error = 0;
  bool known = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!srif.resolved[i]) continue;
    largest = std::max(largest, std::abs(values[i]));
    if (!srif.errors[i]) continue;
    error = std::max(error, *srif.errors[i] * (i == 2 ? thickness : 1)), known = true;
  }
  return known && largest > 0 ? error / largest : srif.estimated_error;
}

std::string in_percent(const std::optional<double>& error) {
  if (!error) return "";
  return *error >= 1 ? "> 100 %" : fmt::format("{:.2g} %", 100 * *error);
}

/// K1, K2, K3 as they are printed.
std::array<std::string, 3> factor_texts(const Srif& srif, double thickness) {
  const std::array values{srif.K1, srif.K2, srif.K3};
  const double largest = largest_factor(srif, thickness);
  std::array<std::string, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double size = std::abs(values[i]), moment = i == 2 ? size * thickness : size;
    // refined points leave a small part of its error of a factor that is zero
    constexpr double left = 0.05, well_known = 0.03;  // of its estimated error; of the largest factor
    const double error = srif.errors[i].value_or(INFINITY), scale = i == 2 ? thickness : 1;
    const bool zero = moment < rounding * largest || (moment < nothing * largest && size <= error) ||
                      (size <= left * error && error * scale < well_known * largest);
    result[i] = !srif.resolved[i] ? "-" : zero ? "0" : fmt::format("{:.6g}", values[i]);
  }
  return result;
}

/// A place; what is nothing beside the thickness is 0.
std::string place_text(const geometry::Point& x, double thickness) {
  const auto text = [&](double at) { return std::abs(at) < nothing * thickness ? 0 : at; };
  return fmt::format("({:.4g}, {:.4g})", text(x.x()), text(x.y()));
}

void row(Text out, const Srif& srif, bool normalized, double thickness) {
  constexpr double rough = 0.1;
  fmt::format_to(out, "{:>4} {:>9.4g} {:>9.4g}", srif.tip, srif.position.x(), srif.position.y());
  const auto K = factor_texts(srif, thickness);
  for (const auto& text : K) fmt::format_to(out, " {:>13}", text);
  const std::array F{srif.F1, srif.F2, srif.F3};
  for (std::size_t i = 0; i < 3 && normalized; ++i)
    fmt::format_to(out, " {:>9}", K[i] == "-" ? "-" : fmt::format("{:.5f}", K[i] == "0" ? 0 : F[i].value_or(0)));
  const auto error = error_of(srif, thickness);
  fmt::format_to(out, " {:>8}  {}{}\n", in_percent(error), name_of(srif.method),
                 error && *error >= rough ? "   (rough)" : "");
}

void factors(Text out, const std::vector<Srif>& srifs, bool si, double thickness) {
  const bool normalized = srifs.front().F1.has_value();
  fmt::format_to(out, "{:>4} {:>9} {:>9} {:>13} {:>13} {:>13}{} {:>8}  method\n", "tip", "x", "y", "K1", "K2", "K3",
                 normalized ? fmt::format(" {:>9} {:>9} {:>9}", "F1", "F2", "F3") : "", "error");
  if (si)
    fmt::format_to(out, "{:>4} {:>9} {:>9} {:>13} {:>13} {:>13}\n", "", "[m]", "[m]", "[N m^1/2]", "[N m^1/2]",
                   "[N m^-1/2]");
  const auto best = recommended(srifs);
  for (const auto* one : best) row(out, *one, normalized, thickness);
  if (best.size() < srifs.size()) fmt::format_to(out, "for comparison, by other methods:\n");
  for (const auto& one : srifs)
    if (std::ranges::find(best, &one) == best.end()) row(out, one, normalized, thickness);
  for (const auto* one : best)
    if (const auto& second = one->second)
      fmt::format_to(out, "tip {}: {} by {} gives K1 {:.6g}, K2 {:.6g}, K3 {:.6g}: {:.2f} % apart\n", one->tip,
                     second->formulation, name_of(second->method), second->K1, second->K2, second->K3,
                     100 * second->difference);
}

/// Factors in the plane as they are printed: "tip N1 N2 error".
std::string in_plane_text(const Srif& srif) {
  const auto& [N, errors, resolved, G, thickness] = *srif.membrane;
  const double size = std::max(std::abs(N[0]), std::abs(N[1]));
  const auto text = [&](std::size_t i) {
    return !resolved[i] ? "-" : std::abs(N[i]) < nothing * size ? "0" : fmt::format("{:.6g}", N[i]);
  };
  const double error = std::max(errors[0].value_or(0), errors[1].value_or(0));
  return fmt::format("{:>4} {:>13} {:>13} {:>8}\n", srif.tip, text(0), text(1),
                     size > 0 && errors[0] ? in_percent(error / size) : "");
}

/// The factors of loads in the plane, of recommended methods.
void in_plane(Text out, const std::vector<Srif>& srifs, bool si) {
  bool first = true;
  for (const auto* one : recommended(srifs)) {
    if (!one->membrane) continue;
    if (std::exchange(first, false))
      fmt::format_to(out, "in the plane{}:\n{:>4} {:>13} {:>13} {:>8}\n", si ? " [N m^-1/2]" : "", "tip", "N1", "N2",
                     "error");
    fmt::format_to(out, "{}", in_plane_text(*one));
    if (one->second && one->second->in_plane)
      fmt::format_to(out, "tip {}: {} gives N1 {:.6g}, N2 {:.6g}: {:.2f} % apart\n", one->tip, one->second->formulation,
                     one->second->in_plane->N[0], one->second->in_plane->N[1], 100 * one->second->in_plane->difference);
  }
}

/// Where the equivalent factor acts: a face, the middle plane, or z over the thickness h.
std::string height_text(const FaceFactors& one) {
  if (!one.height) return "-";
  if (*one.height == 0) return "middle";
  return std::abs(*one.height) == 0.5 ? (*one.height > 0 ? "z>0" : "z<0") : fmt::format("{:+.2f} h", *one.height);
}

/// The factors at the faces, of recommended methods.
void faces(Text out, const Summary& summary, bool si) {
  const bool both = std::ranges::any_of(summary.faces, [](const FaceFactors& one) { return one.below.has_value(); });
  fmt::format_to(out, "at the faces, K_III in the middle plane{}:\n{:>4} {:>13} {:>13}{} {:>13} {:>13} {:>7}{}\n",
                 si ? " [Pa m^1/2]" : "", "tip", both ? "K_I, z>0" : "K_I", both ? "K_II, z>0" : "K_II",
                 both ? fmt::format(" {:>13} {:>13}", "K_I, z<0", "K_II, z<0") : "", "K_III", "K_eq", "at",
                 summary.toughness ? " of toughness" : "");
  for (std::size_t i = 0; i < summary.faces.size(); ++i) {
    const auto tip = summary.srif[i].tip;
    if (i > 0 && summary.srif[i - 1].tip == tip) continue;
    const auto& one = summary.faces[i];
    const auto text = [&](const std::optional<double>& value) {
      if (!value) return std::string("-");
      return std::abs(*value) < nothing * one.equivalent.value_or(0) ? "0" : fmt::format("{:.5g}", *value);
    };
    const auto below = one.below.value_or(std::array<std::optional<double>, 2>{});
    fmt::format_to(out, "{:>4} {:>13} {:>13}{} {:>13} {:>13} {:>7}", tip, text(one.K[0]), text(one.K[1]),
                   both ? fmt::format(" {:>13} {:>13}", text(below[0]), text(below[1])) : "", text(one.K[2]),
                   text(one.equivalent), height_text(one));
    if (one.utilisation)
      fmt::format_to(out, " {:>8.3g}{}", *one.utilisation,
                     one.utilisation_error ? fmt::format(" +- {:.2g}", *one.utilisation_error) : "");
    fmt::format_to(out, "\n");
  }
}

/// `of`: the unit and the load case. Beside `size` [force] what is nothing is 0.
void reactions(Text out, const ReactionSummary& reactions, const std::string& of, double size, std::size_t most) {
  const auto& supports = reactions.supports;
  const auto& balance = reactions.balance;
  const auto force = [&](const Wrench& wrench) {
    return std::abs(wrench.force) < nothing * size ? "0" : fmt::format("{:.5g}", wrench.force);
  };
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < supports.size(); ++i)
    texts.push_back(fmt::format("{} {}", supports[i].name, force(balance.supports[i])));
  fmt::format_to(out, "reactions along w{}: {}; loads {}{}; balanced to {:.1e}\n", of,
                 shortened(std::move(texts), most), force(balance.loads),
                 balance.inertia ? fmt::format(", inertia {}", force(*balance.inertia)) : "", balance.residual);
}

/// The plate in its plane at rest. `of`: empty, or the load case.
void displaced(Text out, const MembraneSummary& membrane, const std::string& of, bool si, std::size_t most) {
  double size = 0;
  for (const auto& one : membrane.reactions) size = std::max(size, one.force.norm());
  const auto force = [&](double value) {
    return std::abs(value) < nothing * size ? "0" : fmt::format("{:.5g}", value);
  };
  std::vector<std::string> texts;
  for (const auto& one : membrane.reactions)
    texts.push_back(fmt::format("{} ({}, {})", one.name, force(one.force.x()), force(one.force.y())));
  fmt::format_to(out, "reactions in the plane{}{}: {}; largest displacement there {:.5g}{}\n", si ? " [N]" : "", of,
                 texts.empty() ? "none" : shortened(std::move(texts), most), membrane.largest_displacement,
                 si ? " m" : "");
}

/// Prints the peaks, in motion with their times, in statics without.
void peaks(Text out, const std::vector<Peak>& all, bool moves, double thickness) {
  const auto moment = [&](const Peak& peak) { return std::abs(peak.value) * (peak.quantity == "K3" ? thickness : 1); };
  const auto noise = [&](const Peak& peak) {
    return peak.quantity.starts_with('K') && std::ranges::any_of(all, [&](const Peak& other) {
             return other.quantity.starts_with('K') && other.tip == peak.tip && moment(peak) < nothing * moment(other);
           });
  };
  fmt::format_to(out, "largest{}:\n", moves ? " over time" : "");
  for (const auto& peak : all) {
    if (noise(peak)) continue;
    const auto name = peak.quantity == "w" ? "|w|" : peak.quantity == "von_mises" ? "von Mises" : peak.quantity;
    fmt::format_to(out, "{:>4} {:<11} {:>13.6g}", peak.tip ? fmt::format("{}", *peak.tip) : "", name, peak.value);
    if (peak.error) fmt::format_to(out, " +- {:.2g}", *peak.error);
    if (moves) fmt::format_to(out, " at t = {:.6g}", peak.time);
    if (peak.position) fmt::format_to(out, " at {}", place_text(*peak.position, thickness));
    if (peak.outside)
      fmt::format_to(out, ", no nearer than {:.3g} to tips, sharp corners, pins and point forces", *peak.outside);
    fmt::format_to(out, "\n");
  }
}

/// Stresses near singular places, those that the points resolve.
void near(Text out, const std::vector<StressAtDistance>& all, double thickness, std::size_t most = 8) {
  std::size_t told = 0, left = 0;
  for (const auto& one : all) {
    if (!one.resolved || told == most) {
      ++left;
      continue;
    }
    ++told;
    fmt::format_to(out, "     von Mises {:>15.6g}{} at {:.3g} from {} at {}\n", one.value,
                   one.error ? fmt::format(" +- {:.2g}", *one.error) : "", one.distance, one.place,
                   place_text(one.singular, thickness));
  }
  if (left > 0)
    fmt::format_to(out, "     not stated: stress at {:.3g} from {} more singular places\n", all.front().distance, left);
}

void buckling(Text out, const std::vector<BucklingFactor>& modes) {
  if (modes.empty()) return;
  fmt::format_to(out, "{:>4} {:>15} {:>9} {:>9}\n", "mode", "load factor", "residual", "error");
  for (const auto& one : modes)
    fmt::format_to(out, "{:>4} {:>15.8g} {:>9.1e} {:>9}\n", one.mode, one.factor, one.residual,
                   one.error ? fmt::format("{:.2g} %", 100 * *one.error / one.factor) : "");
}

/// Integrals along lines.
void sums(Text out, const std::vector<ProbeValue>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& one = all[i];
    const bool first = i == 0 || all[i - 1].probe != one.probe;
    fmt::format_to(out, "{}{} {:.5g}{}", first ? (i == 0 ? "across " : "\nacross ") + one.probe + ": " : ", ",
                   one.quantity, one.value, one.error ? fmt::format(" +- {:.2g}", *one.error) : "");
  }
  if (!all.empty()) fmt::format_to(out, "\n");
}

void accuracy(Text out, const AccuracySummary& accuracy) {
  fmt::format_to(out, "accuracy {:.2g} % asked: {}\n{:>8} {:>10} {:>11} {:>9} {:>16}\n", 100 * accuracy.asked,
                 accuracy.outcome(), "points", "spacing", "tip spacing", "seconds", "estimated error");
  for (const auto& step : accuracy.path)
    fmt::format_to(out, "{:>8} {:>10.4g} {:>11.4g} {:>9.2f} {:>16}\n", step.points, step.spacing, step.tip_spacing,
                   step.seconds, step.error ? fmt::format("{:.2g} %", 100 * *step.error) : "-");
}

/// The way to the accuracy of results other than factors.
void targets(Text out, const TargetsSummary& all) {
  const auto share = [](const std::optional<double>& one) {
    return one ? fmt::format("{:.2g} %", 100 * *one) : std::string("-");
  };
  std::vector<std::string> asked;
  for (const auto& one : all.targets)
    asked.push_back(fmt::format("{} {:.2g} % (error {})", one.of, 100 * one.asked, share(one.reached)));
  fmt::format_to(out, "accuracy asked of {}: {}\n{:>8} {:>10} {:>9}", fmt::join(asked, ", "), all.outcome(), "points",
                 "spacing", "seconds");
  for (const auto& one : all.targets) fmt::format_to(out, " {:>12}", one.of);
  for (const auto& step : all.path) {
    fmt::format_to(out, "\n{:>8} {:>10.4g} {:>9.2f}", step.points, step.spacing, step.seconds);
    for (const auto& one : step.targets) fmt::format_to(out, " {:>12}", share(one.reached));
  }
  fmt::format_to(out, "\n");
}

/// Width of the column of names of load cases.
std::size_t width_of_names(const Summary& summary) {
  std::size_t width = 4;
  for (const auto& one : summary.load_cases) width = std::max(width, one.name.size());
  return width;
}

/// Factors of every load case and combination.
void factors_of_cases(Text out, const Summary& summary, bool si, double thickness) {
  const auto width = width_of_names(summary);
  fmt::format_to(out, "{:<{}} {:>4} {:>13} {:>13} {:>13} {:>8}  method\n", "case", width, "tip", "K1", "K2", "K3",
                 "error");
  if (si) fmt::format_to(out, "{:{}} {:>18} {:>13} {:>13}\n", "", width, "[N m^1/2]", "[N m^1/2]", "[N m^-1/2]");
  for (const auto& one : summary.load_cases)
    for (const auto* srif : recommended(one.srif)) {
      const auto K = factor_texts(*srif, thickness);
      fmt::format_to(out, "{:<{}} {:>4} {:>13} {:>13} {:>13} {:>8}  {}\n", one.name, width, srif->tip, K[0], K[1], K[2],
                     in_percent(error_of(*srif, thickness)), name_of(srif->method));
    }
}

/// Factors in the plane of every load case and combination.
void in_plane_of_cases(Text out, const Summary& summary, bool si) {
  const auto width = width_of_names(summary);
  bool first = true;
  for (const auto& one : summary.load_cases)
    for (const auto* srif : recommended(one.srif)) {
      if (!srif->membrane) continue;
      if (std::exchange(first, false))
        fmt::format_to(out, "in the plane{}:\n{:<{}} {:>4} {:>13} {:>13} {:>8}\n", si ? " [N m^-1/2]" : "", "case",
                       width, "tip", "N1", "N2", "error");
      fmt::format_to(out, "{:<{}} {}", one.name, width, in_plane_text(*srif));
    }
}

/// Equivalent factors at the faces of every load case and combination, of recommended methods, and over the toughness.
void faces_of_cases(Text out, const Summary& summary, bool si) {
  const auto width = width_of_names(summary);
  const auto with_error = [](const std::optional<double>& value, const std::optional<double>& error) {
    return (value ? fmt::format("{:.3g}", *value) : "-") + (error ? fmt::format(" +- {:.2g}", *error) : "");
  };
  bool first = true;
  for (const auto& one : summary.load_cases)
    for (std::size_t i = 0; i < one.faces.size(); ++i) {
      const auto tip = one.srif[i].tip;
      const auto& face = one.faces[i];
      if ((!face.equivalent && !face.utilisation) || (i > 0 && one.srif[i - 1].tip == tip)) continue;
      if (std::exchange(first, false))
        fmt::format_to(out, "at the faces{}:\n{:<{}} {:>4} {:>22}{}\n", si ? " [Pa m^1/2]" : "", "case", width, "tip",
                       "K_eq", summary.toughness ? fmt::format(" {:>18}", "of toughness") : "");
      fmt::format_to(
          out, "{:<{}} {:>4} {:>22}{}\n", one.name, width, tip, with_error(face.equivalent, face.error),
          face.utilisation ? fmt::format(" {:>18}", with_error(face.utilisation, face.utilisation_error)) : "");
    }
}

/// True where both quantities are factors of moments, or both of membrane forces: the largest shows what is noise.
bool alike(const EnvelopeEntry& one, const EnvelopeEntry& other) {
  const auto kind = [](const EnvelopeEntry& entry) { return entry.quantity == "K_eq" ? 'q' : entry.quantity.front(); };
  return one.tip == other.tip && kind(one) == kind(other) && (kind(one) == 'K' || kind(one) == 'N');
}

void largest_of_cases(Text out, const std::vector<EnvelopeEntry>& envelope, double thickness) {
  const auto size = [&](const EnvelopeEntry& one) {
    return std::max(std::abs(one.value), one.error.value_or(0)) * (one.quantity == "K3" ? thickness : 1);
  };
  std::size_t width = 3;
  for (const auto& one : envelope) width = std::max(width, one.quantity.size());
  fmt::format_to(out, "largest of all load cases and combinations:\n");
  for (const auto& one : envelope) {
    const bool noise = std::ranges::any_of(
        envelope, [&](const EnvelopeEntry& other) { return alike(one, other) && size(one) < nothing * size(other); });
    const bool known = one.error.value_or(0) <= std::abs(one.value);
    if (!noise)
      fmt::format_to(out, "{:>4} {:<{}} {:>13} {:<11}  {}\n", one.tip, one.quantity, width,
                     known ? fmt::format("{:.6g}", one.value) : "-",
                     one.error ? fmt::format("+- {:.2g}", *one.error) : "", known ? one.of : "not resolved in all");
  }
}

std::string printed_load_steps(const Table& steps) {
  std::vector<TextColumn> columns;
  for (std::size_t i = 0; i < steps.columns.size(); ++i) {
    auto& column = columns.emplace_back(TextColumn{steps.columns[i], true});
    for (const auto& row : steps.rows) {
      const auto* number = std::get_if<double>(&row[i]);
      column.cells.push_back(number ? fmt::format("{:.6g}", *number) : std::get<std::string>(row[i]));
    }
  }
  return aligned(columns);
}

}  // namespace

std::string printed(const Summary& summary, bool si, double thickness, const std::filesystem::path& folder) {
  std::string text;
  const Text out(text);
  const auto& a = summary.analysis;
  const bool has_plane =
      summary.membrane || std::ranges::any_of(summary.load_cases, [](const auto& one) { return bool(one.membrane); });
  fmt::format_to(out, "{}: {} ({}), {} points, {} bonds, {} {} in {:.1f} s, {}\n", summary.title, summary.formulation,
                 summary.formulation_reason, summary.points, summary.bonds,
                 a.iterations ? *a.iterations : a.steps.value_or(0), a.iterations ? "iterations" : "steps",
                 summary.seconds.back().second,
                 has_plane && a.iterations == std::size_t(0) ? "loaded in its plane alone" : a.stop_reason);
  if (!summary.recipe.empty()) fmt::format_to(out, "recipe {}\n", summary.recipe);
  if (summary.processes) text += printed(*summary.processes);
  if (summary.accuracy) accuracy(out, *summary.accuracy);
  if (summary.targets) targets(out, *summary.targets);
  if (!summary.srif.empty() && !summary.peaks.empty()) fmt::format_to(out, "at the end of the duration:\n");
  if (!summary.srif.empty()) factors(out, summary.srif, si, thickness);
  in_plane(out, summary.srif, si);
  if (!summary.faces.empty() && (si || summary.toughness)) faces(out, summary, si);
  if (!summary.load_cases.empty()) text += printed_load_cases(summary, si, thickness);
  if (summary.reactions) {
    const auto& [of_supports, loads, inertia, residual] = summary.reactions->balance;
    double size = std::abs(loads.force);
    for (const auto& one : of_supports) size = std::max(size, std::abs(one.force));
    if (size > 0 || !summary.membrane) reactions(out, *summary.reactions, si ? " [N]" : "", size, 12);
  }
  if (summary.membrane && a.iterations) displaced(out, *summary.membrane, "", si, 12);
  if (summary.touching) fmt::format_to(out, "soil touches {:.1f} % of what lies above it\n", 100 * *summary.touching);
  if (summary.lifted) lifted(out, *summary.lifted, "", si);
  if (summary.contact) contact(out, *summary.contact, "", si);
  if (summary.multipliers)
    fmt::format_to(out, "multipliers add forces of {:.2g} of the loads beside the edges\n", *summary.multipliers);
  if (!summary.peaks.empty()) peaks(out, summary.peaks, true, thickness);
  if (!summary.extremes.empty()) peaks(out, summary.extremes, false, thickness);
  near(out, summary.stress_near, thickness);
  sums(out, summary.lines);
  const bool both = !summary.frequencies.empty() && summary.frequencies.front().share_in_plane;
  if (!summary.frequencies.empty())
    fmt::format_to(out, "{:>4} {:>13} {:>13} {:>9}{}{}\n", "mode", "frequency", "omega", "residual",
                   both ? "  share in plane" : "", summary.frequencies.front().error ? "     error" : "");
  for (const auto& f : summary.frequencies)
    fmt::format_to(out, "{:>4} {:>13.6f} {:>13.5f} {:>9.1e}{}{}\n", f.mode, f.frequency, f.omega, f.residual,
                   both ? fmt::format("  {:>14.3g}", f.share_in_plane.value_or(0)) : "",
                   f.error && f.frequency > 0 ? fmt::format("{:>8.2g} %", 100 * *f.error / f.frequency) : "");
  buckling(out, summary.buckling);
  if (!summary.load_steps.rows.empty()) text += printed_load_steps(summary.load_steps);
  text += printed_responses(summary.response, si);
  if (!summary.resonances.empty()) fmt::format_to(out, "resonances: {:.6g}\n", fmt::join(summary.resonances, ", "));
  if (summary.growth) growth(out, *summary.growth);
  if (summary.linear_theory_off) {
    if (const auto said = error_of_linear_theory(summary.linear_theory_off); !si && !said.empty()) text += said + '\n';
  } else if (const auto share = summary.deflection_over_thickness;
             share && !si && summary.load_steps.rows.empty() && *share > small_deflection) {
    fmt::format_to(
        out, "largest deflection is {:.2g} x thickness; linear plate theory is reliable up to about {:g} x thickness\n",
        *share, small_deflection);
  }
  for (const auto& warning : summary.warnings) fmt::format_to(out, "warning: {}\n", warning);
  return text + results_in(folder);
}

std::string results_in(const std::filesystem::path& folder) {
  const auto page = folder / "report.html";
  std::error_code ignored;
  return std::filesystem::exists(page, ignored)
             ? fmt::format("results in {}; report: {}\n", folder.string(), page.string())
             : fmt::format("results in {}\n", folder.string());
}

namespace {

/// A quantity of a tip in one load case: its value, where it is resolved, or else what it may be.
struct Known {
  std::optional<double> value, error;
  double at_most = 0;
};

/// K_eq and utilisation of a tip.
std::array<Known, 2> known_at_faces(const Srif& srif, const plate::Section& section, std::optional<double> toughness) {
  const auto faces = at_faces(srif, section, toughness), most = at_faces(as_resolved(srif), section, toughness);
  std::array<Known, 2> result;
  if (faces.equivalent) result[0] = {faces.equivalent, faces.error};
  if (faces.utilisation) result[1] = {faces.utilisation, faces.utilisation_error};
  if (!faces.equivalent) result[0].at_most = most.equivalent.value_or(0) + most.error.value_or(0);
  if (!faces.utilisation) result[1].at_most = most.utilisation.value_or(0) + most.utilisation_error.value_or(0);
  return result;
}

/// Quantities of the envelope, in its order; those that a tip does not have without value.
std::array<Known, 8> quantities_of(const Srif& srif, const plate::Section& section, std::optional<double> toughness) {
  std::array<Known, 8> result;
  const auto factor = [](double value, const std::optional<double>& error, bool resolved) {
    return resolved ? Known{value, error} : Known{{}, {}, std::abs(value) + error.value_or(0)};
  };
  const std::array K{srif.K1, srif.K2, srif.K3};
  for (std::size_t i = 0; i < 3; ++i) result[i] = factor(K[i], srif.errors[i], srif.resolved[i]);
  result[3].value = srif.G;
  if (const auto& membrane = srif.membrane)
    for (std::size_t i = 0; i < 2; ++i)
      result[4 + i] = factor(membrane->N[i], membrane->errors[i], membrane->resolved[i]);
  std::ranges::copy(known_at_faces(srif, section, toughness), result.begin() + 6);
  return result;
}

}  // namespace

std::vector<EnvelopeEntry> envelope(const std::vector<LoadCaseSummary>& cases, const plate::Section& section,
                                    std::optional<double> toughness) {
  static const std::array names{"K1", "K2", "K3", "G", "N1", "N2", "K_eq", "utilisation"};
  std::map<std::pair<std::size_t, std::size_t>, EnvelopeEntry> found;
  std::map<std::pair<std::size_t, std::size_t>, double> lost;  // what factors that are not resolved may be
  for (const auto& one : cases)
    for (const auto* srif : recommended(one.srif)) {
      const auto quantities = quantities_of(*srif, section, toughness);
      for (std::size_t k = 0; k < quantities.size(); ++k) {
        const auto& [value, error, at_most] = quantities[k];
        auto& most = lost[{srif->tip, k}];
        most = std::max(most, at_most);
        if (!value) continue;
        const EnvelopeEntry entry{srif->tip, srif->position, names[k], *value, error, one.name};
        const auto [there, is_new] = found.emplace(std::pair(srif->tip, k), entry);
        if (!is_new && std::abs(entry.value) > std::abs(there->second.value)) there->second = entry;
      }
    }
  std::vector<EnvelopeEntry> result;
  for (auto& [key, entry] : found) {
    if (const double more = lost[key] - std::abs(entry.value); more > entry.error.value_or(0)) entry.error = more;
    result.push_back(std::move(entry));
  }
  const auto governs = [](const EnvelopeEntry& one) { return one.quantity == "utilisation" ? -one.value : INFINITY; };
  std::ranges::stable_sort(result, {}, governs);
  return result;
}

Table envelope_table(const std::vector<EnvelopeEntry>& entries) {
  Table table{{"tip", "x", "y", "quantity", "value", "estimated_error", "case"}, {}};
  for (const auto& one : entries)
    table.rows.push_back(
        {double(one.tip), one.position.x(), one.position.y(), one.quantity, one.value, cell(one.error), one.of});
  return table;
}

void name_cases(Table& table, const std::vector<LoadCaseSummary>& cases) {
  const auto time = table.column("time");
  table.columns.emplace_back("case");
  for (auto& row : table.rows) row.emplace_back(cases.at(std::size_t(std::get<double>(row[time])) - 1).name);
}

std::string printed_load_cases(const Summary& summary, bool si, double thickness) {
  std::string text;
  const Text out(text);
  const bool factors = std::ranges::any_of(summary.load_cases, [](const auto& one) { return !one.srif.empty(); });
  if (!summary.envelope.empty()) largest_of_cases(out, summary.envelope, thickness);
  if (factors) factors_of_cases(out, summary, si, thickness);
  in_plane_of_cases(out, summary, si);
  faces_of_cases(out, summary, si);
  for (const auto& one : summary.load_cases)
    if (one.contact) contact(out, *one.contact, ", " + one.name, si);
  const auto alone =
      std::ranges::find_if(summary.load_cases, [](const auto& one) { return !one.of.empty() && !one.superposed(); });
  if (alone != summary.load_cases.end())
    fmt::format_to(out, "combinations are solved under their own loads, not superposed ({})\n",
                   alone->large_deflections ? "large deflections" : "contact of crack faces");
  for (const auto& one : summary.load_cases)
    if (one.reactions)
      reactions(out, *one.reactions, (si ? " [N], " : ", ") + one.name, std::abs(one.reactions->balance.loads.force),
                8);
  for (const auto& one : summary.load_cases)
    if (one.membrane) displaced(out, *one.membrane, ", " + one.name, si, 8);
  for (const auto& one : summary.load_cases)
    if (one.lifted) lifted(out, *one.lifted, ", " + one.name, si);
  for (const auto& one : summary.load_cases)
    for (const auto& peak : one.extremes)
      if (peak.quantity == "w" && peak.position)
        fmt::format_to(out, "largest |w|, {}: {:.6g} at {}\n", one.name, peak.value,
                       place_text(*peak.position, thickness));
  return text;
}

}  // namespace post
