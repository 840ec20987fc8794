#include "post/files/vtk/pieces.hpp"

#include <fmt/format.h>

#include <bit>
#include <regex>

#include "plate/model/ranks/ranks.hpp"
#include "post/files/vtk/series.hpp"
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

}  // namespace post
