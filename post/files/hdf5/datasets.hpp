#pragma once
#include <limits>
#include <stdexcept>

#include "post/files/hdf5/hdf5_id.hpp"
#include "post/files/hdf5/in_parts.hpp"
#include "post/files/table.hpp"

/// What state.h5 is made of. For the sources of this folder alone.
namespace post::hdf5 {

constexpr auto missing = std::numeric_limits<double>::quiet_NaN();

/// The attributes of a dataset.
struct Meaning {
  std::string unit, description;
};

Id string_type();
void write_attribute(hid_t object, const std::string& name, hid_t type, const void* value);
void write_attribute(hid_t object, const std::string& name, const std::string& text);

Id new_group(hid_t parent, const std::string& name);
void write_whole_dataset(hid_t parent, const std::string& name, hid_t type, const Sizes& sizes, const void* values,
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
  /// One that is there.
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
  void stretch(std::size_t length);
  void append_chunk(const Series& other, std::size_t index, hsize_t first, std::vector<char>& chunk);

  std::string name_;
  Sizes sizes_, chunks_;
  Id dataset_;
};

}  // namespace post::hdf5
