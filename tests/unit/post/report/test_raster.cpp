#include "post/report/pictures.hpp"

#include <cmath>

#include "tests/catch.hpp"

namespace {

/// A lattice of points at the middles of cells, with quads between those that are not parted by the line x = part:
/// there each side has corners of its own, with the values of the points beside them.
plate::Mesh lattice(int columns, int rows, double spacing, double part = 1e9) {
  plate::Mesh mesh;
  mesh.spacing = spacing;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) mesh.positions.emplace_back((i + 0.5) * spacing, (j + 0.5) * spacing);
  const auto id = [&](int i, int j) { return std::uint32_t(j * columns + i); };
  const auto corner = [&](int i, int j) {
    mesh.corners.push_back({{part, (j + 0.5) * spacing}, {{id(i, j), 1, 1}}});
    return std::uint32_t(mesh.positions.size() + mesh.corners.size() - 1);
  };
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i)
      if ((i + 0.5) * spacing < part && (i + 1.5) * spacing > part) {
        mesh.quads.push_back({id(i, j), corner(i, j), corner(i, j + 1), id(i, j + 1)});
        mesh.quads.push_back({corner(i + 1, j), id(i + 1, j), id(i + 1, j + 1), corner(i + 1, j + 1)});
      } else {
        mesh.quads.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
      }
  return mesh;
}

std::vector<double> values(const plate::Mesh& mesh, const auto& f) {
  std::vector<double> result;
  for (const auto& x : mesh.positions) result.push_back(f(x));
  for (const auto& corner : mesh.corners) result.push_back(result[corner.sources.front().point]);
  return result;
}

}  // namespace

TEST_CASE("what is linear over a plate is linear over its pixels, for pixels finer and coarser than the points") {
  const std::size_t pixels = GENERATE(100, 900, 20000);
  const auto mesh = lattice(30, 20, 0.1);
  const post::Raster raster(mesh, pixels);
  const auto f = [](const geometry::Point& x) { return 3 + 2 * x.x() - 5 * x.y(); };
  const auto found = raster.pixels(values(mesh, f));
  REQUIRE(found.size() == raster.columns() * raster.rows());
  CHECK(double(found.size()) == Approx(double(pixels)).epsilon(0.25));
  for (std::size_t j = 0; j < raster.rows(); ++j)
    for (std::size_t i = 0; i < raster.columns(); ++i) {
      const geometry::Point x = raster.corner() + raster.pitch() * geometry::Point(double(i) + 0.5, double(j) + 0.5);
      if (x.x() < 0.05 || x.x() > 2.95 || x.y() < 0.05 || x.y() > 1.95) continue;  // the outermost half cells
      REQUIRE(found[j * raster.columns() + i] == Approx(f(x)).margin(1e-5));
    }
}

TEST_CASE("the pixels beside a crack have the value of their side") {
  const auto mesh = lattice(20, 20, 0.05, 0.5);
  const post::Raster raster(mesh, 10000);
  const auto found = raster.pixels(values(mesh, [](const geometry::Point& x) { return x.x() < 0.5 ? -1.0 : 1.0; }));
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double x = raster.corner().x() + raster.pitch() * (double(k % raster.columns()) + 0.5);
    REQUIRE(std::isfinite(found[k]));
    if (std::abs(x - 0.5) > raster.pitch()) REQUIRE(found[k] == (x < 0.5 ? -1.0F : 1.0F));
  }
}

TEST_CASE("where there is no plate there is no value") {
  auto mesh = lattice(20, 20, 0.05);
  std::erase_if(mesh.quads,
                [&](const auto& quad) { return (mesh.positions[quad[0]] - geometry::Point(0.5, 0.5)).norm() < 0.3; });
  const post::Raster raster(mesh, 10000);
  const auto found = raster.pixels(values(mesh, [](const geometry::Point&) { return 1.0; }));
  const auto middle = raster.rows() / 2 * raster.columns() + raster.columns() / 2;
  CHECK(std::isnan(found[middle]));
}
