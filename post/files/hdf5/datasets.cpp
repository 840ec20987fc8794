#include "post/files/hdf5/datasets.hpp"

#include <algorithm>

namespace post::hdf5 {
namespace {

Id scalar() {
  return Id(H5Screate(H5S_SCALAR), H5Sclose, "scalar");
}

Id space_of(const Sizes& sizes, const hsize_t* limits = nullptr) {
  return Id(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), limits), H5Sclose, "data space");
}

Id new_dataset(hid_t parent, const std::string& name, hid_t type, hid_t space, const Meaning& meaning,
               hid_t properties = H5P_DEFAULT) {
  Id dataset(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, name);
  write_attribute(dataset, "unit", meaning.unit);
  write_attribute(dataset, "description", meaning.description);
  return dataset;
}

/// Creation properties of a dataset in chunks, each with a checksum: what is damaged cannot be read.
Id in_chunks(const Sizes& chunks, const std::string& name) {
  Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  checked(H5Pset_chunk(properties, static_cast<int>(chunks.size()), chunks.data()), name);
  checked(H5Pset_shuffle(properties), name);
  checked(H5Pset_deflate(properties, 1), name);
  checked(H5Pset_fletcher32(properties), name);
  return properties;
}

/// A part of a dataset, which begins at `start`.
void write_part(hid_t dataset, const Sizes& start, const Sizes& count, const double* values, const std::string& name) {
  const Id target(H5Dget_space(dataset), H5Sclose, name);
  checked(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), name);
  checked(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, space_of(count), target, H5P_DEFAULT, values), name);
}

}  // namespace

Id string_type() {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "string type");
  checked(H5Tset_size(type, H5T_VARIABLE), "string type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "string type");
  return type;
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

void write_dataset_at_once(hid_t parent, const std::string& name, hid_t type, const Sizes& sizes, const void* values,
                           const Meaning& meaning) {
  Id dataset = new_dataset(parent, name, type, space_of(sizes), meaning);
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  checked(dataset.release(), name);  // small ones are written here; a file that is closed knows nothing of what failed
}

void write_dataset_in_parts(hid_t parent, const std::string& name, const Sizes& sizes, const InParts& values,
                            const Meaning& meaning) {
  Sizes chunks = sizes;
  chunks.front() = std::min(chunks.front(), hsize_t(points_at_once));
  const Id properties = chunks.front() > 0 ? in_chunks(chunks, name) : Id();
  Id dataset = new_dataset(parent, name, H5T_NATIVE_DOUBLE, space_of(sizes), meaning,
                           chunks.front() > 0 ? hid_t(properties) : H5P_DEFAULT);
  for_each_part(std::size_t(sizes.front()), [&](std::size_t first, std::size_t count) {
    Sizes start(sizes.size(), 0), counts = sizes;
    start.front() = first, counts.front() = count;
    write_part(dataset, start, counts, values(first, count).data(), name);
  });
  checked(dataset.release(), name);
}

Series::Series(hid_t parent, const std::string& name, Sizes sizes, hsize_t chunk, const Meaning& meaning)
    : name_(name), sizes_(std::move(sizes)) {
  sizes_.insert(sizes_.begin(), 0);
  Sizes limits = sizes_;
  limits.front() = H5S_UNLIMITED;
  chunks_ = sizes_, chunks_.front() = chunk;
  if (chunks_.size() > 1) chunks_[1] = std::min(chunks_[1], hsize_t(points_at_once));
  const Id properties = in_chunks(chunks_, name);
  checked(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &missing), name);
  dataset_ = new_dataset(parent, name, H5T_IEEE_F64LE, space_of(sizes_, limits.data()), meaning, properties);
}

Series::Series(hid_t parent, const std::string& name)
    : name_(name), dataset_(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, name) {
  const Id space(H5Dget_space(dataset_), H5Sclose, name);
  sizes_.resize(std::size_t(checked(H5Sget_simple_extent_ndims(space), name)));
  checked(H5Sget_simple_extent_dims(space, sizes_.data(), nullptr), name);
  if (sizes_.empty()) throw std::runtime_error("state.h5: " + name + " has no entries");
  const Id properties(H5Dget_create_plist(dataset_), H5Pclose, name);
  chunks_.resize(sizes_.size());
  checked(H5Pget_chunk(properties, static_cast<int>(chunks_.size()), chunks_.data()), name);
}

void Series::extend(std::size_t length) {
  sizes_.front() = length;
  checked(H5Dset_extent(dataset_, sizes_.data()), name_);
}

void Series::keep(std::size_t count) {
  if (count < length()) extend(count);
}

void Series::write(std::size_t index, double value) {
  if (index >= length()) extend(index + 1);
  write_part(dataset_, {index}, {1}, &value, name_);
}

void Series::write(std::size_t index, const InParts& values) {
  if (index >= length()) extend(index + 1);
  for_each_part(std::size_t(sizes_.at(1)), [&](std::size_t first, std::size_t count) {
    Sizes start(sizes_.size(), 0), counts = sizes_;
    start[0] = index, start[1] = first, counts[0] = 1, counts[1] = count;
    write_part(dataset_, start, counts, values(first, count).data(), name_);
  });
}

void Series::append(const Series& other, std::size_t count) {
  if (sizes_.size() == 1) {
    std::vector<double> values(other.length());
    checked(H5Dread(other.dataset_, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name_);
    for (std::size_t i = 0; i < count; ++i) write(length(), values[i]);
    return;
  }
  if (chunks_ != other.chunks_) throw std::runtime_error("state.h5: " + name_ + " is not stored alike in its parts");
  std::vector<char> chunk;
  for (std::size_t i = 0; i < count; ++i) {
    extend(length() + 1);
    for (hsize_t first = 0; first < sizes_[1]; first += chunks_[1]) append_chunk(other, i, first, chunk);
  }
}

/// Copies the chunk of entry `index` of `other` from point `first` on into the last entry here, as it is stored;
/// `chunk`: buffer.
void Series::append_chunk(const Series& other, std::size_t index, hsize_t first, std::vector<char>& chunk) {
  Sizes from(sizes_.size(), 0), to(sizes_.size(), 0);
  from[0] = index, to[0] = length() - 1;
  from[1] = to[1] = first;
  hsize_t bytes = 0;
  std::uint32_t filters = 0;
  checked(H5Dget_chunk_storage_size(other.dataset_, from.data(), &bytes), name_);
  chunk.resize(bytes);
  checked(H5Dread_chunk(other.dataset_, H5P_DEFAULT, from.data(), &filters, chunk.data()), name_);
  checked(H5Dwrite_chunk(dataset_, H5P_DEFAULT, filters, to.data(), bytes, chunk.data()), name_);
}

}  // namespace post::hdf5
