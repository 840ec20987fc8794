#include <stdexcept>

#include "post/files/files.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/whole_file.hpp"

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
  auto run = files().read_run(path);
  const auto beside = path.parent_path() / "case.resolved.toml";
  if (std::filesystem::exists(beside) && read_text(beside) != run.resolved_case)
    throw std::runtime_error(path.string() + " is of another case than case.resolved.toml beside it");
  return run;
}

}  // namespace post
