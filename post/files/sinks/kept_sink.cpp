#include "post/files/sinks/kept_sink.hpp"

#include "post/files/vertices.hpp"

namespace post {
namespace {

template <typename Rows>
Kept::Array array(const Eigen::MatrixBase<Rows>& rows) {
  Kept::Array result{std::vector<double>(std::size_t(rows.size())), std::size_t(rows.rows())};
  Eigen::Map<Eigen::MatrixXd>(result.values.data(), rows.rows(), rows.cols()) = rows;
  return result;
}

Kept::Array array(const std::vector<Eigen::Vector2d>& points) {
  Kept::Array result{{}, 2};
  for (const auto& x : points) result.values.insert(result.values.end(), {x.x(), x.y()});
  return result;
}

Eigen::Map<const Eigen::RowVectorXd> row(const std::vector<double>& values) {
  return {values.data(), Eigen::Index(values.size())};
}

template <typename Cells>
std::vector<std::uint32_t> flat(const Cells& cells) {
  std::vector<std::uint32_t> result;
  for (const auto& cell : cells) result.insert(result.end(), cell.begin(), cell.end());
  return result;
}

}  // namespace

void KeptSink::frame(Frame frame, std::optional<Mesh> mesh, plate::State) {
  if (mesh) mesh_ = std::move(*mesh);
  auto& [time, arrays, quads, triangles] = kept_.frames.emplace_back();
  time = frame.time;
  const auto linear = [&](const auto& rows) { return array(at_vertices(mesh_, rows, &Mesh::Source::linear)); };
  const auto mean = [&](const auto& rows) { return array(at_vertices(mesh_, rows, &Mesh::Source::mean)); };
  auto areas = mesh_.areas;
  areas.resize(areas.size() + mesh_.corners.size(), 0);
  arrays = {{"x", array(vertices(mesh_))},
            {"area", {std::move(areas)}},
            {"cut", mean(row(mesh_.cut))},
            {"damage", mean(row(frame.damage))},
            {"w", linear(frame.state.row(0))},
            {"theta", linear(frame.state.bottomRows<2>())},
            {"moments", mean(frame.resultants.moments)},
            {"shear", mean(frame.resultants.shear)},
            {"von_mises", mean(frame.resultants.von_mises.transpose())}};
  quads = flat(mesh_.quads);
  triangles = flat(mesh_.triangles);
}

void KeptSink::cracks(const Cracks& cracks) {
  for (const auto& line : cracks.lines) kept_.cracks.push_back(array(line.vertices));
}

void KeptSink::tables(const Tables& tables) {
  for (const auto& [name, table] : tables) kept_.tables.emplace_back(name, *table);
}

}  // namespace post
