#include "plate/model/state.hpp"
#include "post/files/hdf5/state_file.hpp"

#include <array>
#include <fstream>
#include <stdexcept>

#include "post/files/hdf5/datasets.hpp"

namespace post {
namespace {

using hdf5::checked, hdf5::Id, hdf5::Sizes;

/// A dataset of numbers and its sizes.
struct Numbers {
  std::string name;
  Id dataset, space;
  Sizes sizes;

  Numbers(hid_t file, const std::string& name_, std::size_t indices)
      : name(name_),
        dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name),
        space(H5Dget_space(dataset), H5Sclose, name),
        sizes(indices) {
    const int rank = checked(H5Sget_simple_extent_ndims(space), name);
    if (static_cast<std::size_t>(rank) != indices) {
      throw std::runtime_error(fmt::format("{} has {} indices, not {}", name, rank, indices));
    }
    checked(H5Sget_simple_extent_dims(space, sizes.data(), nullptr), name);
  }

  void read(double* values) const {
    checked(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  }

  /// The part with this first index.
  void read(hsize_t index, double* values) const {
    Sizes start(sizes.size(), 0), count = sizes;
    start.front() = index;
    count.front() = 1;
    checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), name);
    const Id part(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose, name);
    checked(H5Dread(dataset, H5T_NATIVE_DOUBLE, part, space, H5P_DEFAULT, values), name);
  }
};

void check_version(hid_t file) {
  const Id attribute(H5Aopen(file, "format_version", H5P_DEFAULT), H5Aclose, "format_version");
  int version = 0;
  checked(H5Aread(attribute, H5T_NATIVE_INT, &version), "format_version");
  if (version != hdf5::format_version) {
    throw std::runtime_error(fmt::format("format version {}; this program reads {}", version, hdf5::format_version));
  }
}

std::string text_attribute(hid_t file, const char* name) {
  const Id attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, name);
  const Id type(H5Aget_type(attribute), H5Tclose, name), space(H5Aget_space(attribute), H5Sclose, name);
  if (H5Tis_variable_str(type) <= 0) throw std::runtime_error(fmt::format("{} is no text", name));
  char* characters = nullptr;
  checked(H5Aread(attribute, type, &characters), name);
  std::string text = characters ? characters : "";
  checked(H5Dvlen_reclaim(type, space, H5P_DEFAULT, &characters), name);
  return text;
}

/// Checks the widths of addresses and lengths in the superblock: they are those of a file of 64 bits (HDF5 file format
/// specification, II.A). Over a damaged superblock HDF5 1.10 loses memory, or asks for gigabytes. HDF5 itself refuses
/// files that are too short or no HDF5 files.
void check_widths(const std::filesystem::path& path) {
  std::array<char, 16> head{};
  if (!std::ifstream(path, std::ios::binary).read(head.data(), head.size())) return;
  const int version = head[8];
  const std::size_t widths = version < 2 ? 13 : 9;
  if (version < 0 || version > 3 || head[widths] != 8 || head[widths + 1] != 8)
    throw std::runtime_error(path.string() + ": its head is damaged, or it is no file of HDF5");
}

/// Displacements u, v of every frame; none where a run has not stored any.
std::vector<Eigen::Matrix2Xd> read_displacements(hid_t file, hsize_t frames, hsize_t points) {
  constexpr const char* name = "/frames/displacement";
  if (checked(H5Lexists(file, name, H5P_DEFAULT), name) == 0) return {};
  const Numbers displacement(file, name, 3);
  if (displacement.sizes != Sizes{frames, points, 2})
    throw std::runtime_error("the displacements do not fit the points");
  std::vector<Eigen::Matrix2Xd> result(frames, Eigen::Matrix2Xd(2, points));
  for (hsize_t i = 0; i < frames; ++i) displacement.read(i, result[i].data());
  return result;
}

StoredRun read_frames(hid_t file) {
  check_version(file);
  const Numbers position(file, "/points/position", 2), time(file, "/frames/time", 1),
      state(file, "/frames/state", plate::unknowns_per_point);
  const hsize_t points = position.sizes[0], frames = time.sizes[0];
  if (position.sizes[1] != 2 || state.sizes != Sizes{frames, points, plate::unknowns_per_point}) {
    throw std::runtime_error("the frames do not fit the points");
  }
  StoredRun run{std::vector<Eigen::Vector2d>(points), std::vector<double>(frames),
                std::vector<plate::State>(frames, plate::State(plate::unknowns_per_point, points)),
                text_attribute(file, "case")};
  position.read(run.positions.data()->data());
  time.read(run.times.data());
  plate::StateByPoints by_points(plate::unknowns_per_point, points);
  for (hsize_t i = 0; i < frames; ++i) state.read(i, by_points.data()), run.states[i] = by_points;
  run.displacements = read_displacements(file, frames, points);
  return run;
}

}  // namespace

StoredRun read_state_file(const std::filesystem::path& path) {
  hdf5::keep_quiet();
  check_widths(path);
  const Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path);
  try {
    return read_frames(file);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace post
