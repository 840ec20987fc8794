#include "post/files/sinks/pieces.hpp"

namespace post {

Pieces::Pieces(const plate::Ranks& all, std::filesystem::path folder, bool draws,
               std::optional<StateFile::Options> stored, std::unique_ptr<Sink> rest)
    : all_(all), folder_(std::move(folder)), draws_(draws), stored_(std::move(stored)), rest_(std::move(rest)) {}

void Pieces::open(const Mesh& mesh) {
  if (draws_) vtk_.emplace(all_, folder_, mesh);
  if (stored_) hdf5_.emplace(all_, *stored_, mesh);
}

void Pieces::frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) {
  times_.push_back(frame.time);
  if (hdf5_) hdf5_->write(frame, velocity);
  if (!draws_) return;
  if (!vtk_) vtk_.emplace(all_, folder_, Mesh{});
  if (mesh) vtk_->remesh(std::move(*mesh));
  vtk_->write(frame);
}

void Pieces::final_state(const Mesh& mesh, const Frame& frame) {
  if (!stored_) return;
  auto options = *stored_;
  options.velocities = options.goes_on = false;
  hdf5_.emplace(all_, std::move(options), mesh);
  hdf5_->write(frame, {});
}

std::vector<double> Pieces::written() {
  if (hdf5_) hdf5_->part();
  return times_;
}

void Pieces::go_on(const std::vector<double>& times) {
  times_ = times;
  if (draws_ && !vtk_) vtk_.emplace(all_, folder_, Mesh{});
  if (vtk_) vtk_->go_on(times);
  if (hdf5_) hdf5_->go_on(times.size());
}

void Pieces::cracks(const Cracks& cracks) {
  if (rest_) rest_->cracks(cracks);
}

void Pieces::plot(const std::string& name, const std::string& svg) {
  if (rest_) rest_->plot(name, svg);
}

void Pieces::tables(const Tables& tables) {
  if (rest_) rest_->tables(tables);
  if (!hdf5_) return;
  for (const auto& [name, table] : tables) hdf5_->write(name, *table);
  hdf5_->close();
}

void Pieces::summary(const std::string& json) {
  if (rest_) rest_->summary(json);
}

}  // namespace post
