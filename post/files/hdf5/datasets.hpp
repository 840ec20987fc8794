#pragma once
#include <fmt/format.h>
#include <hdf5.h>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "post/files/hdf5/state_file.hpp"
#include "post/files/table.hpp"

/// Functions and types that writing and reading state.h5 share. Only for the sources of this folder: no others have
/// HDF5 on the include path.
namespace post::hdf5 {

constexpr int format_version = 1;
using Sizes = std::vector<hsize_t>;

/// The innermost message of HDF5's error stack: "file write failed: ... No space left on device".
inline std::string message() {
  std::string text = "unknown error";
  const auto keep = [](unsigned depth, const H5E_error2_t* error, void* target) -> herr_t {
    if (depth == 0) *static_cast<std::string*>(target) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep, &text);
  // "file write failed: time = ..., error message = 'File too large', buf = ..."
  constexpr std::string_view system = "error message = '";
  const auto begin = text.find(system);
  if (begin == std::string::npos) return text;
  return text.substr(begin + system.size(), text.find('\'', begin + system.size()) - begin - system.size());
}

/// Passes on what a call of HDF5 returned; throws where that says failure.
template <typename Result>
Result checked(Result result, const std::string& what) {
  if (result >= 0) return result;
  throw std::filesystem::filesystem_error(fmt::format("HDF5, {}: {}", what, message()),
                                          std::make_error_code(std::errc::io_error));
}

/// Leaves the reporting, of the calling thread, and the closing to us: at exit HDF5 would print, and crash over a file
/// that it could not close.
inline void keep_quiet() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// An identifier of HDF5 that closes itself.
class Id {
public:
  using Close = herr_t (*)(hid_t);
  Id() = default;
  Id(hid_t id, Close close, const std::string& what) : id_(checked(id, what)), close_(close) {}
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Id& operator=(Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Id() { release(); }

  operator hid_t() const { return id_; }
  herr_t release() { return id_ < 0 ? 0 : close_(std::exchange(id_, H5I_INVALID_HID)); }

private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

// Groups, datasets and attributes of state.h5

constexpr auto missing = std::numeric_limits<double>::quiet_NaN();

/// The attributes of a dataset.
struct Meaning {
  std::string unit, description;
};

Id string_type();
void write_attribute(hid_t object, const std::string& name, hid_t type, const void* value);
void write_attribute(hid_t object, const std::string& name, const std::string& text);

Id new_group(hid_t parent, const std::string& name);
void write_dataset_at_once(hid_t parent, const std::string& name, hid_t type, const Sizes& sizes, const void* values,
                           const Meaning& meaning);
/// Numbers of points, the first of `sizes`.
void write_dataset_in_parts(hid_t parent, const std::string& name, const Sizes& sizes, const InParts& values,
                            const Meaning& meaning);
/// A group with a dataset per column, in place of one of this name.
void write_table(hid_t parent, const std::string& name, const Table& table);

/// A dataset that grows along its first index.
class Series {
public:
  Series() = default;
  /// `sizes` of one entry; `chunk` entries are stored together, of points as many as come at once.
  Series(hid_t parent, const std::string& name, Sizes sizes, hsize_t chunk, const Meaning& meaning);
  /// Opens an existing dataset.
  Series(hid_t parent, const std::string& name);

  bool exists() const { return dataset_ >= 0; }
  herr_t release() { return dataset_.release(); }
  std::size_t length() const { return std::size_t(sizes_.front()); }

  /// A number.
  void write(std::size_t index, double value);
  /// Numbers of points, the first of the sizes.
  void write(std::size_t index, const InParts& values);
  /// Drops all entries but the first ones.
  void keep(std::size_t count);
  /// Adds the first entries of another one like this, as they are stored where each is stored by itself.
  void append(const Series& other, std::size_t count);

private:
  void extend(std::size_t length);
  void append_chunk(const Series& other, std::size_t index, hsize_t first, std::vector<char>& chunk);

  std::string name_;
  Sizes sizes_, chunks_;
  Id dataset_;
};

}  // namespace post::hdf5
