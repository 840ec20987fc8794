#include "post/report/pictures.hpp"

#include <nlohmann/json.hpp>

#include "tests/catch.hpp"

namespace {

plate::Mesh square(std::size_t points) {
  plate::Mesh mesh;
  mesh.spacing = 1.0 / double(points);
  for (std::size_t j = 0; j < points; ++j)
    for (std::size_t i = 0; i < points; ++i)
      mesh.positions.emplace_back((double(i) + 0.5) * mesh.spacing, (double(j) + 0.5) * mesh.spacing);
  const auto id = [&](std::size_t i, std::size_t j) { return std::uint32_t(j * points + i); };
  for (std::size_t j = 0; j + 1 < points; ++j)
    for (std::size_t i = 0; i + 1 < points; ++i)
      mesh.quads.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
  return mesh;
}

/// w = factor x, with resultants.
post::Frame frame(const plate::Mesh& mesh, double time, double factor) {
  const auto n = Eigen::Index(mesh.positions.size());
  post::Frame result{time, 0, plate::State::Zero(3, n), plate::resultants_of(n),
                     std::vector<double>(std::size_t(n), 0)};
  for (Eigen::Index k = 0; k < n; ++k) {
    result.state(0, k) = factor * mesh.positions[std::size_t(k)].x();
    result.resultants.moments.col(k) << 1, -2 + mesh.positions[std::size_t(k)].y(), 0;
    result.resultants.von_mises[k] = k == 0 ? 1e6 : mesh.positions[std::size_t(k)].y();  // a singularity at a corner
  }
  return result;
}

std::vector<std::uint16_t> codes(const std::string& base64) {
  static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0, have = 0;
  for (const char c : base64) {
    const auto value = letters.find(c);
    if (value == std::string::npos) continue;
    bits = bits << 6U | std::uint32_t(value), have += 6;
    if (have >= 8) have -= 8, bytes += char(bits >> have & 0xFFU);
  }
  std::vector<std::uint16_t> result;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    result.push_back(std::uint16_t(std::uint8_t(bytes[i]) | std::uint8_t(bytes[i + 1]) << 8U));
  return result;
}

nlohmann::json field(const nlohmann::json& pictures, const std::string& name) {
  for (const auto& one : pictures["fields"])
    if (one["name"] == name) return one;
  return {};
}

}  // namespace

TEST_CASE("pictures keep values to a part in ten thousand of their colours, whatever a singularity does") {
  const auto mesh = square(40);
  post::Pictures pictures;
  pictures.open(mesh);
  pictures.look(frame(mesh, 1, 3));
  const auto json = nlohmann::json::parse(pictures.json());
  REQUIRE(json["frames"].size() == 1);
  const auto& one = json["frames"][0];
  for (const std::string name : {"w", "von_mises"}) {
    const auto about = field(json, name);
    const double low = about["low"], high = about["high"], span = double(about["range"][1]) - double(about["range"][0]);
    CHECK(span == Approx(name == "w" ? 3 : 1).epsilon(0.06));
    const auto found = codes(one["data"][name]);
    const std::size_t columns = one["columns"], rows = one["rows"];
    REQUIRE(found.size() == columns * rows);
    double worst = 0;
    for (std::size_t j = rows / 8; j < rows * 7 / 8; ++j)
      for (std::size_t i = columns / 8; i < columns * 7 / 8; ++i) {
        const double pitch = one["pitch"], x = double(one["corner"][0]) + pitch * (double(i) + 0.5),
                     y = double(one["corner"][1]) + pitch * (double(j) + 0.5);
        const double value = low + (found[j * columns + i] - 1) / 65534.0 * (high - low);
        worst = std::max(worst, std::abs(value - (name == "w" ? 3 * x : y)));
      }
    CHECK(worst < 1e-4 * span);
  }
  CHECK(field(json, "von_mises")["largest"] == 1e6);
  CHECK(field(json, "damage").is_null());
}

TEST_CASE("pictures in the plane: membrane forces beside moments, displacements where the plate stays flat") {
  const auto mesh = square(10);
  for (const double deflection : {0.0, 3.0}) {
    auto one = frame(mesh, 1, deflection);
    const auto n = one.state.cols();
    one.in_plane = {.displacement = Eigen::Matrix2Xd::Constant(2, n, 7), .force = Eigen::Matrix3Xd::Constant(3, n, -5)};
    post::Pictures pictures;
    pictures.open(mesh);
    pictures.look(one);
    const auto json = nlohmann::json::parse(pictures.json());
    for (const std::string name : {"Nxx", "Nyy", "Nxy"}) CHECK(field(json, name)["least"] == -5);
    for (const std::string name : {"w", "Mxx", "Mxy"}) CHECK(field(json, name).is_null() == (deflection == 0));
    for (const std::string name : {"u", "v"}) CHECK(field(json, name).is_null() == (deflection != 0));
  }
}

TEST_CASE("of many frames a few are kept, spread over the run, and the last with all its fields") {
  const auto mesh = square(10);
  const int count = GENERATE(1, 2, 6, 7, 50, 333);
  post::Pictures pictures;
  pictures.open(mesh);
  for (int i = 0; i < count; ++i) pictures.look(frame(mesh, i, i));
  const auto json = nlohmann::json::parse(pictures.json());
  const auto& frames = json["frames"];
  REQUIRE(!frames.empty());
  CHECK(frames.size() <= 7);
  CHECK(frames.size() >= std::min<std::size_t>(std::size_t(count), 3) - (count > 1 ? 1 : 0));
  CHECK(frames.back()["time"] == count - 1);
  CHECK(frames.back()["data"].contains("Mxx"));
  for (std::size_t i = 1; i < frames.size(); ++i) {
    CHECK(double(frames[i]["time"]) > double(frames[i - 1]["time"]));
    CHECK(double(frames[i]["time"]) - double(frames[i - 1]["time"]) <= std::max(1.0, count / 3.0));
    CHECK(frames[i - 1]["data"].contains("w"));
    CHECK_FALSE(frames[i - 1]["data"].contains("Mxx"));
  }
}

TEST_CASE("without frames there are no pictures, and pictures take the same room for any number of points") {
  CHECK(post::Pictures().json() == "null");
  std::vector<std::size_t> sizes;
  for (const std::size_t points : {20, 400}) {
    const auto mesh = square(points);
    post::Pictures pictures;
    pictures.open(mesh);
    pictures.look(frame(mesh, 0, 1));
    sizes.push_back(pictures.json().size());
  }
  CHECK(double(sizes[1]) < 1.05 * double(sizes[0]));
  CHECK(sizes[1] < 1'500'000);
}
