#include "post/files/hdf5/loaded.hpp"

#include <dlfcn.h>
#include <stdexcept>

#include "post/files/hdf5/state_file.hpp"
#include "post/files/whole_file.hpp"

namespace post {
namespace {

const Files* loaded() {
  void* const library = dlopen("libpdplate_files.so", RTLD_NOW | RTLD_LOCAL);
  void* const found = library ? dlsym(library, "pdplate_files") : nullptr;
  if (!found) throw std::runtime_error(std::string("the part of the program that writes fields: ") + dlerror());
  return static_cast<const Files*>(found);
}

}  // namespace

const Files& files() {
  static const Files* const all = loaded();
  return *all;
}

namespace {

/// Parts of a contiguous array that holds `width` values of every point.
InParts parts_of(const double* values, std::size_t width) {
  return [=](std::size_t first, std::size_t count) { return std::span(values + width * first, width * count); };
}

StateFile::Points points_of(const Mesh& mesh) {
  const auto count = mesh.positions.size();
  if (mesh.areas.size() != count || mesh.cut.size() != count)
    throw std::invalid_argument("state.h5: areas or cut do not fit the positions");
  return {count, parts_of(count > 0 ? mesh.positions.data()->data() : nullptr, 2), parts_of(mesh.areas.data(), 1),
          parts_of(mesh.cut.data(), 1)};
}

/// Point by point, as the file has it.
InParts parts_of(const plate::State& state, Eigen::Matrix3Xd& room) {
  return [&](std::size_t first, std::size_t count) {
    room = state.middleCols(Eigen::Index(first), Eigen::Index(count));
    return std::span<const double>(room.data(), 3 * count);
  };
}

}  // namespace

StateFile::StateFile(Options options, const Mesh& mesh) : StateFile(std::move(options), points_of(mesh)) {}

StateFile::StateFile(Options options, const Points& points) : open_(files().open(std::move(options), points)) {}

StateFile::~StateFile() = default;
StateFile::StateFile(StateFile&&) noexcept = default;

void StateFile::go_on(std::size_t frames) {
  open_->go_on(frames);
}

void StateFile::part() {
  open_->part();
}

void StateFile::write(const Frame& frame, const plate::State* velocity) {
  const auto points = std::size_t(frame.state.cols());
  if (velocity && velocity->cols() != frame.state.cols())
    throw std::invalid_argument("state.h5: the velocities do not fit the state");
  const auto& [moments, shear, von_mises] = frame.resultants;
  for (const auto columns : {moments.cols(), shear.cols(), von_mises.size()})
    if (columns != frame.state.cols()) throw std::invalid_argument("state.h5: the resultants do not fit the state");
  Eigen::Matrix3Xd room;
  open_->write({frame.time, frame.step, points, parts_of(frame.state, room),
                velocity ? parts_of(*velocity, room) : InParts(), parts_of(moments.data(), 3),
                parts_of(shear.data(), 2), parts_of(von_mises.data(), 1)});
}

void StateFile::write(const Motion& frame) {
  open_->write(frame);
}

void StateFile::write(const std::string& name, const Table& table) {
  open_->write(name, table);
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
