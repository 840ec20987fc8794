#pragma once
#include "post/files/hdf5/state_file.hpp"

namespace post {

/// What needs HDF5. It is a library of its own, loaded where state.h5 is first written or read: the system maps the
/// libraries behind HDF5 in as long a time as a small plate takes to be solved.
struct Files {
  std::unique_ptr<StateFile::Open> (*open)(StateFile::Options options, const StateFile::Points& points);
  StoredRun (*read_run)(const std::filesystem::path& path);
};

/// Throws std::runtime_error where the library is not beside the program.
const Files& files();

}  // namespace post
