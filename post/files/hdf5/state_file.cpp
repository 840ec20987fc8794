#include "post/files/hdf5/state_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "post/files/hdf5/hdf5_id.hpp"
#include "post/files/whole_file.hpp"

namespace post {
namespace {

using hdf5::checked, hdf5::Id, hdf5::Sizes;
constexpr auto missing = std::numeric_limits<double>::quiet_NaN();

/// Throws where the disk has no room for so many bytes. HDF5 cannot recover from a disk that is full in mid-write: the
/// frames before would be lost too.
void require_space(const std::filesystem::path& path, std::size_t bytes) {
  constexpr std::size_t reserve = 1 << 20;  // [bytes] for what HDF5 still holds back
  std::error_code unknown;
  const auto space = std::filesystem::space(path, unknown);
  if (unknown || space.available >= bytes + reserve) return;
  throw std::filesystem::filesystem_error("cannot write", path, std::make_error_code(std::errc::no_space_on_device));
}

/// The attributes of a dataset.
struct Meaning {
  std::string unit, description;
};

Id string_type() {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "string type");
  checked(H5Tset_size(type, H5T_VARIABLE), "string type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "string type");
  return type;
}

Id scalar() {
  return Id(H5Screate(H5S_SCALAR), H5Sclose, "scalar");
}

Id space_of(const Sizes& sizes, const hsize_t* limits = nullptr) {
  return Id(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), limits), H5Sclose, "data space");
}

void write_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Id attribute(H5Acreate2(object, name.c_str(), type, scalar(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  checked(H5Awrite(attribute, type, value), name);
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const char* characters = text.c_str();
  write_attribute(object, name, string_type(), &characters);
}

Id new_group(hid_t parent, const std::string& name) {
  return Id(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
}

Id new_dataset(hid_t parent, const std::string& name, hid_t type, hid_t space, const Meaning& meaning,
               hid_t properties = H5P_DEFAULT) {
  Id dataset(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, name);
  write_attribute(dataset, "unit", meaning.unit);
  write_attribute(dataset, "description", meaning.description);
  return dataset;
}

void write_whole_dataset(hid_t parent, const std::string& name, hid_t type, const Sizes& sizes, const void* values,
                         const Meaning& meaning) {
  const Id dataset = new_dataset(parent, name, type, space_of(sizes), meaning);
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
}

/// A dataset that grows along its first index; `sizes` of one entry, `chunk` entries stored together.
class Series {
public:
  Series() = default;
  Series(hid_t parent, const std::string& name, Sizes sizes, hsize_t chunk, const Meaning& meaning)
      : name_(name), sizes_(std::move(sizes)) {
    sizes_.insert(sizes_.begin(), 0);
    Sizes limits = sizes_, chunks = sizes_;
    limits.front() = H5S_UNLIMITED;
    chunks.front() = chunk;
    const Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
    checked(H5Pset_chunk(properties, static_cast<int>(chunks.size()), chunks.data()), name);
    checked(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &missing), name);
    checked(H5Pset_shuffle(properties), name);
    checked(H5Pset_deflate(properties, 1), name);
    dataset_ = new_dataset(parent, name, H5T_IEEE_F64LE, space_of(sizes_, limits.data()), meaning, properties);
  }

  bool exists() const { return dataset_ >= 0; }
  herr_t release() { return dataset_.release(); }

  void write(std::size_t index, const double* values) {
    sizes_.front() = index + 1;
    checked(H5Dset_extent(dataset_, sizes_.data()), name_);
    Sizes start(sizes_.size(), 0), count = sizes_;
    start.front() = index;
    count.front() = 1;
    const Id target(H5Dget_space(dataset_), H5Sclose, name_);
    checked(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), name_);
    checked(H5Dwrite(dataset_, H5T_NATIVE_DOUBLE, space_of(count), target, H5P_DEFAULT, values), name_);
  }

private:
  std::string name_;
  Sizes sizes_;
  Id dataset_;
};

/// What the columns of all tables hold, by their names; numbers without a unit have none.
Meaning meaning_of_column(const std::string& name) {
  static const std::map<std::string, Meaning> known{
      {"time", {"time", "time of the row"}},
      {"begin", {"time", "when the piece of crack began"}},
      {"x", {"length", "position"}},
      {"y", {"length", "position"}},
      {"w", {"length", "deflection"}},
      {"max_abs_w", {"length", "largest deflection"}},
      {"length", {"length", "of the whole crack"}},
      {"piece", {"length", "of the piece of crack"}},
      {"crack_length", {"length", "of all cracks"}},
      {"angle", {"degree", "from x"}},
      {"speed", {"length/time", "of the tip"}},
      {"frequency", {"1/time", "frequency"}},
      {"omega", {"1/time", "circular frequency"}},
      {"displacement", {"force length", "sum of loads at factor 1 times displacements"}},
      {"energy_residual", {"force length", "what the books do not account for"}},
      {"G", {"force", "energy release rate"}},
      {"K1", {"force length^(1/2)", "moment intensity factor, without pi"}},
      {"K2", {"force length^(1/2)", "moment intensity factor, without pi"}},
      {"K3", {"force length^(-1/2)", "shear force intensity factor, without pi"}},
      {"estimated_error_K1", {"force length^(1/2)", "estimated error"}},
      {"estimated_error_K2", {"force length^(1/2)", "estimated error"}},
      {"estimated_error_K3", {"force length^(-1/2)", "estimated error"}}};
  if (const auto found = known.find(name); found != known.end()) return found->second;
  if (name.starts_with("theta")) return {"1", "rotation"};
  if (name.ends_with("energy") || name.ends_with("work")) return {"force length", name};
  return {"1", name};
}

void write_column(hid_t group, const Table& table, std::size_t column) {
  const std::string& name = table.columns[column];
  const Sizes sizes{table.rows.size()};
  const auto is_word = [&](const auto& row) { return std::holds_alternative<std::string>(row.at(column)); };
  if (std::ranges::any_of(table.rows, is_word)) {
    std::vector<std::string> words;
    for (const auto& row : table.rows) words.push_back(is_word(row) ? std::get<std::string>(row[column]) : "");
    std::vector<const char*> pointers;
    for (const std::string& text : words) pointers.push_back(text.c_str());
    write_whole_dataset(group, name, string_type(), sizes, pointers.data(), meaning_of_column(name));
  } else {
    std::vector<double> values;
    for (const auto& row : table.rows) {
      const auto* value = std::get_if<double>(&row.at(column));
      values.push_back(value ? *value : missing);
    }
    write_whole_dataset(group, name, H5T_NATIVE_DOUBLE, sizes, values.data(), meaning_of_column(name));
  }
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

/// A file that is removed at the end, however that comes about: what has not been renamed by then is no good.
struct Partial : std::filesystem::path {
  explicit Partial(path of) : path(std::move(of += ".partial")) {}
  Partial(const Partial&) = delete;
  ~Partial() {
    std::error_code ignored;
    std::filesystem::remove(*this, ignored);
  }
};

/// state.h5 while it is written, as state.h5.partial.
class OpenStateFile : public StateFile::Open {
public:
  OpenStateFile(std::filesystem::path path, const Mesh& mesh, const std::string& resolved_case,
                const std::string& version)
      : path_(std::move(path)), partial_(path_), points_(mesh.positions.size()) {
    hdf5::keep_quiet();
    file_ = Id(H5Fcreate(partial_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, partial_);
    write_attribute(file_, "program", "PDPlate");
    write_attribute(file_, "version", version);
    write_attribute(file_, "case", resolved_case);
    write_attribute(file_, "format_version", H5T_NATIVE_INT, &hdf5::format_version);
    write_points(file_, mesh);
    tables_ = new_group(file_, "tables");
    group_ = new_group(file_, "frames");
    constexpr hsize_t instants = 256;  // stored together
    state_ = Series(group_, "state", {points_, 3}, 1, {"length, 1, 1", "w, theta_x, theta_y of every point"});
    step_ = Series(group_, "step", {}, instants, {"1", "number of the time step or iteration"});
    time_ = Series(group_, "time", {}, instants, {"time", "time of the frame"});
  }

  ~OpenStateFile() override {
    if (frames_ > 0) try {
        close();  // the frames up to a failure are worth keeping
      } catch (...) {
      }
  }

  void write(const Frame& frame, const plate::State* velocity) override;
  void write(const std::string& name, const Table& table) override;

  void close() override {
    if (closed_) return;
    closed_ = true;
    write_whole(path_, [&](const auto&) { release(); });
  }

private:
  void release() {
    for (Series* series : {&state_, &velocity_, &step_, &time_}) checked(series->release(), "closing");
    for (Id* id : {&group_, &tables_, &file_}) checked(id->release(), "closing");
  }

  std::filesystem::path path_;
  Partial partial_;
  hsize_t points_ = 0;
  std::size_t frames_ = 0;
  bool closed_ = false;
  Id file_, tables_, group_;
  Series state_, velocity_, step_, time_;
};

void OpenStateFile::write(const Frame& frame, const plate::State* velocity) {
  const auto fits = [&](const plate::State& state) { return static_cast<hsize_t>(state.cols()) == points_; };
  if (!fits(frame.state) || (velocity && !fits(*velocity))) {
    throw std::invalid_argument(fmt::format("{}: a frame does not have {} points", path_.string(), points_));
  }
  require_space(partial_, 2 * 3 * sizeof(double) * points_);
  state_.write(frames_, by_points(frame.state).data());
  if (velocity) {
    const Meaning meaning{"length/time, 1/time, 1/time", "rates of w, theta_x, theta_y"};
    if (!velocity_.exists()) velocity_ = Series(group_, "velocity", {points_, 3}, 1, meaning);
    velocity_.write(frames_, by_points(*velocity).data());
  }
  const auto step = static_cast<double>(frame.step);
  step_.write(frames_, &step);
  time_.write(frames_, &frame.time);
  checked(H5Fflush(file_, H5F_SCOPE_LOCAL), partial_);
  ++frames_;
}

void OpenStateFile::write(const std::string& name, const Table& table) {
  constexpr std::size_t bytes_per_cell = 32;  // a word of a few letters
  require_space(partial_, bytes_per_cell * table.rows.size() * table.columns.size());
  if (checked(H5Lexists(tables_, name.c_str(), H5P_DEFAULT), name) > 0) {
    checked(H5Ldelete(tables_, name.c_str(), H5P_DEFAULT), name);
  }
  const Id group = new_group(tables_, name);
  for (std::size_t column = 0; column < table.columns.size(); ++column) write_column(group, table, column);
}

}  // namespace

std::unique_ptr<StateFile::Open> open_state_file(std::filesystem::path path, const Mesh& mesh,
                                                 const std::string& resolved_case, const std::string& version) {
  return std::make_unique<OpenStateFile>(std::move(path), mesh, resolved_case, version);
}

}  // namespace post
