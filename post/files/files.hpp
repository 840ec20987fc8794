#pragma once
#include "post/files/hdf5/state_file.hpp"
#include "post/files/vtk/series.hpp"

namespace post {

/// What needs VTK or HDF5. It is a library of its own, loaded where the first of its files is written or read: the
/// system maps the fifty libraries behind it in 20 ms, as long as a small plate takes to be solved.
struct Files {
  std::string (*vtu)(const Mesh& mesh, const Frame& frame);  // the text of a file for ParaView
  std::string (*vtp)(const Cracks& cracks);
  Drawn (*read_vtu)(const std::filesystem::path& path);
  std::unique_ptr<StateFile::Open> (*open)(StateFile::Options options, const StateFile::Points& points);
  StoredRun (*read_run)(const std::filesystem::path& path);
};

/// Throws std::runtime_error where the library is not beside the program.
const Files& files();

}  // namespace post
