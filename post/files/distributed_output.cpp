#include "post/files/distributed_output.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <regex>

#include "plate/model/communicator.hpp"
#include "post/files/vtk_series.hpp"
#include "post/files/whole_file.hpp"

namespace post {
namespace {

std::string frame_name(std::size_t frame) {
  return fmt::format("fields_{:04}.pvtu", frame);
}

std::string cracks_name(std::size_t frame) {
  return fmt::format("cracks_{:04}.vtp", frame);
}

std::string piece_name(std::size_t frame, int rank) {
  return fmt::format("fields_{:04}_{}.vtu", frame, rank);
}

/// The pieces, and what each has of its points: as vtu() writes it.
std::string pvtu(std::size_t frame, int pieces) {
  constexpr std::array<std::pair<const char*, int>, 11> arrays{{{"w", 1},
                                                                {"theta", 2},
                                                                {"damage", 1},
                                                                {"cut", 1},
                                                                {"Mxx", 1},
                                                                {"Myy", 1},
                                                                {"Mxy", 1},
                                                                {"Qx", 1},
                                                                {"Qy", 1},
                                                                {"von_mises", 1},
                                                                {"displacement", 3}}};
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

}  // namespace

VtkPieces::VtkPieces(const plate::Ranks& all, std::filesystem::path folder, Mesh mesh)
    : all_(all), folder_(std::move(folder)), mesh_(std::move(mesh)) {}

void VtkPieces::go_on(std::vector<double> times) {
  times_ = std::move(times);
  if (all_.rank() == 0) {
    static const std::regex name(R"(fields_(\d{4,})(_\d+)?\.p?vtu)");
    std::vector<std::filesystem::path> later;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const auto text = entry.path().filename().string();
      if (std::smatch found; std::regex_match(text, found, name) && std::stoul(found[1]) >= times_.size())
        later.push_back(entry.path());
    }
    for (const auto& path : later) std::filesystem::remove(path);
  }
  std::array<std::int64_t, 1> removed{1};
  all_.sum(removed);  // waits for the first
}

void VtkPieces::write(const Frame& frame) {
  const auto number = times_.size();
  write_whole(folder_ / piece_name(number, all_.rank()), vtu(mesh_, frame));
  times_.push_back(frame.time);
  std::array<std::int64_t, 1> written{1};
  all_.sum(written);  // waits for all
  if (all_.rank() > 0) return;
  write_whole(folder_ / frame_name(number), pvtu(number, all_.size()));
  write_whole(folder_ / "fields.pvd", pvd(times_, frame_name));
  if (!frame.cracks) return;
  write_cracks(folder_ / cracks_name(number), *frame.cracks);
  write_whole(folder_ / "cracks.pvd", pvd(times_, cracks_name));
}

namespace {

/// Points of one process in one row of the lattice.
struct OfRow {
  double y, x;  // of the first
  std::int64_t points, rank;
};

}  // namespace

PointOrder::PointOrder(const plate::Ranks& all, const std::vector<geometry::Point>& own) : all_(all) {
  std::vector<OfRow> rows;
  for (const auto& x : own) {
    if (rows.empty() || rows.back().y != x.y()) rows.push_back({x.y(), x.x(), 0, all.rank()});
    ++rows.back().points;
  }
  auto of_all = plate::gathered(all, rows);
  std::ranges::sort(of_all, [](const OfRow& a, const OfRow& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  std::size_t begin = 0;
  for (const auto& one : of_all) {
    const auto count = std::size_t(one.points);
    if (one.rank == all.rank()) own_.push_back({points_, begin, count}), begin += count;
    points_ += count;
  }
}

PointOrder::PointOrder(const plate::Ranks& all, const std::vector<std::uint32_t>& numbers) : all_(all) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k == 0 || numbers[k] != numbers[k - 1] + 1) own_.push_back({numbers[k], k, 0});
    ++own_.back().points;
  }
  std::array<std::int64_t, 1> points{std::int64_t(numbers.size())};
  all.sum(points);
  points_ = std::size_t(points[0]);
}

std::vector<double> PointOrder::at_first(std::size_t first, std::size_t count, std::size_t width,
                                         const std::function<void(std::size_t k, double* to)>& numbers) const {
  std::vector<double> sent;  // of every stretch: where it begins in this part, how many points, their numbers
  const auto behind = std::ranges::upper_bound(own_, first, {}, &Stretch::first);
  for (auto one = behind == own_.begin() ? behind : behind - 1; one != own_.end() && one->first < first + count;
       ++one) {
    const auto low = std::max(one->first, first), high = std::min(one->first + one->points, first + count);
    if (low >= high) continue;
    sent.push_back(double(low - first)), sent.push_back(double(high - low));
    for (auto number = low; number < high; ++number) {
      sent.resize(sent.size() + width);
      numbers(one->begin + number - one->first, sent.data() + sent.size() - width);
    }
  }
  std::vector<std::string> texts(std::size_t(all_.size()));
  texts[0] = plate::text_of(sent);
  const auto received = all_.exchanged(std::move(texts));
  if (all_.rank() > 0) return {};
  std::vector<double> result(count * width);
  for (const auto& text : received) {
    const auto values = plate::values_of<double>(text);
    for (std::size_t i = 0; i < values.size();) {
      const auto place = std::ptrdiff_t(values[i]) * std::ptrdiff_t(width);
      const auto length = std::ptrdiff_t(values[i + 1]) * std::ptrdiff_t(width);
      const auto from = values.begin() + std::ptrdiff_t(i) + 2;
      std::copy(from, from + length, result.begin() + place);
      i += std::size_t(length) + 2;
    }
  }
  return result;
}

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
