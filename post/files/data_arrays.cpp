#include "post/files/data_arrays.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace post {
namespace {

// An array is a head of 32-bit numbers, then its blocks; each of the two is a base64 text of its own. Head: count of
// blocks, bytes of a block, bytes of the last one if it is shorter (else 0), compressed bytes of every block.
using Head = std::vector<std::uint32_t>;
constexpr std::size_t fixed_numbers = 3;      // numbers of a head before the sizes
constexpr std::size_t block_bytes = 1 << 15;  // bytes, as VTK takes them
// Level 6 takes 1.6 times as long for files that are 0.8 % smaller (62,500 points): numbers hardly shrink.
constexpr int zlib_level = 1;
constexpr std::size_t most_shrunk = 1032;  // zlib shrinks nothing more than to this part
constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::size_t base64_size(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

[[noreturn]] void throw_damaged() {
  throw std::runtime_error("an array is damaged");
}

std::string from_base64(std::string_view text) {
  static const auto values = [] {
    std::array<std::int8_t, 256> result;
    result.fill(-1);
    for (std::size_t i = 0; i < base64_digits.size(); ++i) result[std::uint8_t(base64_digits[i])] = std::int8_t(i);
    return result;
  }();
  if (text.size() % 4 != 0) throw_damaged();
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t three = 0;
    for (std::size_t k = i; k < i + 4; ++k) {
      const int value = k + padding < text.size() ? values[std::uint8_t(text[k])] : 0;
      if (value < 0) throw_damaged();
      three = three << 6 | std::uint32_t(value);
    }
    for (const int shift : {16, 8, 0}) bytes += char(three >> shift & 255);
  }
  bytes.resize(bytes.size() - padding);
  return bytes;
}

std::string compressed(std::span<const std::byte> bytes) {
  Head head{std::uint32_t((bytes.size() + block_bytes - 1) / block_bytes), block_bytes,
            std::uint32_t(bytes.size() % block_bytes)};
  std::vector<std::byte> blocks;
  for (std::size_t at = 0; at < bytes.size(); at += block_bytes) {
    const auto part = bytes.subspan(at, std::min(block_bytes, bytes.size() - at));
    uLongf size = compressBound(part.size());
    const auto before = blocks.size();
    blocks.resize(before + size);
    if (compress2(reinterpret_cast<Bytef*>(blocks.data() + before), &size, reinterpret_cast<const Bytef*>(part.data()),
                  part.size(), zlib_level) != Z_OK)
      throw std::bad_alloc();
    blocks.resize(before + size);
    head.push_back(std::uint32_t(size));
  }
  return base64(std::as_bytes(std::span(head))) + base64(blocks);
}

/// The numbers of a head, from its base64 text.
Head head_of(std::string_view text, std::size_t count) {
  const auto width = base64_size(count * sizeof(Head::value_type));
  if (width > text.size()) throw_damaged();
  const auto bytes = from_base64(text.substr(0, width));
  if (bytes.size() < count * sizeof(Head::value_type)) throw_damaged();
  Head head(count);
  std::memcpy(head.data(), bytes.data(), count * sizeof(head[0]));
  return head;
}

std::string inflated(std::string_view text) {
  const auto first = text.find_first_not_of(" \n\r\t"), last = text.find_last_not_of(" \n\r\t");
  if (first == std::string_view::npos) throw_damaged();
  text = text.substr(first, last + 1 - first);
  const std::size_t count = head_of(text, fixed_numbers)[0];
  if (count > text.size()) throw_damaged();
  const auto head = head_of(text, fixed_numbers + count);
  const auto blocks = from_base64(text.substr(base64_size(head.size() * sizeof(head[0]))));
  const std::size_t whole = head[1], rest = head[2] > 0 ? head[2] : whole,
                    all = count > 0 ? whole * (count - 1) + rest : 0;
  if (all > most_shrunk * blocks.size()) throw_damaged();
  std::string result(all, '\0');
  std::size_t from = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t wanted = i + 1 < count ? whole : rest, given = head[fixed_numbers + i];
    if (given > blocks.size() - from) throw_damaged();
    uLongf size = wanted;
    const int outcome = uncompress(reinterpret_cast<Bytef*>(result.data() + i * whole), &size,
                                   reinterpret_cast<const Bytef*>(blocks.data() + from), given);
    if (outcome == Z_MEM_ERROR) throw std::bad_alloc();
    if (outcome != Z_OK || size != wanted) throw_damaged();
    from += given;
  }
  if (from != blocks.size()) throw_damaged();
  return result;
}

/// Readers take the attribute of components as the sign of a second index: one component has none.
template <typename Number>
std::string element(const char* type, std::string_view name, std::size_t components, std::span<const Number> numbers) {
  std::string text = fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\"{} NumberOfTuples=\"{}\" format=\"binary\">\n", type, name,
      components > 1 ? fmt::format(" NumberOfComponents=\"{}\"", components) : "", numbers.size() / components);
  return text.append(compressed(std::as_bytes(numbers))).append("\n</DataArray>\n");
}

}  // namespace

std::string base64(std::span<const std::byte> bytes) {
  std::string text(base64_size(bytes.size()), '=');
  auto to = text.begin();
  for (std::size_t i = 0; i < bytes.size(); i += 3, to += 4) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0; };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    const std::size_t left = bytes.size() - i;
    to[0] = base64_digits[three >> 18];
    to[1] = base64_digits[three >> 12 & 63];
    if (left > 1) to[2] = base64_digits[three >> 6 & 63];
    if (left > 2) to[3] = base64_digits[three & 63];
  }
  return text;
}

std::string data_array(std::string_view name, std::span<const double> numbers, std::size_t components) {
  return element("Float64", name, components, numbers);
}

std::string data_array(std::string_view name, std::span<const std::int64_t> numbers) {
  return element("Int64", name, 1, numbers);
}

std::string data_array(std::string_view name, std::span<const std::uint8_t> numbers) {
  return element("UInt8", name, 1, numbers);
}

std::vector<std::pair<const char*, std::string>> vtk_attributes() {
  return {{"byte_order", std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian"},
          {"header_type", "UInt32"},
          {"compressor", "vtkZLibDataCompressor"}};
}

std::string vtk_file(std::string_view type, const std::string& content) {
  std::string attributes;
  for (const auto& [name, value] : vtk_attributes()) attributes += fmt::format(" {}=\"{}\"", name, value);
  std::string text =
      fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"0.1\"{1}>\n<{0}>\n", type, attributes);
  return text.append(content).append(fmt::format("</{}>\n</VTKFile>\n", type));
}

template <typename Number>
std::vector<Number> numbers_of(std::string_view text) {
  const auto bytes = inflated(text);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (numbers.size() * sizeof(Number) != bytes.size()) throw_damaged();
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}
template std::vector<double> numbers_of(std::string_view);
template std::vector<std::int64_t> numbers_of(std::string_view);

}  // namespace post
