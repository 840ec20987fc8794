#include "post/files/files.hpp"
#include "post/files/hdf5/state_file.hpp"

namespace post {

StateFile::StateFile(std::filesystem::path path, const Mesh& mesh, const std::string& resolved_case,
                     const std::string& version)
    : open_(files().open(std::move(path), mesh, resolved_case, version)) {}

StateFile::~StateFile() = default;
StateFile::StateFile(StateFile&&) noexcept = default;

void StateFile::write(const Frame& frame, const plate::State* velocity) {
  open_->write(frame, velocity);
}

void StateFile::write(const std::string& name, const Table& table) {
  open_->write(name, table);
}

void StateFile::close() {
  if (open_) open_->close();
}

StoredRun read_run(const std::filesystem::path& path) {
  return files().read_run(path);
}

}  // namespace post
