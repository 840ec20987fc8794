#pragma once
#include <fmt/format.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

/// DXF files for tests.
namespace dxf_text {

using Vertices = std::vector<std::array<double, 3>>;  // x, y, bulge

inline std::string line(const std::string& layer, double x1, double y1, double x2, double y2) {
  return fmt::format("0\nLINE\n8\n{}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", layer, x1, y1, x2, y2);
}

inline std::string circle(const std::string& layer, double x, double y, double radius) {
  return fmt::format("0\nCIRCLE\n8\n{}\n10\n{}\n20\n{}\n40\n{}\n", layer, x, y, radius);
}

inline std::string arc(const std::string& layer, double x, double y, double radius, double from, double to) {
  return fmt::format("0\nARC\n8\n{}\n10\n{}\n20\n{}\n40\n{}\n50\n{}\n51\n{}\n", layer, x, y, radius, from, to);
}

inline std::string polyline(const std::string& layer, const Vertices& vertices, bool closed) {
  auto text = fmt::format("0\nLWPOLYLINE\n8\n{}\n90\n{}\n70\n{}\n", layer, vertices.size(), closed ? 1 : 0);
  for (const auto& [x, y, bulge] : vertices) text += fmt::format("10\n{}\n20\n{}\n42\n{}\n", x, y, bulge);
  return text;
}

/// The POLYLINE of old files.
inline std::string old_polyline(const std::string& layer, const Vertices& vertices, bool closed) {
  auto text = fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n70\n{}\n", layer, closed ? 1 : 0);
  for (const auto& [x, y, bulge] : vertices)
    text += fmt::format("0\nVERTEX\n8\n{}\n10\n{}\n20\n{}\n42\n{}\n", layer, x, y, bulge);
  return text + "0\nSEQEND\n";
}

inline std::string spline(const std::string& layer, int degree, const std::vector<double>& knots,
                          const Vertices& control, const std::vector<double>& weights = {}) {
  auto text = fmt::format("0\nSPLINE\n8\n{}\n70\n8\n71\n{}\n72\n{}\n73\n{}\n74\n0\n", layer, degree, knots.size(),
                          control.size());
  for (const double k : knots) text += fmt::format("40\n{}\n", k);
  for (const double w : weights) text += fmt::format("41\n{}\n", w);
  for (const auto& x : control) text += fmt::format("10\n{}\n20\n{}\n30\n0\n", x[0], x[1]);
  return text;
}

inline std::string rectangle(const std::string& layer, double x1, double y1, double x2, double y2) {
  return polyline(layer, {{x1, y1, 0}, {x2, y1, 0}, {x2, y2, 0}, {x1, y2, 0}}, true);
}

/// A whole file; `unit`: $INSUNITS.
inline std::string file(const std::string& entities, int unit = 0, const std::string& blocks = "") {
  auto text = fmt::format("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{}\n0\nENDSEC\n", unit);
  if (!blocks.empty()) text += "0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n";
  return text + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

/// A file beside the case files of tests, removed at its end.
class File {
public:
  explicit File(const std::string& text) {
    static std::atomic<int> count{0};
    name_ = fmt::format("drawing_test_{}_{}.dxf", getpid(), count++);
    std::ofstream(path()) << text;
  }
  ~File() { std::filesystem::remove(path()); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::string& name() const { return name_; }
  std::filesystem::path path() const { return std::filesystem::temp_directory_path() / name_; }

private:
  std::string name_;
};

}  // namespace dxf_text
