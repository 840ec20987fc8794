#include "cases/runs/distributed_run.hpp"

#include <algorithm>
#include <sstream>

#include "cases/input/case_file.hpp"
#include "cases/runs/cost_estimate.hpp"
#include "plate/bonds/part_of_lattice.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/foundations.hpp"
#include "plate/galerkin/discretised_cells.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/galerkin/part_of_cells.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/reduction.hpp"

namespace cases {
namespace {

/// Message of why the plate in twice the spacing has too few blocks or points for the ranks; empty where it has enough.
std::string error_in_twice_the_spacing(const plate::Problem& problem, int processes) {
  auto coarse = problem;
  coarse.discretization.spacing *= 2;
  try {
    if (problem.discretization.formulation == &plate::galerkin)
      plate::require_parts(plate::global_cells_of(coarse, plate::crack_paths(coarse), 1, true), processes);
    else
      plate::partition_of_lattice(coarse.outline, coarse.discretization, processes);
  } catch (const plate::Refused& refused) {
    return std::string("twice the spacing: ") + refused.what();
  } catch (const std::invalid_argument& error) {
    return std::string("twice the spacing: ") + error.what();
  }
  return "";
}

using Refuse = std::function<void(bool asked, const std::string& key, const std::string& why)>;

/// Refuses windows wider than the region seen about a tip, which is as wide as the widest ring.
void refuse_wide_windows(const Case& c, const Refuse& refuse) {
  if (!c.srif) return;
  const auto& d = c.discretization;
  const double seen = d.formulation == &plate::galerkin
                          ? plate::widest_window(c)
                          : plate::reach_about_tips(d.horizon_ratio) * d.spacing - d.horizon();
  refuse(c.srif->window.value_or(0) > seen, "srif.window", "so wide a window cannot be seen");
  refuse(!c.srif->window && c.srif->window_horizons * d.horizon() > seen, "srif.window_horizons",
         "so wide a window cannot be seen");
}

}  // namespace

std::vector<KeyError> errors_in_distribution(const Case& c, int processes) {
  std::vector<KeyError> result;
  const Refuse refuse = [&](bool asked, const std::string& key, const std::string& why) {
    if (asked) result.push_back({key, why + " yet by several processes: run it by one (pdplate)"});
  };
  constexpr double most_factorised = 1e6;  // points; MUMPS takes no more (plate/distributed)
  const bool rests = !c.moves() || c.analysis.start == plate::Analysis::Start::equilibrium;
  refuse(c.stretches_at_first() && 2 * expected_points(c) > most_factorised, "analysis.nonlinear",
         "large deflections of so many points cannot be found");
  refuse(plate::rests_with_plane(c) && rests && 2 * expected_points(c) > most_factorised,
         c.coupled() ? "section" : "cracks.contact",
         "coupled bending and stretching of so many points cannot be found");
  refuse(c.faces_touch() && rests && expected_points(c) > most_factorised, "cracks.contact",
         "contact of faces of so many points cannot be found");
  refuse(c.analysis.method == plate::Analysis::Method::direct && expected_points(c) > most_factorised,
         "analysis.method", "\"direct\" of so many points cannot be run");
  if (c.srif && c.srif->richardson && processes > 0)
    if (auto error = error_in_twice_the_spacing(c, processes); !error.empty())
      result.push_back({"srif.richardson", std::move(error)});
  refuse_wide_windows(c, refuse);
  return result;
}

void count_all(post::Summary& summary, const plate::Formulation& plate) {
  if (!plate.distributed()) return;
  const auto& boundary = plate.boundary();
  std::array<std::int64_t, 4> counts{};  // points, bonds among them, fictitious points, all other bonds
  for (std::uint32_t k = 0; k < boundary.cloud.size(); ++k) {
    if (!boundary.owns(k)) continue;
    const bool real = boundary.is_plate(k);
    ++counts[real ? 0 : 2];
    for (const auto& bond : plate.families()[k]) ++counts[real && boundary.is_plate(bond.neighbour) ? 1 : 3];
  }
  summary.own_points = std::size_t(counts[0]);
  counts = plate::counts_of_all(plate, counts);
  summary.points = std::size_t(counts[0]), summary.bonds = std::size_t(counts[1]);
  summary.fictitious_points = std::size_t(counts[2]), summary.fictitious_bonds = std::size_t(counts[3]);
}

}  // namespace cases
