#include "post/files/sinks/kept_sink.hpp"

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
  arrays = {{"x", array(mesh_.positions)},
            {"area", {mesh_.areas}},
            {"cut", {mesh_.cut}},
            {"damage", {std::move(frame.damage)}},
            {"w", array(frame.state.row(0))},
            {"theta", array(frame.state.bottomRows<2>())},
            {"moments", array(frame.resultants.moments)},
            {"shear", array(frame.resultants.shear)},
            {"von_mises", array(frame.resultants.von_mises.transpose())}};
  quads = flat(mesh_.quads);
  triangles = flat(mesh_.triangles);
}

void KeptSink::cracks(const std::vector<CrackLine>& lines) {
  for (const auto& line : lines) kept_.cracks.push_back(array(line.vertices));
}

void KeptSink::tables(const Tables& tables) {
  for (const auto& [name, table] : tables) kept_.tables.emplace_back(name, *table);
}

}  // namespace post
