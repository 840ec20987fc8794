#include "post/files/checkpoints.hpp"

#define XXH_INLINE_ALL
#define XXH_VECTOR 0  // scalar: gcc 12 warns of its own AVX-512 header
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "plate/model/reduction.hpp"
#include "post/files/atomic_file.hpp"

namespace post {
namespace {

namespace fs = std::filesystem;

constexpr std::array names{"checkpoint", "checkpoint.before"};
constexpr const char* name_of_end = "checkpoint.end";    // of a run that has ended
constexpr const char* magic = "PDPlate checkpoint 5: ";  // the number of its form

constexpr std::size_t digits = 16;  // of the checksum, at the end

class Checksum {
public:
  Checksum() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  void add(const void* data, std::size_t size) { XXH3_64bits_update(state_.get(), data, size); }
  std::string text() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_.get())); }

private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

std::string checksum(std::string_view text) {
  Checksum sum;
  sum.add(text.data(), text.size());
  return sum.text();
}

/// Describes the error in a checkpoint; empty where there is none.
std::string error_in(std::string_view all, const std::string& of) {
  const auto line = all.find('\n');
  if (!all.starts_with(magic) || line == std::string_view::npos) return "is no checkpoint of this version";
  const auto before = all.substr(0, std::max(all.size(), digits) - digits);
  if (before.size() <= line || checksum(before) != all.substr(before.size())) return "is damaged or not whole";
  if (const auto found = all.substr(0, line).substr(std::string_view(magic).size()); found != of)
    return fmt::format("is of another run: {}, not {}", found, of);
  return {};
}

/// Content of the file of the first rank: turn and checksums of the parts, and the memory after them.
struct Main {
  std::size_t turn = 0;
  std::vector<std::string> checksums;
  std::string memory;
};

/// `head`: the lines before the memory.
void write_main(const fs::path& folder, std::string_view head, std::string_view memory) {
  const auto newest = folder / names[0];
  write_atomically(newest, [&](const fs::path& beside) {
    errno = 0;
    std::ofstream file(beside, std::ios::binary);
    Checksum sum;
    for (const auto part : {head, memory}) sum.add(part.data(), part.size()), file << part;
    file << sum.text();
    file.close();  // what is still in the buffer meets a full disk only here
    if (!file) cannot_write(beside, errno);
    wait_for_disk(beside);
    std::error_code none;  // there is none before the second
    fs::rename(newest, folder / names[1], none);
  });
  wait_for_disk(folder);
}

/// Nothing where there is none, or where it is not whole or not of this run: then `problem` says what is wrong.
std::optional<Main> read_main(const fs::path& path, const std::string& of, std::string& problem) {
  if (!fs::exists(path)) return std::nullopt;
  std::string text;
  try {
    text = read_text(path);
  } catch (const fs::filesystem_error& error) {
    problem = error.what();
    return std::nullopt;
  }
  if (const auto found = error_in(text, of); !found.empty()) {
    problem = fmt::format("{} {}", path.string(), found);
    return std::nullopt;
  }
  text.resize(text.size() - digits);
  const auto first = text.find('\n') + 1, second = text.find('\n', first);
  std::istringstream words(text.substr(first, second - first));
  Main main;
  std::size_t count = 0;
  words >> main.turn >> count;
  for (std::string word; main.checksums.size() < count && words >> word;) main.checksums.push_back(word);
  if (second != std::string::npos) main.memory = text.substr(second + 1);
  return main;
}

constexpr std::array<char, 8> magic_of_cells{'P', 'D', 'P', 'c', 'e', 'l', 'l', '1'};
constexpr std::size_t piece = 1 << 20;  // bytes at once

struct Header {
  std::array<char, 8> mark = magic_of_cells;
  std::uint64_t width = 0, points = 0;
  std::array<std::int64_t, 4> box{0, 0, 0, 0};  // low column and row, high ones behind the last
};

Header header_of(const CellValues& values) {
  Header header;
  header.width = values.width, header.points = values.cells.size();
  if (values.cells.empty()) return header;
  auto& [low_column, low_row, high_column, high_row] = header.box;
  low_column = high_column = values.cells[0][0], low_row = high_row = values.cells[0][1];
  for (const auto& [column, row] : values.cells) {
    low_column = std::min(low_column, std::int64_t(column)), low_row = std::min(low_row, std::int64_t(row));
    high_column = std::max(high_column, std::int64_t(column) + 1), high_row = std::max(high_row, std::int64_t(row) + 1);
  }
  return header;
}

std::size_t bytes_of_point(std::size_t width) {
  return 2 * sizeof(std::int64_t) + width * sizeof(double);
}

bool meets(const std::array<std::int64_t, 4>& box, const geometry::CellBox& wanted) {
  return box[0] < wanted.high[0] && wanted.low[0] < box[2] && box[1] < wanted.high[1] && wanted.low[1] < box[3];
}

}  // namespace

std::string write_cells(const fs::path& path, const CellValues& values) {
  Checksum sum;
  write_atomically(path, [&](const fs::path& beside) {
    std::ofstream file(beside, std::ios::binary);
    std::string text;
    const auto flush = [&] {
      sum.add(text.data(), text.size());
      file.write(text.data(), std::streamsize(text.size()));
      text.clear();
    };
    const auto add = [&](const void* data, std::size_t size) { text.append(static_cast<const char*>(data), size); };
    const Header header = header_of(values);
    add(&header, sizeof(header));
    for (std::size_t k = 0; k < values.cells.size(); ++k) {
      const std::array<std::int64_t, 2> cell{values.cells[k][0], values.cells[k][1]};
      add(cell.data(), sizeof(cell));
      add(values.values.data() + k * values.width, values.width * sizeof(double));
      if (text.size() > piece) flush();
    }
    flush();
    file.close();  // what is still in the buffer meets a full disk only here
    if (!file) throw fs::filesystem_error("cannot write", beside, std::make_error_code(std::errc::no_space_on_device));
    wait_for_disk(beside);
  });
  return sum.text();
}

std::string checksum_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return "";
  Checksum sum;
  std::string text(piece, ' ');
  while (file.read(text.data(), std::streamsize(text.size())) || file.gcount() > 0)
    sum.add(text.data(), std::size_t(file.gcount()));
  return file.bad() ? "" : sum.text();
}

std::size_t read_cells(const fs::path& path, const geometry::CellBox& wanted,
                       const std::function<void(const geometry::Cell& cell, std::span<const double> values)>& visit) {
  std::ifstream file(path, std::ios::binary);
  Header header;
  constexpr std::size_t most = 1000;  // numbers of a point
  if (!file.read(reinterpret_cast<char*>(&header), sizeof(header)) || header.mark != magic_of_cells ||
      header.width > most)
    throw std::runtime_error(path.string() + " does not hold points of a checkpoint");
  if (!meets(header.box, wanted)) return header.width;
  const std::size_t one = bytes_of_point(header.width), at_once = piece / one + 1;
  std::string text(at_once * one, ' ');
  std::vector<double> values(header.width);
  for (std::uint64_t left = header.points; left > 0;) {
    const auto count = std::min<std::uint64_t>(left, at_once);
    if (!file.read(text.data(), std::streamsize(count * one)))
      throw std::runtime_error(path.string() + " is not whole");
    for (std::uint64_t i = 0; i < count; ++i) {
      std::array<std::int64_t, 2> cell{};
      std::memcpy(cell.data(), text.data() + i * one, sizeof(cell));
      std::memcpy(values.data(), text.data() + i * one + sizeof(cell), header.width * sizeof(double));
      visit({long(cell[0]), long(cell[1])}, values);
    }
    left -= count;
  }
  return header.width;
}

namespace {

constexpr std::size_t turns = 3;

/// The first that is not empty.
std::string first_of(const std::vector<std::string>& texts) {
  const auto found = std::ranges::find_if(texts, [](const std::string& text) { return !text.empty(); });
  return found == texts.end() ? "" : *found;
}

fs::path part(const fs::path& folder, std::size_t turn, std::size_t rank) {
  return folder / fmt::format("checkpoint.{}.{}", turn, rank);
}

/// Every process looks at some of the parts.
std::string error_in_parts(const plate::Communicator& all, const fs::path& folder, const Main& main) {
  for (auto rank = std::size_t(all.rank()); rank < main.checksums.size(); rank += std::size_t(all.size()))
    if (const auto path = part(folder, main.turn, rank); checksum_of(path) != main.checksums[rank])
      return path.string() + " is damaged or not whole";
  return "";
}

}  // namespace

bool Checkpoints::agreed(bool here) const {
  return plate::largest_of(*all_, here) > 0;
}

void Checkpoints::write(const std::string& memory, const CellValues& own) {
  const auto together = [&](const auto& write) {
    std::string result, problem;
    try {
      result = write();
    } catch (const fs::filesystem_error& error) {
      problem = error.what();
    }
    if (problem = first_of(plate::texts_of_all(*all_, problem)); !problem.empty()) throw CheckpointNotWritten(problem);
    return result;
  };
  const auto path = part(folder_, turn_, std::size_t(all_->rank()));
  const auto checksums = plate::texts_of_all(*all_, together([&] { return write_cells(path, own); }));
  together([&] {
    const auto head = fmt::format("{}{}\n{} {} {}\n", magic, of_, turn_, checksums.size(), fmt::join(checksums, " "));
    if (all_->rank() == 0) write_main(folder_, head, memory);
    return std::string();
  });
  turn_ = (turn_ + 1) % turns;
}

std::optional<Checkpoints::Found> Checkpoints::read(std::vector<std::string>& refused) {
  for (const auto* name : {names[0], names[1], name_of_end}) {
    std::string problem;
    const auto main = read_main(folder_ / name, of_, problem);
    if (main) problem = error_in_parts(*all_, folder_, *main);
    const std::string own = main ? "+" + problem : problem.empty() ? "" : "-" + problem;  // nothing: none
    const auto found = plate::texts_of_all(*all_, own);
    const auto missing = std::ranges::count(found, std::string());
    const auto wrong = std::ranges::find_if(found, [](const std::string& one) { return one.size() > 1; });
    if (wrong != found.end())
      refused.push_back(wrong->substr(1));
    else if (missing == 0) {
      turn_ = (main->turn + 1) % turns;
      Found result{main->memory, {}};
      for (std::size_t rank = 0; rank < main->checksums.size(); ++rank)
        result.parts.push_back(part(folder_, main->turn, rank));
      return result;
    } else if (missing < std::ptrdiff_t(found.size()))
      refused.push_back(folder_.string() + ": not all processes see the checkpoint in it");
  }
  return std::nullopt;
}

bool Checkpoints::any() const {
  std::error_code none;
  return std::ranges::any_of(names, [&](const char* name) { return fs::exists(folder_ / name, none); });
}

bool Checkpoints::kept() const {
  std::error_code none;
  return fs::exists(folder_ / name_of_end, none);
}

/// Removes all files but those whose names begin with `kept`, unless it is empty.
void Checkpoints::remove_but(const std::string& kept) const {
  std::error_code none;
  std::vector<fs::path> files{folder_ / names[0], folder_ / names[1]};  // before the points that they refer to
  for (const auto& entry : fs::directory_iterator(folder_, none))
    if (const auto name = entry.path().filename().string();
        name.starts_with("checkpoint.") && (kept.empty() || !(name.starts_with(kept) || name == name_of_end)))
      files.push_back(entry.path());
  for (const auto& path : files) fs::remove(path, none);
}

void Checkpoints::keep_last() const {
  if (all_->rank() > 0) return;
  std::error_code none;
  if (!fs::exists(folder_ / names[0], none)) return remove();
  fs::rename(folder_ / names[0], folder_ / name_of_end, none);
  remove_but(fmt::format("checkpoint.{}.", (turn_ + turns - 1) % turns));
}

void Checkpoints::remove() const {
  if (all_->rank() == 0) remove_but("");
}

}  // namespace post
