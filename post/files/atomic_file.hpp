#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace post {

/// Writes `path` whole or not at all: `write` fills a file beside it, which is then renamed.
/// Throws std::filesystem::filesystem_error or std::runtime_error (disk full, no permission); nothing is left then.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);
void write_atomically(const std::filesystem::path& path, const std::string& text);

/// Throws std::filesystem::filesystem_error of a file that cannot be written. `error`: errno, or 0 where that is
/// unknown.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

/// Waits until a file, or the names in a folder, are on the disk. Throws std::filesystem::filesystem_error.
void wait_for_disk(const std::filesystem::path& path);

/// Reads all of a file. Throws std::filesystem::filesystem_error where it cannot be read, std::length_error where it
/// has more than `most` bytes: it may be a device without an end.
std::string read_text(const std::filesystem::path& path, std::size_t most = std::size_t(1) << 40);

}  // namespace post
