#include "post/files/files.hpp"
#include "post/files/hdf5/state_file.hpp"

namespace post {

StateFile::StateFile(Options options, const Mesh& mesh) : open_(files().open(std::move(options), mesh)) {}

StateFile::~StateFile() = default;
StateFile::StateFile(StateFile&&) noexcept = default;

void StateFile::go_on(std::size_t frames) {
  open_->go_on(frames);
}

void StateFile::part() {
  open_->part();
}

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
