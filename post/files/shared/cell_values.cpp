#include "post/files/shared/cell_values.hpp"

#define XXH_INLINE_ALL
#define XXH_VECTOR 0  // scalar: gcc 12 warns of its own AVX-512 header
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "post/files/whole_file.hpp"

namespace post {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> magic{'P', 'D', 'P', 'c', 'e', 'l', 'l', '1'};
constexpr std::size_t piece = 1 << 20;  // bytes at once

struct Header {
  std::array<char, 8> mark = magic;
  std::uint64_t width = 0, points = 0;
  std::array<std::int64_t, 4> box{0, 0, 0, 0};  // low column and row, high ones behind the last
};

class Checksum {
public:
  Checksum() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  void add(const void* data, std::size_t size) { XXH3_64bits_update(state_.get(), data, size); }
  std::string text() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_.get())); }

private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
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
  write_whole(path, [&](const fs::path& beside) {
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
  if (!file.read(reinterpret_cast<char*>(&header), sizeof(header)) || header.mark != magic || header.width > most)
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

}  // namespace post
