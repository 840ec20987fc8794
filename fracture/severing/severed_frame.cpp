#include "fracture/severing/severed_plate.hpp"
#include "plate/bonds/mesh.hpp"
#include "plate/bonds/resultants.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "post/files/frame.hpp"

namespace fracture {

plate::Mesh SeveredPlate::draw(post::Frame& frame, const plate::State& state, const plate::Formulation& start,
                               const std::vector<geometry::CrackPath>& cracks) const {
  const auto& first = base_.families();
  const auto& shapes = base_.shapes();
  const auto& cloud = boundary_.cloud;
  frame.resultants = plate::resultants(state, families_, shapes, cloud.areas, cloud.plate_points, start.section());
  frame.damage.assign(cloud.plate_points, 0);
  const auto weight = [&](const geometry::Families& of, std::size_t k) {
    double sum = 0;
    for (const auto& bond : of[k]) sum += shapes[bond.vector_id].weight;
    return sum;
  };
  for (std::size_t k = 0; k < frame.damage.size(); ++k)
    if (families_[k].size() < first[k].size()) frame.damage[k] = 1 - weight(families_, k) / weight(first, k);
  return plate::mesh(boundary_, start.problem().outline, cracks, start.cut(), start.section().thickness);
}

}  // namespace fracture
