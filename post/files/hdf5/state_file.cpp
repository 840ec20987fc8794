#include "post/files/hdf5/state_file.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "plate/model/space.hpp"
#include "post/files/hdf5/datasets.hpp"
#include "post/files/run_folder.hpp"

namespace post {
namespace {

using hdf5::checked, hdf5::Id, hdf5::new_group, hdf5::Series, hdf5::write_attribute, hdf5::write_dataset_in_parts;

std::filesystem::filesystem_error gone(const std::filesystem::path& path) {
  return {"cannot go on after frames that are gone", path, std::make_error_code(std::errc::no_such_file_or_directory)};
}

/// Throws where the disk has no room for so many bytes. HDF5 cannot recover from a disk that is full in mid-write: the
/// frames before would be lost too.
void require_space(const std::filesystem::path& path, std::size_t bytes) {
  constexpr std::size_t reserve = 1 << 20;  // [bytes] for what HDF5 still holds back
  std::error_code unknown;
  const auto space = std::filesystem::space(path, unknown);
  if (unknown || space.available >= bytes + reserve) return;
  throw std::filesystem::filesystem_error("cannot write", path, std::make_error_code(std::errc::no_space_on_device));
}

void write_points(hid_t file, const StateFile::Points& of) {
  const hsize_t count = of.count;
  const Id points = new_group(file, "points");
  write_dataset_in_parts(points, "position", {count, 2}, of.positions, {"length", "x, y of every point"});
  write_dataset_in_parts(points, "area", {count}, of.areas,
                         {"length^2", "area of the plate that the point stands for"});
  write_dataset_in_parts(points, "cut", {count}, of.cut, {"1", "share of the full family severed by cracks and edges"});
}

/// Quantities of a point in a frame.
struct FieldOfFrames {
  const char* name;
  hsize_t width;  // numbers of a point
  InParts StateFile::Motion::*numbers;
  hdf5::Meaning meaning;
  bool StateFile::Options::*wanted = nullptr;  // none: always
};

const std::array<FieldOfFrames, 7>& fields_of_frames() {
  using Motion = StateFile::Motion;
  using Options = StateFile::Options;
  static const std::array<FieldOfFrames, 7> fields{
      {{"state", plate::unknowns_per_point, &Motion::state, {"length, 1, 1", "w, theta_x, theta_y of every point"}},
       {"velocity",
        plate::unknowns_per_point,
        &Motion::velocity,
        {"length/time, 1/time, 1/time", "rates of w, theta_x, theta_y"},
        &Options::velocities},
       {"moments", 3, &Motion::moments, {"force", "Mxx, Myy, Mxy of every point, per length"}},
       {"shear_forces", 2, &Motion::shear_forces, {"force/length", "Qx, Qy of every point, per length"}},
       {"von_mises", 1, &Motion::von_mises, {"force/length^2", "von Mises stress at the top face of every point"}},
       {"displacement", 2, &Motion::displacement, {"length", "u, v of every point"}, &Options::in_plane},
       {"membrane_forces",
        3,
        &Motion::membrane_forces,
        {"force/length", "Nxx, Nyy, Nxy of every point, per length"},
        &Options::in_plane}}};
  return fields;
}

/// Frames of a file that is being written: they grow one by one. A field that is not stored does not exist.
struct Frames {
  Id group;
  std::array<Series, 7> fields;
  Series step, time;

  Frames() = default;
  Frames(hid_t file, hsize_t points, const StateFile::Options& options) : group(new_group(file, "frames")) {
    constexpr hsize_t instants = 256;  // stored together
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto& [name, width, numbers, meaning, wanted] = fields_of_frames()[i];
      if (wanted && !(options.*wanted)) continue;
      fields[i] = Series(group, name, width > 1 ? hdf5::Sizes{points, width} : hdf5::Sizes{points}, 1, meaning);
    }
    step = Series(group, "step", {}, instants, {"1", "number of the time step or iteration"});
    time = Series(group, "time", {}, instants, {"time", "time of the frame"});
  }
  /// Opens the frames of an existing file.
  explicit Frames(hid_t file)
      : group(H5Gopen2(file, "frames", H5P_DEFAULT), H5Gclose, "frames"), step(group, "step"), time(group, "time") {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto* const name = fields_of_frames()[i].name;
      if (checked(H5Lexists(group, name, H5P_DEFAULT), name) > 0) fields[i] = Series(group, name);
    }
  }

  void write(std::size_t index, const StateFile::Motion& frame) {
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (const auto& numbers = frame.*fields_of_frames()[i].numbers) fields[i].write(index, numbers);
    step.write(index, static_cast<double>(frame.step));
    time.write(index, frame.time);
  }
  void keep(std::size_t count) {
    for (auto* series : all())
      if (series->exists()) series->keep(count);
  }
  /// The first so many of others.
  void append(Frames&& other, std::size_t count) {
    const auto mine = all(), others = other.all();
    for (std::size_t i = 0; i < mine.size(); ++i)
      if (mine[i]->exists()) mine[i]->append(*others[i], count);
  }
  void release() {
    for (auto* series : all()) checked(series->release(), "closing");
    checked(group.release(), "closing");
  }

private:
  std::vector<Series*> all() {
    std::vector<Series*> series{&step, &time};
    for (auto& field : fields) series.push_back(&field);
    return series;
  }
};

/// state.h5 while it is written: frames go to state.h5.0, and to a further file after each part(), which are put
/// together at the end. Where the end fails they stay for the checkpoint that knows of them, else nothing does.
class OpenStateFile : public StateFile::Open {
public:
  OpenStateFile(StateFile::Options options, const StateFile::Points& points)
      : options_(std::move(options)), folder_(options_.path.parent_path()), points_(points.count) {
    hdf5::keep_quiet();
    if (options_.goes_on) return;
    remove_files();  // some may be links to what is somebody's
    try {
      begin(points);
    } catch (...) {
      file_.release();
      remove_files();
      throw;
    }
  }

  ~OpenStateFile() override {
    try {
      if (frames() > 0) close();  // those up to a failure are worth keeping
    } catch (...) {               // the disk is full, say
      closed_ = false;
    }
    if (!closed_) drop();
  }

  void go_on(std::size_t frames) override;
  void part() override;
  void write(const StateFile::Motion& frame) override;
  void write(const std::string& name, const Table& table) override;
  void close() override;

private:
  std::filesystem::path part(std::size_t number) const { return beside(fmt::format(".{}", number)); }
  std::filesystem::path beside(const std::string& ending) const {
    auto path = options_.path;
    return path += ending;
  }
  static Id created(const std::filesystem::path& path) {
    return Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, path);
  }
  static Id opened(const std::filesystem::path& path, unsigned mode) {
    return Id(H5Fopen(path.c_str(), mode, H5P_DEFAULT), H5Fclose, path);
  }
  std::size_t frames() const { return std::accumulate(parts_.begin(), parts_.end(), in_part_); }
  void release() {
    series_.release();
    checked(file_.release(), "closing");
  }
  void begin(const StateFile::Points& points);
  void write_case(hid_t file) const;
  void remove_files() const;
  void remove_parts(std::size_t first) const;
  std::size_t last_part_of(std::size_t frames);
  std::size_t known_length(const std::filesystem::path& path);
  void shorten(const std::filesystem::path& path, std::size_t frames) const;
  void drop();
  void assemble();

  StateFile::Options options_;
  OpenedFolder folder_;
  hsize_t points_ = 0;
  std::vector<std::size_t> parts_;  // frames of those that are whole
  std::size_t in_part_ = 0;         // of the one that is open
  bool assembled_ = false, closed_ = false;
  Id file_;
  Frames series_;
};

void OpenStateFile::begin(const StateFile::Points& points) {
  file_ = created(part(0));
  write_attribute(file_, "program", "PDPlate");
  write_attribute(file_, "version", options_.version);
  write_case(file_);
  write_attribute(file_, "format_version", H5T_NATIVE_INT, &hdf5::format_version);
  write_points(file_, points);
  new_group(file_, "tables");
  series_ = Frames(file_, points_, options_);
}

/// Writes the case in the place of that of a shorter motion, from which this one may go on.
void OpenStateFile::write_case(hid_t file) const {
  if (checked(H5Aexists(file, "case"), "case") > 0) checked(H5Adelete(file, "case"), "case");
  write_attribute(file, "case", options_.resolved_case);
}

void OpenStateFile::remove_files() const {
  folder_.remove(beside(".partial"));
  remove_parts(0);
}

/// The last one first: what is left where the process is killed is found again.
void OpenStateFile::remove_parts(std::size_t first) const {
  std::size_t end = first;
  while (folder_.has(part(end))) ++end;
  while (end > first) folder_.remove(part(--end));
}

/// Removes incomplete files, unless another process may go on from them.
void OpenStateFile::drop() {
  const bool known = folder_.has("checkpoint") || folder_.has("checkpoint.before");
  if (!known && !options_.goes_on) return remove_files();
  folder_.remove(beside(".partial"));
  if (!parts_.empty() && in_part_ > 0) remove_parts(parts_.size());
}

/// A run that was asked to end has put its parts together.
void OpenStateFile::go_on(std::size_t frames) {
  hdf5::keep_quiet();
  std::error_code none;
  if (std::filesystem::exists(options_.path, none)) {
    remove_files();
    std::filesystem::rename(options_.path, part(0));
  }
  remove_parts(last_part_of(frames) + 1);
}

/// Frames of a part that a checkpoint knows of. A file that is not there is said as it is.
std::size_t OpenStateFile::known_length(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw gone(path);
  try {
    return Frames(opened(path, H5F_ACC_RDONLY)).time.length();
  } catch (const std::exception&) {
    throw std::runtime_error(
        fmt::format("{} is damaged: nothing can go on from it; run the case without --resume", options_.path.string()));
  }
}

/// Takes the parts with the first frames; all of them are whole, but what follows in the last one is dropped.
std::size_t OpenStateFile::last_part_of(std::size_t frames) {
  do {  // the first has the points, if no frame
    const auto path = part(parts_.size());
    const auto length = known_length(path);
    if (length > frames) shorten(path, frames);
    parts_.push_back(std::min(frames, length));
    frames -= parts_.back();
  } while (frames > 0);
  return parts_.size() - 1;
}

void OpenStateFile::shorten(const std::filesystem::path& path, std::size_t frames) const {
  const auto copy = beside(".partial");
  std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
  auto file = opened(copy, H5F_ACC_RDWR);
  Frames first(file);
  first.keep(frames);
  first.release();
  checked(file.release(), "closing");
  std::filesystem::rename(copy, path);
}

/// A checkpoint may name a part that has no frame yet: it is whole as well.
void OpenStateFile::part() {
  hdf5::keep_quiet();
  if (file_ < 0) return;
  release();
  parts_.push_back(std::exchange(in_part_, 0));
}

void OpenStateFile::write(const StateFile::Motion& frame) {
  hdf5::keep_quiet();
  if (frame.points != points_)
    throw std::invalid_argument(fmt::format("{}: a frame does not have {} points", options_.path.string(), points_));
  hsize_t numbers = 0;  // of a point
  for (const auto& field : fields_of_frames())
    if (frame.*field.numbers) numbers += field.width;
  require_space(options_.path, numbers * sizeof(double) * points_);
  if (file_ < 0) {
    file_ = created(part(parts_.size()));
    series_ = Frames(file_, points_, options_);
  }
  series_.write(in_part_, frame);
  checked(H5Fflush(file_, H5F_SCOPE_LOCAL), options_.path);
  ++in_part_;
}

/// Assembles all frames in state.h5.partial. Parts that a checkpoint may know of stay as they are.
void OpenStateFile::assemble() {
  assembled_ = true;
  const auto whole = beside(".partial");
  if (parts_.empty()) {
    release();
    std::filesystem::rename(part(0), whole);
    file_ = opened(whole, H5F_ACC_RDWR);
    return;
  }
  part();
  std::filesystem::copy_file(part(0), whole, std::filesystem::copy_options::overwrite_existing);
  file_ = opened(whole, H5F_ACC_RDWR);
  write_case(file_);
  Frames all(file_);
  all.keep(parts_.front());
  for (std::size_t i = 1; i < parts_.size(); ++i) all.append(Frames(opened(part(i), H5F_ACC_RDONLY)), parts_[i]);
  all.release();  // a file that is closed knows nothing of what failed when its datasets were
}

void OpenStateFile::write(const std::string& name, const Table& table) {
  hdf5::keep_quiet();
  constexpr std::size_t bytes_per_cell = 32;  // a word of a few letters
  require_space(options_.path, bytes_per_cell * table.rows.size() * table.columns.size());
  if (!assembled_) assemble();
  const Id tables(H5Gopen2(file_, "tables", H5P_DEFAULT), H5Gclose, options_.path);
  write_table(tables, name, table);
}

void OpenStateFile::close() {
  hdf5::keep_quiet();
  if (closed_) return;
  if (!assembled_) assemble();
  closed_ = true;
  try {
    checked(file_.release(), "closing");
    std::filesystem::rename(beside(".partial"), options_.path);
  } catch (...) {
    drop();
    throw;
  }
  remove_files();
}

}  // namespace

std::unique_ptr<StateFile::Open> open_state_file(StateFile::Options options, const StateFile::Points& points) {
  return std::make_unique<OpenStateFile>(std::move(options), points);
}

}  // namespace post
