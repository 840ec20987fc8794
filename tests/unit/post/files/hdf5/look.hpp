#pragma once
#include <hdf5.h>

#include <filesystem>

#include "tests/catch.hpp"

namespace hdf5_look {

/// A file opened for a look by other means than the code under test.
class Look {
public:
  explicit Look(const std::filesystem::path& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    REQUIRE(file_ >= 0);
  }
  ~Look() { H5Fclose(file_); }

  std::string text_attribute(const char* object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0) return "no attribute";
    const hid_t type = H5Aget_type(attribute);
    char* text = nullptr;
    H5Aread(attribute, type, static_cast<void*>(&text));
    std::string result(text);
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    return result;
  }

  std::vector<double> numbers(const char* name) const {
    return read<double>(name, [](hid_t) { return H5T_NATIVE_DOUBLE; });
  }

  std::vector<std::string> words(const char* name) const {
    const auto pointers = read<char*>(name, [](hid_t dataset) { return H5Dget_type(dataset); });
    std::vector<std::string> result(pointers.begin(), pointers.end());
    for (char* pointer : pointers) H5free_memory(pointer);
    return result;
  }

  std::vector<std::string> datasets() const {
    std::vector<std::string> names;
    // HDF5 1.10 and 1.14 have this call alike; H5Ovisit has one argument more in the second
    const auto add = [](hid_t group, const char* name, const H5L_info_t*, void* target) -> herr_t {
      const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
      if (H5Iget_type(object) == H5I_DATASET) static_cast<std::vector<std::string>*>(target)->push_back(name);
      return H5Oclose(object);
    };
    H5Lvisit(file_, H5_INDEX_NAME, H5_ITER_INC, add, &names);
    return names;
  }

private:
  template <typename Value, typename TypeOf>
  std::vector<Value> read(const char* name, const TypeOf& type_of) const {
    const hid_t dataset = H5Dopen2(file_, name, H5P_DEFAULT);
    REQUIRE(dataset >= 0);
    const hid_t space = H5Dget_space(dataset);
    std::vector<Value> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    CHECK(H5Dread(dataset, type_of(dataset), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    H5Sclose(space);
    H5Dclose(dataset);
    return values;
  }

  hid_t file_;
};

}  // namespace hdf5_look
