#include "cases/driver/severed_frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/driver/results.hpp"
#include "post/files/mesh.hpp"

namespace cases {

post::TipMethods severed_tip_methods(const Case& c, const Assembly& assembly, const geometry::Families& families,
                                     const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip,
                                     const post::SrifOptions& options, double reach) {
  const auto& cloud = assembly.boundary.cloud;
  const post::BondedPlate plate{cloud.positions,    cloud.areas, families,                 assembly.ordinary()->shapes(),
                                cloud.plate_points, c.section,   c.discretization.spacing};
  const double clear = std::min(reach, clear_distance(c, paths, tip));
  post::TipMethods result(plate, post::TipPlace{tip, paths[tip.crack], clear, clear, 0}, c.discretization.horizon(), options);
  if (!result.works()) throw std::invalid_argument(fmt::format("{}", fmt::join(result.left_out(), "; ")));
  return result;
}

post::Mesh severed_frame(const Case& c, const Assembly& assembly, const geometry::Families& families, post::Frame& frame,
                         const plate::State& state) {
  const auto& first = assembly.families();
  const auto& shapes = assembly.ordinary()->shapes();
  const auto& cloud = assembly.boundary.cloud;
  frame.resultants = plate::resultants(state, families, shapes, cloud.areas, cloud.plate_points, c.section);
  frame.damage.assign(cloud.plate_points, 0);
  const auto weight = [&](const geometry::Families& of, std::size_t k) {
    double sum = 0;
    for (const auto& bond : of[k]) sum += shapes[bond.vector_id].weight;
    return sum;
  };
  for (std::size_t k = 0; k < frame.damage.size(); ++k)
    if (families[k].size() < first[k].size()) frame.damage[k] = 1 - weight(families, k) / weight(first, k);
  return post::mesh(assembly.boundary, families, assembly.cut, c.section.thickness);
}

}  // namespace cases
