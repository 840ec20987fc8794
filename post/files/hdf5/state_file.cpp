#include "post/files/hdf5/state_file.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>

#include "post/files/hdf5/datasets.hpp"

namespace post {
namespace {

using hdf5::checked, hdf5::Id, hdf5::new_group, hdf5::Series, hdf5::write_attribute, hdf5::write_whole_dataset;

/// Throws where the disk has no room for so many bytes. HDF5 cannot recover from a disk that is full in mid-write: the
/// frames before would be lost too.
void require_space(const std::filesystem::path& path, std::size_t bytes) {
  constexpr std::size_t reserve = 1 << 20;  // [bytes] for what HDF5 still holds back
  std::error_code unknown;
  const auto space = std::filesystem::space(path, unknown);
  if (unknown || space.available >= bytes + reserve) return;
  throw std::filesystem::filesystem_error("cannot write", path, std::make_error_code(std::errc::no_space_on_device));
}

void write_points(hid_t file, const Mesh& mesh) {
  const hsize_t count = mesh.positions.size();
  if (mesh.areas.size() != count || mesh.cut.size() != count) {
    throw std::invalid_argument("state.h5: areas or cut do not fit the positions");
  }
  const Id points = new_group(file, "points");
  write_whole_dataset(points, "position", H5T_NATIVE_DOUBLE, {count, 2}, mesh.positions.data(),
                      {"length", "x, y of every point"});
  write_whole_dataset(points, "area", H5T_NATIVE_DOUBLE, {count}, mesh.areas.data(),
                      {"length^2", "area of the plate that the point stands for"});
  write_whole_dataset(points, "cut", H5T_NATIVE_DOUBLE, {count}, mesh.cut.data(),
                      {"1", "share of the full family severed by cracks and edges"});
}

/// Point by point, as the file has it.
Eigen::Matrix3Xd by_points(const plate::State& state) {
  return state;
}

/// How a file is opened for writing. Frames are written so that whoever reads it finds the last one whole, also where
/// the process is killed in mid-write (single writer, multiple readers); that takes HDF5 1.10 or later.
Id access() {
  Id list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
  checked(H5Pset_libver_bounds(list, H5F_LIBVER_V110, H5F_LIBVER_LATEST), "access");
  return list;
}

/// ... of which the process was killed: it is marked as open still. Both properties are those of h5clear.
Id access_of_killed() {
  auto list = access();
  constexpr hbool_t yes = true;
  for (const char* name : {"clear_status_flags", "skip_eof_check"}) checked(H5Pset(list, name, &yes), name);
  return list;
}

/// A file that is removed at the end, however that comes about: what has not been renamed by then is no good.
struct Partial : std::filesystem::path {
  explicit Partial(path of) : path(std::move(of += ".partial")) {}
  Partial(const Partial&) = delete;
  ~Partial() { remove(); }

  void remove() const {
    std::error_code ignored;
    std::filesystem::remove(*this, ignored);
  }
};

/// state.h5 while it is written, as state.h5.partial.
class OpenStateFile : public StateFile::Open {
public:
  OpenStateFile(StateFile::Options options, const Mesh& mesh)
      : options_(std::move(options)), partial_(options_.path), points_(mesh.positions.size()) {
    hdf5::keep_quiet();
    if (options_.goes_on)
      reopen();
    else
      create(mesh);
  }

  ~OpenStateFile() override {
    if (frames_ > 0) try {
        close();  // the frames up to a failure are worth keeping
      } catch (...) {
      }
  }

  void go_on(std::size_t frames) override;
  void write(const Frame& frame, const plate::State* velocity) override;
  void write(const std::string& name, const Table& table) override;

  void close() override {
    if (closed_) return;
    closed_ = true;
    release();
    std::filesystem::rename(partial_, options_.path);
  }

private:
  void create(const Mesh& mesh);
  void reopen();
  /// From here on the file is whole at any time, and has no further datasets.
  void start_frames() { checked(H5Fstart_swmr_write(file_), partial_); }

  void release() {
    for (Series* series : {&state_, &velocity_, &step_, &time_}) checked(series->release(), "closing");
    for (Id* id : {&group_, &file_}) checked(id->release(), "closing");
  }

  StateFile::Options options_;
  Partial partial_;
  hsize_t points_ = 0;
  std::size_t frames_ = 0;
  bool closed_ = false, frames_end_ = false;
  Id file_, group_;
  Series state_, velocity_, step_, time_;
};

void OpenStateFile::create(const Mesh& mesh) {
  partial_.remove();  // it may be a link to what is somebody's
  file_ = Id(H5Fcreate(partial_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access()), H5Fclose, partial_);
  write_attribute(file_, "program", "PDPlate");
  write_attribute(file_, "version", options_.version);
  write_attribute(file_, "case", options_.resolved_case);
  write_attribute(file_, "format_version", H5T_NATIVE_INT, &hdf5::format_version);
  write_points(file_, mesh);
  new_group(file_, "tables");
  group_ = new_group(file_, "frames");
  constexpr hsize_t instants = 256;  // stored together
  state_ = Series(group_, "state", {points_, 3}, 1, {"length, 1, 1", "w, theta_x, theta_y of every point"});
  step_ = Series(group_, "step", {}, instants, {"1", "number of the time step or iteration"});
  time_ = Series(group_, "time", {}, instants, {"time", "time of the frame"});
  if (options_.velocities)
    velocity_ =
        Series(group_, "velocity", {points_, 3}, 1, {"length/time, 1/time, 1/time", "rates of w, theta_x, theta_y"});
  start_frames();
}

/// The file of a run that was killed, or of one that was asked to end and has written all that it had.
void OpenStateFile::reopen() {
  if (!std::filesystem::exists(partial_)) std::filesystem::rename(options_.path, partial_);
  file_ = Id(H5Fopen(partial_.c_str(), H5F_ACC_RDWR, access_of_killed()), H5Fclose, partial_);
}

void OpenStateFile::go_on(std::size_t frames) {
  group_ = Id(H5Gopen2(file_, "frames", H5P_DEFAULT), H5Gclose, partial_);
  state_ = Series(group_, "state", frames), step_ = Series(group_, "step", frames);
  time_ = Series(group_, "time", frames);
  if (options_.velocities) velocity_ = Series(group_, "velocity", frames);
  frames_ = frames;
  start_frames();
}

void OpenStateFile::write(const Frame& frame, const plate::State* velocity) {
  const auto fits = [&](const plate::State& state) { return static_cast<hsize_t>(state.cols()) == points_; };
  if (!fits(frame.state) || (velocity && !fits(*velocity))) {
    throw std::invalid_argument(fmt::format("{}: a frame does not have {} points", options_.path.string(), points_));
  }
  require_space(partial_, 2 * 3 * sizeof(double) * points_);
  state_.write(frames_, by_points(frame.state).data());
  if (velocity) velocity_.write(frames_, by_points(*velocity).data());
  const auto step = static_cast<double>(frame.step);
  step_.write(frames_, &step);
  time_.write(frames_, &frame.time);
  ++frames_;
}

/// Ends the frames: tables are further datasets.
void OpenStateFile::write(const std::string& name, const Table& table) {
  constexpr std::size_t bytes_per_cell = 32;  // a word of a few letters
  require_space(partial_, bytes_per_cell * table.rows.size() * table.columns.size());
  if (!std::exchange(frames_end_, true)) {
    release();
    file_ = Id(H5Fopen(partial_.c_str(), H5F_ACC_RDWR, access()), H5Fclose, partial_);
  }
  const Id tables(H5Gopen2(file_, "tables", H5P_DEFAULT), H5Gclose, partial_);
  write_table(tables, name, table);
}

}  // namespace

std::unique_ptr<StateFile::Open> open_state_file(StateFile::Options options, const Mesh& mesh) {
  return std::make_unique<OpenStateFile>(std::move(options), mesh);
}

}  // namespace post
