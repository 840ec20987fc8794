#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace post {

/// Bytes as text (RFC 4648).
std::string base64(std::span<const std::byte> bytes);

/// An XML element <DataArray> of VTK: numbers of one type, compressed by zlib in blocks, inline in base64 so that the
/// text is well-formed XML. `name` may be empty, `components` is the count of numbers for each point or cell.
std::string data_array(std::string_view name, std::span<const double> numbers, std::size_t components = 1);
std::string data_array(std::string_view name, std::span<const std::int64_t> numbers);
std::string data_array(std::string_view name, std::span<const std::uint8_t> numbers);

/// The text of a file of VTK: `type` is UnstructuredGrid or PolyData, `content` what stands in the element of that
/// name.
std::string vtk_file(std::string_view type, const std::string& content);

/// The attributes of <VTKFile> with which the arrays of a file can be read back: name and value.
std::vector<std::pair<const char*, std::string>> vtk_attributes();

/// The numbers in the text of a <DataArray>. Throws std::runtime_error where they are damaged.
template <typename Number>
std::vector<Number> numbers_of(std::string_view text);

}  // namespace post
