#include "post/report/errors_of_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "plate/model/problem.hpp"

namespace post {
namespace {

/// Differences of values that have one relative error in common, at least.
class Differences {
public:
  explicit Differences(double share) : share_(share) {}

  /// Takes a value of a kind, that of the other points, and where its error goes.
  /// `least`: size of such values in the plate, beside which those at the probes may be rounding.
  void add(const std::string& kind, double value, double other, std::optional<double>& error, double least = 0) {
    auto& size = sizes_[kind];
    size = std::max({size, std::abs(value), least});
    all_.push_back({kind, share_ * std::abs(value - other), &error});
  }

  /// Returns the largest relative difference.
  double largest() const {
    double result = 0;
    for (const auto& one : all_)
      if (const double size = sizes_.at(one.kind); size > 0) result = std::max(result, one.difference / size);
    return result;
  }

  /// Sets all errors, at least `floor` times the largest relative one and `least`, relative too. Those that are known
  /// already do not get less.
  void set(double floor, double least = 0) const {
    const double common = std::max(floor * largest(), least);
    for (const auto& one : all_)
      *one.error = std::max({one.difference, common * sizes_.at(one.kind), one.error->value_or(0)});
  }

private:
  struct One {
    std::string kind;
    double difference;
    std::optional<double>* error;
  };
  double share_;
  std::map<std::string, double> sizes_;
  std::vector<One> all_;
};

/// The results that load cases and runs have alike.
struct Alike {
  std::vector<Peak>& extremes;
  std::vector<ProbeValue>&probes, &lines;
  std::vector<StressAtDistance>& stress_near;
  std::optional<ReactionSummary>& reactions;
  std::optional<MembraneSummary>& membrane;
  std::optional<double>& energy_error;
  double strain_energy;
};

template <typename Found>
Alike alike(Found& found, double strain_energy) {
  return {found.extremes,  found.probes,   found.lines,        found.stress_near,
          found.reactions, found.membrane, found.energy_error, strain_energy};
}

double strain_energy(const Summary& summary) {
  const auto found = std::ranges::find(summary.energy, "strain", &std::pair<std::string, double>::first);
  return found == summary.energy.end() ? 0 : found->second;
}

const Peak* peak_of(const std::vector<Peak>& peaks, const std::string& quantity) {
  const auto found = std::ranges::find(peaks, quantity, &Peak::quantity);
  return found == peaks.end() ? nullptr : &*found;
}

/// Values of a probe that have one relative error, and those of them that have one size.
std::pair<const char*, const char*> group_and_size(const std::string& quantity) {
  static const std::map<std::string, std::pair<const char*, const char*>> all{
      {"w", {"bending", "w"}},
      {"theta_x", {"bending", "theta"}},
      {"theta_y", {"bending", "theta"}},
      {"u", {"plane", "u"}},
      {"v", {"plane", "u"}},
      {"Mxx", {"moments", "M"}},
      {"Myy", {"moments", "M"}},
      {"Mxy", {"moments", "M"}},
      {"Qx", {"shear", "Q"}},
      {"Qy", {"shear", "Q"}},
      {"Nxx", {"membrane forces", "N"}},
      {"Nyy", {"membrane forces", "N"}},
      {"Nxy", {"membrane forces", "N"}},
      {"von_mises", {"moments", "von_mises"}},
      {"sigma1_top", {"moments", "von_mises"}},
      {"sigma2_top", {"moments", "von_mises"}},
      {"sigma1_bottom", {"moments", "von_mises"}},
      {"sigma2_bottom", {"moments", "von_mises"}},
      {"moment", {"sums of moments", "M"}},
      {"twist", {"sums of moments", "M"}},
      {"shear", {"sums of shear", "Q"}},
      {"normal_force", {"sums of membrane forces", "N"}},
      {"tangential_force", {"sums of membrane forces", "N"}},
      {"K_front", {"moments", "K"}}};
  return all.at(quantity);
}

/// Sizes of rotations, moments, forces and stresses in a plate, by kinds: a tenth of what its largest deflection and
/// stress give. What is smaller at the probes may be rounding, as the rotation in the middle of a symmetric plate.
std::map<std::string, double> least_sizes(const Alike& own, const PlateSizes& sizes) {
  constexpr double share = 0.1;
  const double diameter = sizes.diameter, h = sizes.thickness;
  std::map<std::string, double> result;
  if (const auto* w = peak_of(own.extremes, "w")) result["theta"] = share * std::abs(w->value) / diameter;
  if (const auto* stress = peak_of(own.extremes, "von_mises")) {
    const double moment = share * stress->value * h * h / 6;
    result["M"] = moment, result["Q"] = moment / diameter;
    result["N"] = share * stress->value * h, result["von_mises"] = share * stress->value;
  }
  return result;
}

bool is_angle(const ProbeValue& one) {
  return one.quantity.starts_with("angle_");
}

/// Angles of principal stresses, which turn by what both stresses may be off, but by no more than a right angle. Each
/// follows its two stresses.
void set_errors_of_angles(std::vector<ProbeValue>& own, const std::vector<ProbeValue>& other, double share) {
  constexpr double right = 90, degrees = 180 / std::numbers::pi;
  for (std::size_t i = 2; i < std::min(own.size(), other.size()); ++i) {
    if (!is_angle(own[i])) continue;
    const auto &largest = own[i - 2], &smallest = own[i - 1];
    const double apart = largest.value - smallest.value,
                 off = largest.error.value_or(INFINITY) + smallest.error.value_or(INFINITY);
    const double turned = std::abs(std::remainder(own[i].value - other[i].value, 2 * right));
    const double by_stress = off < apart ? degrees * std::asin(off / apart) / 2 : right;
    own[i].error = std::min(right, std::max(share * turned, by_stress));
  }
}

/// Returns the relative error of deflections, rotations and strain energy.
double set_errors_of_displacements(const Alike& own, const Alike& other, const OtherResults& by,
                                   const PlateSizes& sizes) {
  std::map<std::string, Differences> groups;
  const auto group = [&](const char* name) -> Differences& { return groups.try_emplace(name, by.share).first->second; };
  const auto least = least_sizes(own, sizes);
  for (auto& one : own.extremes)
    if (const auto* there = peak_of(other.extremes, one.quantity)) {
      const double size = std::abs(one.value), that = std::abs(there->value);
      if (one.quantity == "w")
        group("bending").add("w", size, that, one.error);
      else
        // where other places are left out, the change to the next points tells instead
        one.error = one.outside == there->outside
                        ? std::max(one.error.value_or(0), by.of_largest_stress * by.share * std::abs(size - that))
                        : std::min(2 * by.of_largest_stress * one.error.value_or(0), size);
    }
  if (own.strain_energy > 0) group("bending").add("energy", own.strain_energy, other.strain_energy, own.energy_error);
  const auto compare = [&](std::vector<ProbeValue>& values, const std::vector<ProbeValue>& there) {
    for (std::size_t i = 0; i < std::min(values.size(), there.size()); ++i) {
      if (is_angle(values[i])) continue;
      const auto& [where, kind] = group_and_size(values[i].quantity);
      const auto size = least.find(kind);
      group(where).add(kind, values[i].value, there[i].value, values[i].error, size == least.end() ? 0 : size->second);
    }
  };
  compare(own.probes, other.probes), compare(own.lines, other.lines);
  if (own.membrane && other.membrane)
    group("plane").add("u", own.membrane->largest_displacement, other.membrane->largest_displacement,
                       own.membrane->error);
  // all of a deflection is off where its supports are; moments are so in places
  for (const auto& [name, differences] : groups) differences.set(name == "bending" || name == "plane" ? 1 : by.floor);
  set_errors_of_angles(own.probes, other.probes, by.share);
  return group("bending").largest();
}

/// Corners have one relative error in common: two values at one of them may agree by chance.
void set_errors_of_stress_near(std::vector<StressAtDistance>& own, const std::vector<StressAtDistance>& other,
                               const OtherResults& by) {
  std::map<std::string, Differences> places;  // corners have one name
  for (auto& one : own) {
    const auto there =
        std::ranges::find_if(other, [&](const auto& that) { return (that.singular - one.singular).isZero(0); });
    if (there == other.end()) continue;
    auto& group = places.try_emplace(one.place, by.of_largest_stress * by.share).first->second;
    group.add(fmt::format("{}", &one - own.data()), one.value, there->value, one.error);  // each of its own size
  }
  for (const auto& [name, differences] : places) differences.set(1);
}

/// Forces, and moments over the size of the plate, of every support by name.
/// `least`: relative error of them, at least.
void set_errors_of_reactions(ReactionSummary& own, const ReactionSummary& other, double share, double size,
                             double least) {
  std::vector<std::array<std::optional<double>, 3>> errors(own.supports.size());
  Differences all(share);
  for (std::size_t i = 0; i < own.supports.size(); ++i) {
    const auto& support = own.supports[i];
    const auto there = std::ranges::find(other.supports, support.name, &ReactionSummary::Support::name);
    if (there == other.supports.end()) return;
    const auto here = support.written(own.balance.supports[i]);
    const auto that = there->written(other.balance.supports[std::size_t(there - other.supports.begin())]);
    all.add("", here.force, that.force, errors[i][0]);
    all.add("", here.moment_x / size, that.moment_x / size, errors[i][1]);
    all.add("", here.moment_y / size, that.moment_y / size, errors[i][2]);
  }
  all.set(1, least);
  own.errors.resize(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto& [force, x, y] = errors[i];
    auto& error = own.errors[i];
    error = {std::max(error.force, *force), std::max(error.moment_x, size * *x), std::max(error.moment_y, size * *y)};
  }
}

/// The sizes of the largest values along edges, and the forces at corners: each quantity has one relative error, at
/// least. Their sign is that of any of two places where the plate is symmetric. Beside corners they fall slower than
/// other differences, as the largest stress does.
void set_errors_along_edges(ReactionSummary& own, const ReactionSummary& other, const OtherResults& by, double least) {
  std::map<std::string, Differences> groups;
  const auto group = [&](const std::string& name) -> Differences& {
    return groups.try_emplace(name, by.of_largest_stress * by.share).first->second;
  };
  if (own.edges.size() != other.edges.size() || own.corners.size() != other.corners.size()) return;
  for (std::size_t i = 0; i < own.edges.size(); ++i)
    group(own.edges[i].quantity)
        .add("", std::abs(own.edges[i].value), std::abs(other.edges[i].value), own.edges[i].error);
  for (std::size_t i = 0; i < own.corners.size(); ++i)
    group("corner").add("", own.corners[i].force, other.corners[i].force, own.corners[i].error);
  for (const auto& [name, differences] : groups) differences.set(1, least);
}

void set_errors_of_forces_in_plane(MembraneSummary& own, const MembraneSummary& other, double share) {
  std::vector<std::array<std::optional<double>, 2>> errors(own.reactions.size());
  Differences all(share);
  for (std::size_t i = 0; i < own.reactions.size(); ++i) {
    const auto there = std::ranges::find(other.reactions, own.reactions[i].name, &MembraneSummary::Reaction::name);
    if (there == other.reactions.end()) return;
    for (const int axis : {0, 1})
      all.add("", own.reactions[i].force[axis], there->force[axis], errors[i][std::size_t(axis)]);
  }
  all.set(1);
  for (std::size_t i = 0; i < errors.size(); ++i)
    own.reactions[i].error = std::max({own.reactions[i].error.value_or(0), *errors[i][0], *errors[i][1]});
}

void set_errors_alike(const Alike& own, const Alike& other, const OtherResults& by, const PlateSizes& sizes) {
  const double of_bending = set_errors_of_displacements(own, other, by, sizes);
  const double share = by.share;
  set_errors_of_stress_near(own.stress_near, other.stress_near, by);
  if (own.reactions && other.reactions) {
    const double least = std::max(sizes.soft_edges, of_bending / 2);
    set_errors_of_reactions(*own.reactions, *other.reactions, share, sizes.diameter, least);
    set_errors_along_edges(*own.reactions, *other.reactions, by, least);
  }
  if (own.membrane && other.membrane) set_errors_of_forces_in_plane(*own.membrane, *other.membrane, share);
}

/// Relative errors of modes are those of the modes below at least, and those of the modes above in the ratio of the
/// frequencies, as errors of the second order grow with them: two values may agree by chance.
void set_errors_of_frequencies(std::vector<Frequency>& own, const std::vector<Frequency>& other, double share) {
  const std::size_t count = std::min(own.size(), other.size());
  std::vector<double> relative(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    if (const double f = own[i].frequency; f > 0) {
      const double apart = share * std::abs(f - other[i].frequency) / f;
      for (std::size_t j = 0; j < count; ++j)
        relative[j] = std::max(relative[j], apart * std::min(1.0, own[j].frequency / f));
    }
  for (std::size_t i = 0; i < count; ++i)
    own[i].error = std::max(own[i].error.value_or(0), relative[i] * own[i].frequency);
}

}  // namespace

double error_of_soft_edges(const plate::Problem& problem) {
  constexpr double share = 0.3, most = 3;  // measured: tests/verification/measured_edges_galerkin.md, "Reactions"
  const bool soft = std::ranges::any_of(problem.supports, [](const plate::Support& support) {
    return support.kind == plate::SupportKind::simply_supported && !support.edges.empty() && !support.holds_nothing();
  });
  if (!soft) return 0;
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const auto& d = problem.discretization;
  double spacing = d.spacing;
  if (d.tip_spacing) {  // points at edges as plate::grading_of() has them
    const double wide = d.spacing_growth * d.spacing, layer = problem.section.layer();
    spacing = std::min(spacing, std::max({wide, std::sqrt(wide * layer), 7 * d.spacing_growth * layer}));
  }
  return share * spacing / (high - low).minCoeff() * std::clamp(spacing / problem.section.thickness, 1.0, most);
}

PlateSizes sizes_of(const plate::Problem& problem) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  return {(high - low).norm(), problem.section.thickness, error_of_soft_edges(problem)};
}

void set_errors(Summary& summary, const OtherResults& other, const PlateSizes& sizes) {
  Summary there = other.summary;
  set_errors_alike(alike(summary, strain_energy(summary)), alike(there, strain_energy(there)), other, sizes);
  for (std::size_t i = 0; i < std::min(summary.load_cases.size(), there.load_cases.size()); ++i) {
    auto &own = summary.load_cases[i], &that = there.load_cases[i];
    set_errors_alike(alike(own, own.strain_energy), alike(that, that.strain_energy), other, sizes);
  }
  set_errors_of_frequencies(summary.frequencies, there.frequencies, other.share);
}

}  // namespace post
