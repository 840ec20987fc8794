#include "plate/model/faults/spring_faults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "plate/model/faults/held.hpp"
#include "plate/model/problem.hpp"

namespace plate {
namespace {

constexpr auto of_lines = " resists along edges and lines; a position has deflection and rotation";

/// All that is wrong with a spring as such, in one sentence.
void check_keys(const Spring& spring, std::size_t number, std::vector<Refusal>& found) {
  std::vector<std::string> faults;
  const int places = !spring.edges.empty() + !spring.along.empty() + spring.position.has_value();
  if (places != 1)
    faults.push_back(
        fmt::format("{} given, must be one of edges, along and position", places == 0 ? "none" : "several"));
  if (spring.deflection + spring.rotation_normal + spring.rotation_tangential + spring.rotation <= 0)
    faults.push_back("resists nothing: give deflection, rotation_normal, rotation_tangential or rotation > 0");
  if (spring.position && spring.rotation_normal > 0) faults.push_back(fmt::format("rotation_normal{}", of_lines));
  if (spring.position && spring.rotation_tangential > 0)
    faults.push_back(fmt::format("rotation_tangential{}", of_lines));
  if (!spring.position && places > 0 && spring.rotation > 0)
    faults.push_back(
        "rotation is of a spring at a position; edges and lines have rotation_normal and rotation_tangential");
  if (!faults.empty()) found.push_back({Subject::spring, number, fmt::format("{}", fmt::join(faults, "; "))});
}

void check_edge(const Spring& spring, const std::string& edge, std::size_t number, const Problem& problem,
                std::vector<Refusal>& found) {
  for (std::size_t i = 0; i < problem.supports.size(); ++i) {
    const auto& support = problem.supports[i];
    if (std::ranges::find(support.edges, edge) == support.edges.end()) continue;
    const auto held = held_by(support.kind);
    std::vector<std::string> keys;
    if (held.w && spring.deflection > 0) keys.push_back("deflection");
    if (held.normal && spring.rotation_normal > 0) keys.push_back("rotation_normal");
    if (held.tangential && spring.rotation_tangential > 0) keys.push_back("rotation_tangential");
    if (!keys.empty())
      found.push_back({Subject::spring_edges, number,
                       fmt::format("edge \"{}\" is held by support[{}], which leaves nothing for {} to do", edge, i,
                                   fmt::join(keys, " and "))});
  }
}

void check_stiffener(const Problem& problem, std::size_t number, std::vector<Refusal>& found) {
  const auto& beam = problem.stiffeners[number];
  std::vector<std::string> faults;
  const int places = !beam.edges.empty() + !beam.along.empty();
  if (places != 1)
    faults.push_back(fmt::format("{} given, must be one of edges and along", places == 0 ? "none" : "both"));
  if (beam.bending + beam.torsion <= 0) faults.push_back("stiffens nothing: give bending or torsion > 0");
  if (beam.shear && beam.bending <= 0) faults.push_back("shear is of a beam with bending > 0: remove it");
  if (!faults.empty()) found.push_back({Subject::stiffener, number, fmt::format("{}", fmt::join(faults, "; "))});
  for (std::size_t i = 0; i < problem.supports.size(); ++i)
    for (const auto& edge : beam.edges)
      if (const auto& s = problem.supports[i];
          held_by(s.kind).w && held_by(s.kind).normal && std::ranges::find(s.edges, edge) != s.edges.end())
        found.push_back(
            {Subject::stiffener_edges, number,
             fmt::format("edge \"{}\" is clamped by support[{}], which leaves nothing for a beam to do", edge, i)});
}

}  // namespace

std::vector<Refusal> faults_of_springs(const Problem& problem) {
  std::vector<Refusal> found;
  for (std::size_t i = 0; i < problem.stiffeners.size(); ++i) check_stiffener(problem, i, found);
  for (std::size_t i = 0; i < problem.springs.size(); ++i) {
    check_keys(problem.springs[i], i, found);
    for (const auto& edge : problem.springs[i].edges) check_edge(problem.springs[i], edge, i, problem, found);
  }
  const auto boundary = problem.discretization.boundary;
  if (problem.elastically_held() && (boundary == EdgeMethod::surface_nodes || boundary == EdgeMethod::fictitious_nodes))
    found.push_back({Subject::edge_method, 0,
                     "the stiffness of a plate with conditions at its edges has no place for foundations and springs: "
                     "choose \"images\""});
  return found;
}

}  // namespace plate
