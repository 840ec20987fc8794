#include "post/files/sinks.hpp"

#include "plate/model/communicator.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/frame.hpp"

namespace post {
namespace {

template <typename Rows>
ResultsInMemory::Array array(const Eigen::MatrixBase<Rows>& rows) {
  ResultsInMemory::Array result{std::vector<double>(std::size_t(rows.size())), std::size_t(rows.rows())};
  Eigen::Map<Eigen::MatrixXd>(result.values.data(), rows.rows(), rows.cols()) = rows;
  return result;
}

ResultsInMemory::Array array(const std::vector<Eigen::Vector2d>& points) {
  ResultsInMemory::Array result{{}, 2};
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

void MemorySink::frame(Frame frame, std::optional<Mesh> mesh, plate::State) {
  if (mesh) mesh_ = std::move(*mesh);
  auto& [time, arrays, quads, triangles] = in_memory_.frames.emplace_back();
  time = frame.time;
  const auto linear = [&](const auto& rows) { return array(at_vertices(mesh_, rows, &Mesh::Source::linear)); };
  const auto mean = [&](const auto& rows) { return array(at_vertices(mesh_, rows, &Mesh::Source::mean)); };
  auto areas = mesh_.areas;
  areas.resize(areas.size() + mesh_.corners.size(), 0);
  arrays = {{"x", array(vertices(mesh_))},
            {"area", {std::move(areas)}},
            {"cut", mean(row_of(mesh_.cut))},
            {"damage", mean(row_of(frame.damage))},
            {"w", linear(frame.state.row(0))},
            {"theta", linear(frame.state.bottomRows<2>())},
            {"moments", mean(frame.resultants.moments)},
            {"shear", mean(frame.resultants.shear)},
            {"von_mises", mean(frame.resultants.von_mises.transpose())}};
  if (const auto& in_plane = frame.in_plane) {
    arrays["displacement"] = linear(in_plane->displacement);
    arrays["membrane_forces"] = mean(in_plane->force);
  }
  quads = flat(mesh_.quads);
  triangles = flat(mesh_.triangles);
}

void MemorySink::cracks(const Cracks& cracks) {
  for (const auto& line : cracks.lines) in_memory_.cracks.push_back(array(line.vertices));
}

void MemorySink::tables(const Tables& tables) {
  for (const auto& [name, table] : tables) in_memory_.tables.emplace_back(name, *table);
}

Folder::Folder(FolderOptions options, std::optional<FolderLock> lock)
    : options_(std::move(options)), lock_(std::move(lock)) {
  if (lock_) write_atomically(options_.folder / "case.resolved.toml", options_.state.resolved_case);
}

void Folder::open(const Mesh& mesh) {
  if (options_.vtk) vtk_.emplace(options_.folder, mesh, *options_.communicator);
  if (options_.hdf5) hdf5_.emplace(options_.state, mesh, *options_.communicator);
}

/// Ranks write together, each from one thread: only a single process goes on meanwhile.
void Folder::frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) {
  if (!options_.vtk && !hdf5_) return;
  wait_for_frame();
  times_.push_back(frame.time);
  if (options_.vtk && !vtk_) vtk_.emplace(options_.folder, Mesh{}, *options_.communicator);
  if (mesh && vtk_) vtk_->remesh(std::move(*mesh));
  auto write = [this, frame = std::move(frame), velocity = std::move(velocity)] {
    if (vtk_) vtk_->write(frame);
    if (hdf5_) hdf5_->write(frame, options_.state.velocities ? &velocity : nullptr);
  };
  if (options_.communicator->distributed())
    write();
  else
    writing_ = std::async(std::launch::async, std::move(write));
}

void Folder::final_state(const Mesh& mesh, const Frame& frame) {
  wait_for_frame();
  if (!options_.hdf5) return;
  auto options = options_.state;
  options.velocities = options.goes_on = false;
  hdf5_.emplace(std::move(options), mesh, *options_.communicator);
  hdf5_->write(frame, nullptr);
}

void Folder::wait_for_frame() {
  if (writing_.valid()) writing_.get();
}

void Folder::cracks(const Cracks& cracks) {
  if (lock_) write_cracks(options_.folder / "cracks.vtp", cracks);
}

void Folder::plot(const std::string& name, const std::string& svg) {
  if (lock_) write_atomically(options_.folder / (name + ".svg"), svg);
}

void Folder::tables(const Tables& tables) {
  if (lock_)
    for (const auto& [name, table] : tables) write_csv(options_.folder / (name + ".csv"), *table);
  wait_for_frame();
  if (!hdf5_) return;
  for (const auto& [name, table] : tables) hdf5_->write(name, *table);
  hdf5_->close();
}

std::vector<double> Folder::written() {
  wait_for_frame();
  if (hdf5_) hdf5_->part();
  return times_;
}

void Folder::go_on(const std::vector<double>& times) {
  times_ = times;
  if (options_.vtk && !vtk_) vtk_.emplace(options_.folder, Mesh{}, *options_.communicator);
  if (vtk_) vtk_->go_on(times);
  if (hdf5_) hdf5_->go_on(times.size());
}

void Folder::summary(const std::string& json) {
  if (lock_) write_atomically(options_.folder / "summary.json", json);
}

}  // namespace post
