#pragma once
#include "post/files/hdf5/state_file.hpp"

namespace post {

/// Functions that need HDF5, in a library that is loaded where state.h5 is first written or read: the system takes as
/// long to map the libraries behind HDF5 as a small plate takes to be solved.
struct Files {
  std::unique_ptr<StateFile::Open> (*open)(StateFile::Options options, const StateFile::Points& points);
  StoredRun (*read_run)(const std::filesystem::path& path);
};

/// Throws std::runtime_error where the library is not beside the program.
const Files& files();

}  // namespace post
