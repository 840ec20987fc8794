#include "post/files/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "post/files/run_folder.hpp"

namespace post {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();  // what is still in the buffer meets a full disk only here
  if (!file) cannot_write(path, errno);
}

}  // namespace

void cannot_write(const fs::path& path, int error) {
  throw fs::filesystem_error("cannot write", path, std::error_code(error != 0 ? error : EIO, std::generic_category()));
}

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  fs::path beside = path;
  beside += ".partial";
  const OpenedFolder folder(path.parent_path());  // it may get another name meanwhile
  folder.remove(beside);                          // it may be a link to what is somebody's
  try {
    write(beside);
    fs::rename(beside, path);
  } catch (...) {
    folder.remove(beside);
    throw;
  }
}

void write_atomically(const fs::path& path, const std::string& text) {
  write_atomically(path, [&](const fs::path& beside) { write_text(beside, text); });
}

void wait_for_disk(const fs::path& path) {
  const int opened = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  bool synced = false;
  do synced = opened >= 0 && fsync(opened) == 0;
  while (!synced && opened >= 0 && errno == EINTR);
  const int error = errno;
  if (opened >= 0) close(opened);
  // EINVAL: a file system without anything to wait for
  if (!synced && error != EINVAL) cannot_write(path, error);
}

std::string read_text(const std::filesystem::path& path, std::size_t most) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text, piece(1 << 16, ' ');
  while (file.read(piece.data(), std::streamsize(piece.size())) || file.gcount() > 0) {
    text.append(piece, 0, std::size_t(file.gcount()));
    if (text.size() > most) throw std::length_error("has more than " + std::to_string(most) + " bytes");
  }
  if (!file.is_open() || file.bad()) {
    throw std::filesystem::filesystem_error("cannot read", path, std::error_code(errno, std::generic_category()));
  }
  return text;
}

}  // namespace post
