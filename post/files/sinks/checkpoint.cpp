#include "post/files/sinks/checkpoint.hpp"

#define XXH_INLINE_ALL
#define XXH_VECTOR 0  // scalar: gcc 12 warns of its own AVX-512 header
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <system_error>

#include "post/files/whole_file.hpp"

namespace post {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, Checkpoints::kept> names{"checkpoint", "checkpoint.before"};
constexpr const char* magic = "PDPlate checkpoint 3: ";  // the number of its form

[[noreturn]] void fail(const fs::path& path) {
  throw fs::filesystem_error("cannot write", path, std::error_code(errno != 0 ? errno : EIO, std::generic_category()));
}

constexpr std::size_t digits = 16;  // of the checksum, at the end

std::string checksum(std::string_view line, std::string_view memory) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  XXH3_64bits_reset(state.get());
  for (const auto part : {line, memory}) XXH3_64bits_update(state.get(), part.data(), part.size());
  return fmt::format("{:016x}", XXH3_64bits_digest(state.get()));
}

/// What is wrong with a checkpoint; empty: nothing.
std::string fault_of(std::string_view all, const std::string& of) {
  const auto line = all.find('\n');
  if (!all.starts_with(magic) || line == std::string_view::npos) return "is no checkpoint of this version";
  const auto before = all.substr(0, std::max(all.size(), digits) - digits);
  if (before.size() <= line || checksum(before, {}) != all.substr(before.size())) return "is damaged or not whole";
  if (const auto found = all.substr(0, line).substr(std::string_view(magic).size()); found != of)
    return fmt::format("is of another run: {}, not {}", found, of);
  return {};
}

std::string content_of(std::string text) {
  text.resize(text.size() - digits);
  text.erase(0, text.find('\n') + 1);
  return text;
}

}  // namespace

void Checkpoints::write(const std::string& memory) const {
  const auto newest = folder_ / names[0];
  write_whole(newest, [&](const fs::path& beside) {
    const auto line = magic + of_ + "\n";
    errno = 0;
    std::ofstream file(beside, std::ios::binary);
    file << line << memory << checksum(line, memory);
    file.close();  // what is still in the buffer meets a full disk only here
    if (!file) fail(beside);
    wait_for_disk(beside);
    std::error_code none;  // there is none before the second
    fs::rename(newest, folder_ / names[1], none);
  });
  wait_for_disk(folder_);
}

std::optional<std::string> Checkpoints::read(std::size_t which, std::string& fault) const {
  const auto path = folder_ / names.at(which);
  if (!fs::exists(path)) return std::nullopt;
  try {
    auto text = read_text(path);
    const auto found = fault_of(text, of_);
    if (found.empty()) return content_of(std::move(text));
    fault = fmt::format("{} {}", path.string(), found);
  } catch (const fs::filesystem_error& error) {
    fault = error.what();
  }
  return std::nullopt;
}

std::optional<std::string> Checkpoints::read(std::vector<std::string>& refused) const {
  for (std::size_t which = 0; which < kept; ++which) {
    std::string fault;
    if (auto found = read(which, fault)) return found;
    if (!fault.empty()) refused.push_back(fault);
  }
  return std::nullopt;
}

bool Checkpoints::any() const {
  std::error_code none;
  return std::ranges::any_of(names, [&](const char* name) { return fs::exists(folder_ / name, none); });
}

void Checkpoints::remove() const {
  std::error_code none;
  fs::remove(folder_ / "checkpoint.partial", none);  // of a process that was killed
  for (const auto* name : names) fs::remove(folder_ / name, none);
}

}  // namespace post
