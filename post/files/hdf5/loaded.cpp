#include "post/files/hdf5/state_file.hpp"

#include <dlfcn.h>
#include <stdexcept>

#include "plate/model/communicator.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/point_order.hpp"

namespace post {
namespace {

const Files* loaded() {
  void* const library = dlopen("libpdplate_files.so", RTLD_NOW | RTLD_LOCAL);
  void* const found = library ? dlsym(library, "pdplate_files") : nullptr;
  if (!found) throw std::runtime_error(std::string("the part of the program that writes fields: ") + dlerror());
  return static_cast<const Files*>(found);
}

/// Throws std::runtime_error where the library is not beside the program.
const Files& files() {
  static const Files* const all = loaded();
  return *all;
}

}  // namespace

StateFile::StateFile(Options options, const Mesh& mesh, const plate::Communicator& communicator)
    : order_(std::make_unique<const PointOrder>(order_of(communicator, mesh))),
      own_(Eigen::Index(mesh.own.value_or(mesh.positions.size()))),
      others_follow_(mesh.own.has_value()),
      in_plane_(options.in_plane) {
  if (mesh.areas.size() != mesh.positions.size() || mesh.cut.size() != mesh.positions.size())
    throw std::invalid_argument("state.h5: areas or cut do not fit the positions");
  const auto one = [](const std::vector<double>& values) {
    return [&values](std::size_t k, double* to) { *to = values[k]; };
  };
  const auto place = [&](std::size_t k, double* to) { to[0] = mesh.positions[k].x(), to[1] = mesh.positions[k].y(); };
  const Points points{order_->points(), parts(2, place), parts(1, one(mesh.areas)), parts(1, one(mesh.cut))};
  const bool goes_on = options.goes_on;
  if (communicator.rank() == 0) {
    open_ = files().open(std::move(options), points);
  } else if (!goes_on) {  // what the first asks for
    for (const auto& field : {points.positions, points.areas, points.cut}) for_each_part(points.count, field);
  }
}

InParts StateFile::parts(std::size_t width, Numbers numbers) {
  return [this, width, numbers = std::move(numbers)](std::size_t first, std::size_t count) {
    room_ = order_->at_first(first, count, width, numbers);
    return std::span<const double>(room_);
  };
}

template <typename Rows>
InParts StateFile::parts(const Rows& rows) {
  return parts(std::size_t(rows.rows()), [&rows](std::size_t k, double* to) {
    for (Eigen::Index c = 0; c < rows.rows(); ++c) to[c] = rows(c, Eigen::Index(k));
  });
}

StateFile::~StateFile() = default;
StateFile::StateFile(StateFile&&) noexcept = default;

void StateFile::go_on(std::size_t frames) {
  if (open_) open_->go_on(frames);
}

void StateFile::part() {
  if (open_) open_->part();
}

void StateFile::write(const Frame& frame, const plate::State* velocity) {
  const auto& moments = frame.resultants.moments;
  const auto& shear = frame.resultants.shear;
  const auto& von_mises = frame.resultants.von_mises;
  const auto fits = [&](Eigen::Index columns) { return others_follow_ ? columns >= own_ : columns == own_; };
  if (!fits(frame.state.cols())) throw std::invalid_argument("state.h5: the state does not fit the points");
  if (velocity && !fits(velocity->cols())) throw std::invalid_argument("state.h5: the velocities do not fit the state");
  for (const auto columns : {moments.cols(), shear.cols(), von_mises.size()})
    if (columns != frame.state.cols()) throw std::invalid_argument("state.h5: the resultants do not fit the state");
  const auto* const in_plane = in_plane_ && frame.in_plane ? &*frame.in_plane : nullptr;
  if (in_plane_ && !(in_plane && in_plane->displacement.cols() == frame.state.cols() &&
                     in_plane->force.cols() == frame.state.cols()))
    throw std::invalid_argument("state.h5: the fields in the plane do not fit the state");
  const auto of_stress = von_mises.transpose();
  const Motion motion{.time = frame.time,
                      .step = frame.step,
                      .points = order_->points(),
                      .state = parts(frame.state),
                      .velocity = velocity ? parts(*velocity) : InParts(),
                      .moments = parts(moments),
                      .shear_forces = parts(shear),
                      .von_mises = parts(of_stress),
                      .displacement = in_plane ? parts(in_plane->displacement) : InParts(),
                      .membrane_forces = in_plane ? parts(in_plane->force) : InParts()};
  if (open_) return open_->write(motion);
  for (const auto* numbers : {&motion.state, &motion.velocity, &motion.moments, &motion.shear_forces, &motion.von_mises,
                              &motion.displacement, &motion.membrane_forces})
    if (*numbers) for_each_part(motion.points, *numbers);
}

void StateFile::write(const std::string& name, const Table& table) {
  if (open_) open_->write(name, table);
}

void StateFile::close() {
  if (open_) open_->close();
}

StoredRun read_run(const std::filesystem::path& path) {
  auto run = files().read_run(path);
  const auto beside = path.parent_path() / "case.resolved.toml";
  if (std::filesystem::exists(beside) && read_text(beside) != run.resolved_case)
    throw std::runtime_error(path.string() + " is of another case than case.resolved.toml beside it");
  return run;
}

}  // namespace post
