#include "plate/surface/edges.hpp"

#include <fmt/format.h>

#include "plate/model/faults/held.hpp"
#include "plate/model/refused.hpp"

namespace plate {

namespace {

std::array<bool, 3> held_on_edge(SupportKind kind, std::size_t number) {
  if (is_layer(kind) || kind == SupportKind::pinned)
    throw Refused({{Subject::support, number, "surface nodes hold edges, not layers and not single points"}});
  const auto held = held_by(kind);
  return {held.w, held.normal, held.tangential};
}

}  // namespace

EdgeCondition edge_condition(SupportKind kind, const EdgeAction& a, std::size_t number) {
  EdgeCondition result{held_on_edge(kind, number), {}};
  const std::optional<double> forces[] = {a.shear, a.moment, a.twisting_moment},
                              values[] = {a.deflection, a.normal_rotation, a.tangential_rotation};
  const char* const names[][2] = {
      {"shear", "deflection"}, {"moment", "normal rotation"}, {"twisting moment", "tangential rotation"}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [force, value] = names[i];
    if (result.held[i] && forces[i])
      throw Refused({{Subject::load_edges, number,
                      fmt::format("a {} acts on an edge whose {} is held: it would do nothing", force, value)}});
    if (!result.held[i] && values[i])
      throw Refused(
          {{Subject::support, number, fmt::format("a {} is given for an edge that does not hold it", value)}});
    result.value[i] = (result.held[i] ? values[i] : forces[i]).value_or(0);
  }
  return result;
}

int normal_rotation(int axis) {
  return axis == 0 ? 2 : 1;
}

int tangential_rotation(int axis) {
  return axis == 0 ? 1 : 2;
}

Eigen::Vector3d rotated(const Eigen::Vector3d& v, const geometry::Point& n) {
  const geometry::Point psi = v[1] * n + v[2] * geometry::Point(-n.y(), n.x());
  return {v[0], psi.y(), -psi.x()};
}

Eigen::Vector3d conjugate(const Eigen::Vector3d& f, const geometry::Point& n) {
  const geometry::Point moment = f[1] * n + f[2] * geometry::Point(-n.y(), n.x());
  return {f[0], -moment.y(), moment.x()};
}

}  // namespace plate
