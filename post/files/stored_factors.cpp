#include "post/files/stored_factors.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/gate.hpp"
#include "post/files/hdf5/state_file.hpp"

namespace post {

Table stored_factors(const StoredRun& run, const plate::Formulation& plate, const SrifOptions& options,
                     const std::vector<TipMethods>& methods) {
  const auto& cloud = plate.cloud();
  if (run.positions.size() != cloud.plate_points)
    throw std::runtime_error("state.h5 does not belong to case.resolved.toml");
  Table table{srif_columns(), {}};
  plate::State state = plate::State::Zero(3, Eigen::Index(cloud.size()));
  for (std::size_t frame = 0; frame < run.times.size(); ++frame) {
    state.leftCols(Eigen::Index(cloud.plate_points)) = run.states[frame];
    plate.constraints().impose(state);
    const auto found = srifs(plate, options, methods, state);
    require_finite(found, fmt::format("at time {:g}", run.times[frame]));
    append(table, run.times[frame], found);
  }
  return table;
}

}  // namespace post
