#include "post/files/vtk_series.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <pugixml.hpp>
#include <ranges>
#include <regex>
#include <stdexcept>

#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/data_arrays.hpp"
#include "post/files/frame.hpp"

namespace post {
namespace {

std::string fields(std::size_t frame) {
  return fmt::format("fields_{:04}.vtu", frame);
}

std::string fields_in_pieces(std::size_t frame) {
  return fmt::format("fields_{:04}.pvtu", frame);
}

std::string piece_name(std::size_t frame, int rank) {
  return fmt::format("fields_{:04}_{}.vtu", frame, rank);
}

std::string cracks(std::size_t frame) {
  return fmt::format("cracks_{:04}.vtp", frame);
}

/// The pieces, and what each has of its points: as vtu() writes it.
std::string pvtu(std::size_t frame, int pieces, const Frame& seen) {
  std::vector<std::pair<const char*, int>> arrays{{"w", 1},   {"theta", 2},    {"damage", 1}, {"cut", 1},
                                                  {"Mxx", 1}, {"Myy", 1},      {"Mxy", 1},    {"Qx", 1},
                                                  {"Qy", 1},  {"von_mises", 1}};
  if (seen.resultants.top.cols() > 0) arrays.emplace_back("principal_top", 3);
  if (seen.resultants.bottom.cols() > 0) arrays.emplace_back("principal_bottom", 3);
  if (seen.in_plane) arrays.insert(arrays.end(), {{"Nxx", 1}, {"Nyy", 1}, {"Nxy", 1}});
  arrays.emplace_back("displacement", 3);
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" byte_order=\"{}\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n    <PPoints>\n"
      "      <PDataArray type=\"Float64\" NumberOfComponents=\"3\"/>\n    </PPoints>\n    <PPointData>\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
  for (const auto& [name, components] : arrays)
    text +=
        fmt::format("      <PDataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", name, components);
  text += "    </PPointData>\n";
  for (int rank = 0; rank < pieces; ++rank)
    text += fmt::format("    <Piece Source=\"{}\"/>\n", piece_name(frame, rank));
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

/// A list of frames and their times, as ParaView opens it. `without`: frames that are not there.
std::string pvd(const std::vector<double>& times, std::string (*file_name)(std::size_t frame),
                const std::set<std::size_t>& without) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"{}\">\n  <Collection>\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (without.contains(i)) continue;
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times[i], file_name(i));
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

/// GridCells as VTK lists them: the points of all, where the points of each end, what each is.
struct GridCells {
  enum Type : std::uint8_t { vertex = 1, line = 4, triangle = 5, quad = 9 };  // VTK's numbers
  std::vector<std::int64_t> points, ends;
  std::vector<std::uint8_t> types;

  void add(Type type, const auto& cell) {
    std::ranges::copy(cell, std::back_inserter(points));
    ends.push_back(std::int64_t(points.size()));
    types.push_back(type);
  }
  std::string text() const { return data_array("connectivity", points) + data_array("offsets", ends); }
};

/// Every point that no cell uses is a cell by itself, unless it is another process's.
GridCells cells_of(const Mesh& mesh) {
  GridCells cells;
  for (const auto& quad : mesh.quads) cells.add(GridCells::quad, quad);
  for (const auto& triangle : mesh.triangles) cells.add(GridCells::triangle, triangle);
  std::vector<bool> used(mesh.positions.size() + mesh.corners.size(), false);
  for (const auto k : cells.points) used.at(std::size_t(k)) = true;
  const auto own = mesh.positions.size() - mesh.others;
  for (std::size_t k = 0; k < used.size(); ++k)
    if (!used[k] && (k < own || k >= mesh.positions.size())) cells.add(GridCells::vertex, std::array{k});
  return cells;
}

/// Values of points, one row per component, with those of corners behind; throws where the points are not those of the
/// mesh.
template <typename Rows>
std::string point_data(const Mesh& mesh, const char* name, CornerWeight weight, const Eigen::MatrixBase<Rows>& rows) {
  if (const auto points = mesh.positions.size(); std::size_t(rows.cols()) != points)
    throw std::invalid_argument(fmt::format("{} has {} values for {} points", name, rows.cols(), points));
  const Eigen::MatrixXd values = at_vertices(mesh, rows, weight);
  return data_array(name, {values.data(), std::size_t(values.size())}, std::size_t(values.rows()));
}

/// Principal stresses, largest and smallest, and the angle of the largest [degrees], of stresses xx, yy, xy of points.
std::string principal_data(const Mesh& mesh, const char* name, const Eigen::Matrix3Xd& stress) {
  if (const auto points = mesh.positions.size(); std::size_t(stress.cols()) != points)
    throw std::invalid_argument(fmt::format("{} has {} values for {} points", name, stress.cols(), points));
  Eigen::MatrixXd values = at_vertices(mesh, stress, &Mesh::Source::mean);
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const auto [largest, smallest, angle] = plate::principal(values.col(k));
    values.col(k) = Eigen::Vector3d(largest, smallest, angle);
  }
  return data_array(name, {values.data(), std::size_t(values.size())}, 3);
}

void add_fields(std::string& text, const Mesh& mesh, const Frame& frame) {
  const auto& resultants = frame.resultants;
  const auto add = [&](const char* name, CornerWeight weight, const auto& rows) {
    text += point_data(mesh, name, weight, rows);
  };
  constexpr auto linear = &Mesh::Source::linear, mean = &Mesh::Source::mean;
  add("w", linear, frame.state.row(0));
  add("theta", linear, frame.state.bottomRows<2>());
  add("damage", mean, row_of(frame.damage));
  add("cut", mean, row_of(mesh.cut));
  add("Mxx", mean, resultants.moments.row(0));
  add("Myy", mean, resultants.moments.row(1));
  add("Mxy", mean, resultants.moments.row(2));
  add("Qx", mean, resultants.shear.row(0));
  add("Qy", mean, resultants.shear.row(1));
  add("von_mises", mean, resultants.von_mises.transpose());
  if (resultants.top.cols() > 0) text += principal_data(mesh, "principal_top", resultants.top);
  if (resultants.bottom.cols() > 0) text += principal_data(mesh, "principal_bottom", resultants.bottom);
  Eigen::Matrix3Xd displacement = Eigen::Matrix3Xd::Zero(3, frame.state.cols());
  displacement.row(2) = frame.state.row(0);
  if (const auto& in_plane = frame.in_plane) {
    displacement.topRows<2>() = in_plane->displacement;
    add("Nxx", mean, in_plane->force.row(0));
    add("Nyy", mean, in_plane->force.row(1));
    add("Nxy", mean, in_plane->force.row(2));
  }
  add("displacement", linear, displacement);
}

/// The text of fields_NNNN.vtu. Throws std::invalid_argument where the values are not those of the points.
std::string vtu(const Mesh& mesh, const Frame& frame) {
  const auto all = vertices(mesh);
  std::vector<double> positions;
  positions.reserve(3 * all.size());
  for (const auto& x : all) positions.insert(positions.end(), {x.x(), x.y(), 0});
  const auto cells = cells_of(mesh);
  std::string text =
      fmt::format("<FieldData>\n{}</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n",
                  data_array("TimeValue", std::array{frame.time}), all.size(), cells.types.size());
  add_fields(text, mesh, frame);
  text.append("</PointData>\n<Points>\n").append(data_array("Points", positions, 3));
  text.append("</Points>\n<Cells>\n").append(cells.text()).append(data_array("types", cells.types));
  return vtk_file("UnstructuredGrid", text.append("</Cells>\n</Piece>\n"));
}

/// The text of cracks.vtp.
std::string vtp(const Cracks& cracks) {
  constexpr double none = -1;
  constexpr std::array<double, 3> unknown{NAN, NAN, NAN};
  std::vector<double> positions, advances, tips, crack_of_cell, tip_of_cell;
  std::array<std::vector<double>, 3> factors;
  GridCells lines, ends;
  const auto add = [&](const geometry::Point& x, double advance, double tip, const std::array<double, 3>& K) {
    positions.insert(positions.end(), {x.x(), x.y(), 0});
    advances.push_back(advance), tips.push_back(tip);
    for (std::size_t i = 0; i < 3; ++i) factors[i].push_back(K[i]);
  };
  for (const auto& tip : cracks.tips)  // those of vertices come first, as VTK counts cells
    crack_of_cell.push_back(double(tip.crack)), tip_of_cell.push_back(double(tip.number));
  for (const auto& line : cracks.lines) {
    lines.add(GridCells::line, std::views::iota(tips.size(), tips.size() + line.vertices.size()));
    crack_of_cell.push_back(double(&line - cracks.lines.data())), tip_of_cell.push_back(none);
    for (std::size_t i = 0; i < line.vertices.size(); ++i) add(line.vertices[i], line.advances[i], none, unknown);
  }
  for (const auto& tip : cracks.tips) {
    ends.add(GridCells::vertex, std::array{tips.size()});
    add(tip.position, 0, double(tip.number), tip.factors.value_or(unknown));
  }
  return vtk_file(
      "PolyData",
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\">\n"
                  "<PointData>\n{}{}{}{}{}</PointData>\n<CellData>\n{}{}</CellData>\n<Points>\n{}</Points>\n"
                  "<Verts>\n{}</Verts>\n<Lines>\n{}</Lines>\n</Piece>\n",
                  tips.size(), cracks.tips.size(), cracks.lines.size(), data_array("advance", advances),
                  data_array("tip", tips), data_array("K1", factors[0]), data_array("K2", factors[1]),
                  data_array("K3", factors[2]), data_array("crack", crack_of_cell), data_array("tip", tip_of_cell),
                  data_array("Points", positions, 3), ends.text(), lines.text()));
}

}  // namespace

VtkSeries::VtkSeries(std::filesystem::path folder, Mesh mesh, const plate::Communicator& communicator)
    : folder_(std::move(folder)), mesh_(std::move(mesh)), communicator_(&communicator) {}

void VtkSeries::write(const Frame& frame) {
  const auto number = times_.size();
  const bool in_pieces = communicator_->distributed();
  write_atomically(folder_ / (in_pieces ? piece_name(number, communicator_->rank()) : fields(number)),
                   vtu(mesh_, frame));
  times_.push_back(frame.time);
  plate::wait_for_all(*communicator_);
  if (communicator_->rank() > 0) return;
  if (in_pieces) write_atomically(folder_ / fields_in_pieces(number), pvtu(number, communicator_->size(), frame));
  if (frame.cracks) write_atomically(folder_ / cracks(number), vtp(*frame.cracks));
  write_atomically(folder_ / "fields.pvd", pvd(times_, in_pieces ? fields_in_pieces : fields, gone_));
  if (frame.cracks) write_atomically(folder_ / "cracks.pvd", pvd(times_, cracks, gone_));
}

/// Pieces of later frames may be of more ranks than there are now.
void VtkSeries::go_on(std::vector<double> times) {
  times_ = std::move(times);
  const bool in_pieces = communicator_->distributed();
  for (std::size_t i = 0; i < times_.size() && !in_pieces; ++i)
    if (!std::filesystem::exists(folder_ / fields(i))) gone_.insert(i);
  if (in_pieces && communicator_->rank() == 0) {
    static const std::regex name(R"(fields_(\d{4,})(_\d+)?\.p?vtu)");
    std::vector<std::filesystem::path> later;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const auto text = entry.path().filename().string();
      if (std::smatch found; std::regex_match(text, found, name) && std::stoul(found[1]) >= times_.size())
        later.push_back(entry.path());
    }
    for (const auto& path : later) std::filesystem::remove(path);
  }
  plate::wait_for_all(*communicator_);
}

std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> frames;
  if (!std::filesystem::exists(folder / "fields.pvd")) return frames;
  static const std::regex file("file=\"([^\"]+\\.vtu)\"");
  const auto text = read_text(folder / "fields.pvd");
  for (std::sregex_iterator found(text.begin(), text.end(), file), end; found != end; ++found)
    frames.push_back(folder / (*found)[1].str());
  return frames;
}

void write_cracks(const std::filesystem::path& path, const Cracks& cracks) {
  write_atomically(path, vtp(cracks));
}

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

/// Values with a row per component and a column per point.
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
  frame.state.resize(plate::unknowns_per_point, Eigen::Index(points));
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
