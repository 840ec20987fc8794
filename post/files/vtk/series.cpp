#include <fmt/format.h>

#include <bit>
#include <regex>

#include "post/files/vtk/series.hpp"
#include "post/files/whole_file.hpp"

namespace post {
namespace {

std::string fields(std::size_t frame) {
  return fmt::format("fields_{:04}.vtu", frame);
}

std::string cracks(std::size_t frame) {
  return fmt::format("cracks_{:04}.vtp", frame);
}

}  // namespace

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

VtkSeries::VtkSeries(std::filesystem::path folder, Mesh mesh) : folder_(std::move(folder)), mesh_(std::move(mesh)) {}

void VtkSeries::write(const Frame& frame) {
  const auto number = times_.size();
  write_whole(folder_ / fields(number), vtu(mesh_, frame));
  if (frame.cracks) write_whole(folder_ / cracks(number), vtp(*frame.cracks));
  times_.push_back(frame.time);
  write_whole(folder_ / "fields.pvd", pvd(times_, fields, gone_));
  if (frame.cracks) write_whole(folder_ / "cracks.pvd", pvd(times_, cracks, gone_));
}

void VtkSeries::go_on(std::vector<double> times) {
  times_ = std::move(times);
  for (std::size_t i = 0; i < times_.size(); ++i)
    if (!std::filesystem::exists(folder_ / fields(i))) gone_.insert(i);
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
  write_whole(path, vtp(cracks));
}

}  // namespace post
