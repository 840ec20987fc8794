#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <stdexcept>

#include "post/files/vtk/data_arrays.hpp"
#include "post/files/vtk/series.hpp"

namespace post {
namespace {

template <typename Number>
std::vector<Number> numbers_in(const pugi::xml_node& array) {
  constexpr const char* type = std::is_same_v<Number, double> ? "Float64" : "Int64";
  if (array.attribute("type").value() != std::string_view(type))
    throw std::runtime_error(fmt::format("an array is not of {}", type));
  return numbers_of<Number>(array.text().get());
}

pugi::xml_node array_named(const pugi::xml_node& parent, const char* name) {
  return parent.find_child_by_attribute("DataArray", "Name", name);
}

/// One row per component and one column per point.
Eigen::MatrixXd values_in(const pugi::xml_node& data, const char* name, std::size_t components, std::size_t points) {
  const auto array = array_named(data, name);
  if (!array) throw std::runtime_error(fmt::format("no {}", name));
  const auto found = numbers_in<double>(array);
  if (found.size() != components * points)
    throw std::runtime_error(fmt::format("{} has {} numbers for {} points", name, found.size(), points));
  return Eigen::Map<const Eigen::MatrixXd>(found.data(), Eigen::Index(components), Eigen::Index(points));
}

Mesh mesh_of(const pugi::xml_node& piece) {
  const auto positions = numbers_in<double>(piece.child("Points").child("DataArray"));
  const auto ids = numbers_in<std::int64_t>(array_named(piece.child("Cells"), "connectivity")),
             ends = numbers_in<std::int64_t>(array_named(piece.child("Cells"), "offsets"));
  Mesh mesh;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) mesh.positions.emplace_back(positions[i], positions[i + 1]);
  const auto points = std::int64_t(mesh.positions.size()), count = std::int64_t(ids.size());
  if (std::ranges::any_of(ids, [&](std::int64_t id) { return id < 0 || id >= points; }) ||
      !std::ranges::is_sorted(ends) || (!ends.empty() && (ends.front() < 0 || ends.back() > count)))
    throw std::runtime_error("its cells are not of its points");
  std::int64_t begin = 0;
  for (const auto end : ends) {
    const auto id = [&](std::int64_t i) { return std::uint32_t(ids[std::size_t(begin + i)]); };
    if (end - begin == 4) mesh.quads.push_back({id(0), id(1), id(2), id(3)});
    if (end - begin == 3) mesh.triangles.push_back({id(0), id(1), id(2)});
    begin = end;
  }
  return mesh;
}

Frame frame_of(const pugi::xml_node& data, std::size_t points) {
  const auto values = [&](const char* name, std::size_t components = 1) {
    return values_in(data, name, components, points);
  };
  const auto w = values("w"), theta = values("theta", 2), damage = values("damage");
  const auto xx = values("Mxx"), yy = values("Myy"), xy = values("Mxy");
  Frame frame;
  frame.state.resize(3, Eigen::Index(points));
  frame.state << w, theta;
  frame.damage.assign(damage.data(), damage.data() + damage.size());
  frame.resultants.moments.resize(3, Eigen::Index(points));
  frame.resultants.moments << xx, yy, xy;
  frame.resultants.von_mises = values("von_mises").transpose();
  return frame;
}

Drawn drawn(const pugi::xml_node& file) {
  for (const auto& [name, value] : vtk_attributes())
    if (file.attribute(name).value() != value)
      throw std::runtime_error(fmt::format("{} is {:?}, not {}: not written by this version of the program", name,
                                           file.attribute(name).value(), value));
  const auto grid = file.child("UnstructuredGrid"), piece = grid.child("Piece");
  Drawn result{mesh_of(piece), {}};
  result.frame = frame_of(piece.child("PointData"), result.mesh.positions.size());
  const auto time = numbers_in<double>(array_named(grid.child("FieldData"), "TimeValue"));
  if (time.size() != 1) throw std::runtime_error("no TimeValue");
  result.frame.time = time.front();
  return result;
}

}  // namespace

Drawn read_frame(const std::filesystem::path& path) {
  try {
    pugi::xml_document document;
    if (const auto parsed = document.load_file(path.c_str()); !parsed) throw std::runtime_error(parsed.description());
    return drawn(document.child("VTKFile"));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace post
