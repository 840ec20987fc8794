#include "post/files/hdf5/state_file.hpp"

/// The library's side of Files.
namespace post {

std::unique_ptr<StateFile::Open> open_state_file(StateFile::Options options, const StateFile::Points& points);
StoredRun read_state_file(const std::filesystem::path& path);

}  // namespace post

extern "C" [[gnu::visibility("default")]] const post::Files pdplate_files{post::open_state_file, post::read_state_file};
