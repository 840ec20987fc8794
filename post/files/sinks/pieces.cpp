#include "post/files/sinks/pieces.hpp"

namespace post {

Pieces::Pieces(const plate::Ranks& all, std::filesystem::path folder, bool draws, std::unique_ptr<Sink> rest)
    : all_(all), folder_(std::move(folder)), draws_(draws), rest_(std::move(rest)) {}

void Pieces::open(const Mesh& mesh) {
  if (draws_) vtk_.emplace(all_, folder_, mesh);
}

void Pieces::frame(Frame frame, std::optional<Mesh> mesh, plate::State) {
  times_.push_back(frame.time);
  if (!draws_) return;
  if (!vtk_) vtk_.emplace(all_, folder_, Mesh{});
  if (mesh) vtk_->remesh(std::move(*mesh));
  vtk_->write(frame);
}

void Pieces::go_on(const std::vector<double>& times) {
  times_ = times;
  if (vtk_) vtk_->go_on(times);
}

void Pieces::cracks(const Cracks& cracks) {
  if (rest_) rest_->cracks(cracks);
}

void Pieces::plot(const std::string& name, const std::string& svg) {
  if (rest_) rest_->plot(name, svg);
}

void Pieces::tables(const Tables& tables) {
  if (rest_) rest_->tables(tables);
}

void Pieces::summary(const std::string& json) {
  if (rest_) rest_->summary(json);
}

}  // namespace post
