#include "post/files/shared/shared_state_file.hpp"

namespace post {
namespace {

PointOrder order_of(const plate::Ranks& all, const Mesh& mesh) {
  const auto own = std::ptrdiff_t(mesh.own.value_or(mesh.positions.size()));
  if (!mesh.numbers.empty()) return {all, std::vector<std::uint32_t>(mesh.numbers.begin(), mesh.numbers.begin() + own)};
  return {all, std::vector<geometry::Point>(mesh.positions.begin(), mesh.positions.begin() + own)};
}

}  // namespace

SharedStateFile::SharedStateFile(const plate::Ranks& all, StateFile::Options options, const Mesh& mesh)
    : order_(order_of(all, mesh)) {
  const auto one = [](const std::vector<double>& values) {
    return [&values](std::size_t k, double* to) { *to = values[k]; };
  };
  const auto place = [&](std::size_t k, double* to) { to[0] = mesh.positions[k].x(), to[1] = mesh.positions[k].y(); };
  const StateFile::Points points{order_.points(), parts(2, place), parts(1, one(mesh.areas)), parts(1, one(mesh.cut))};
  const bool goes_on = options.goes_on;
  if (all.rank() == 0) {
    file_.emplace(std::move(options), points);
  } else if (!goes_on) {  // what the first asks for
    for (const auto& field : {points.positions, points.areas, points.cut}) for_each_part(points.count, field);
  }
}

InParts SharedStateFile::parts(std::size_t width, Numbers numbers) {
  return [this, width, numbers = std::move(numbers)](std::size_t first, std::size_t count) {
    room_ = order_.at_first(first, count, width, numbers);
    return std::span<const double>(room_);
  };
}

template <typename Rows>
InParts SharedStateFile::parts(const Rows& rows) {
  return parts(std::size_t(rows.rows()), [&rows](std::size_t k, double* to) {
    for (Eigen::Index c = 0; c < rows.rows(); ++c) to[c] = rows(c, Eigen::Index(k));
  });
}

void SharedStateFile::write(const Frame& frame, const plate::State& velocity) {
  const auto von_mises = frame.resultants.von_mises.transpose();
  const StateFile::Motion motion{frame.time,
                                 frame.step,
                                 order_.points(),
                                 parts(frame.state),
                                 velocity.cols() > 0 ? parts(velocity) : InParts(),
                                 parts(frame.resultants.moments),
                                 parts(frame.resultants.shear),
                                 parts(von_mises)};
  if (file_) return file_->write(motion);
  for (const auto* numbers :
       {&motion.state, &motion.velocity, &motion.moments, &motion.shear_forces, &motion.von_mises})
    if (*numbers) for_each_part(motion.points, *numbers);
}

void SharedStateFile::go_on(std::size_t frames) {
  if (file_) file_->go_on(frames);
}

void SharedStateFile::part() {
  if (file_) file_->part();
}

void SharedStateFile::write(const std::string& name, const Table& table) {
  if (file_) file_->write(name, table);
}

void SharedStateFile::close() {
  if (file_) file_->close();
}

}  // namespace post
