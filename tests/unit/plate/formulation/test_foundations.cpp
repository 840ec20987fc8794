#include "plate/formulation/foundations.hpp"

#include <Eigen/Eigenvalues>

#include "geometry/cells/tessellation.hpp"
#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/supports.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

const auto outline = geometry::rectangle(0, 0, 1.2, 1);
const std::vector<std::optional<geometry::Hole>> patches{
    std::nullopt, geometry::Circle{{0.52, 0.47}, 0.31, ""},
    geometry::Polygon{{{0.11, 0.13}, {0.97, 0.21}, {0.46, 1.3}}, {"", "", ""}}};

/// w = c + g . x with psi = grad w.
State linear(const std::vector<Point>& positions, double c, const Point& g) {
  State u(3, Eigen::Index(positions.size()));
  for (Eigen::Index k = 0; k < u.cols(); ++k) u.col(k) << c + g.dot(positions[std::size_t(k)]), g.y(), -g.x();
  return u;
}

struct Soil {
  ElasticSupport elastic_support;
  std::vector<Point> positions;
  std::function<Forces(const Load&)> loaded;
};

std::vector<Soil> soils(const Foundation& foundation, double spacing = 0.1) {
  std::vector<Soil> result;
  const auto cloud = geometry::lattice(outline, spacing);
  ElasticSupportSum sum(cloud.size());
  add_foundation(foundation, cloud, sum);
  result.push_back({std::move(sum).taken("foundation0", {}), cloud.positions,
                    [cloud](const Load& load) { return nodal_forces(load, cloud, outline); }});
  for (const geometry::Grading& grading : {geometry::Grading{}, geometry::Grading{0.03, std::nullopt, 0.2}}) {
    const auto cells = geometry::tessellation(outline, {}, spacing, {{0.33, 0.47}}, grading);
    ElasticSupportSum of_cells(cells.positions.size());
    add_foundation(foundation, cells, of_cells);
    result.push_back({std::move(of_cells).taken("foundation0", {}), cells.positions, [cells](const Load& load) {
                        return nodal_forces(load, cells, std::vector<double>(cells.positions.size()));
                      }});
  }
  return result;
}

Eigen::MatrixXd dense(const ElasticSupport& a) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(Eigen::Index(3 * a.points), Eigen::Index(3 * a.points));
  const auto number = [](const Dof& dof) { return index_by_points(Eigen::Index(dof.point), dof.component); };
  a.for_each([&](const Dof& row, const Dof& column, double value) { K(number(row), number(column)) += value; });
  return K;
}

}  // namespace

TEST_CASE("a foundation under a linear deflection acts as the pressure -k w does") {
  const Point g(0.7, -0.4);
  for (const auto& patch : patches)
    for (const auto& [soil, positions, loaded] : soils({25, 0, patch})) {
      const Load load{Pressure{.value = -25 * 0.3, .gradient = -25 * g, .patch = patch}};
      const Forces expected = loaded(load), found = soil.force(linear(positions, 0.3, g));
      CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff() + 1e-15);
    }
}

TEST_CASE("a foundation feels deflections that change their sign from one corner of its cells to the next") {
  const double spacing = 0.1, area = 1.2;
  const auto cells = geometry::tessellation(outline, {}, spacing, {}, {});
  const auto energy = [&](const Foundation& foundation) {
    ElasticSupportSum sum(cells.positions.size());
    add_foundation(foundation, cells, sum);
    const auto soil = std::move(sum).taken("foundation0", {});
    State u = State::Zero(3, Eigen::Index(cells.positions.size()));
    for (std::size_t k = 0; k < cells.positions.size(); ++k) {
      const Point x = cells.positions[k] / spacing;
      u(0, Eigen::Index(k)) = (std::lround(x.x()) + std::lround(x.y())) % 2 == 0 ? 1 : -1;
    }
    return soil.energy(u);
  };
  REQUIRE(cells.triangles.empty());
  // of the function that is linear along the sides of cells: its mean square is 1/24 by the rule that is used, that of
  // its slope 8/3 / spacing^2
  CHECK(energy({25, 0, {}}) == Approx(25 * area / 24 / 2).epsilon(1e-12));
  CHECK(energy({0, 25, {}}) == Approx(25 * area * 8 / 3 / spacing / spacing / 2).epsilon(1e-12));
}

TEST_CASE("the shear layer of a foundation has its energy under linear deflections, and none under translations") {
  const Point g(0.7, -0.4);
  for (const auto& patch : patches) {
    const double area = patch ? [&] {
      const geometry::Patch shape(*patch);
      return geometry::moments(shape.common(outline.outer.vertices), {0, 0}).area;
    }()
                              : 1.2;
    for (const auto& [soil, positions, loaded] : soils({0, 8, patch})) {
      CHECK(soil.energy(linear(positions, 0.3, g)) == Approx(8 * g.squaredNorm() * area / 2).epsilon(1e-12));
      CHECK(std::abs(soil.energy(linear(positions, 5, {0, 0}))) < 1e-10);  // rounding of 8 x 5^2 in every link
    }
  }
}

TEST_CASE("a foundation is symmetric and resists every motion or none") {
  for (const auto& patch : patches)
    for (const auto& [soil, positions, loaded] : soils({3, 2, patch}, 0.2)) {
      const Eigen::MatrixXd K = dense(soil);
      CHECK((K - K.transpose()).norm() < 1e-14 * K.norm());
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
      CHECK(values[0] > -1e-14 * values[values.size() - 1]);
    }
}

TEST_CASE("a shear layer ties the faces of a crack, and nothing else does") {
  const auto paths = geometry::crack_paths(outline, {{{0.25, 0.5}, {0.75, 0.5}}}, 1e-9);
  const auto cells = geometry::tessellation(outline, paths, 0.05, {}, {});
  State jump = State::Zero(3, Eigen::Index(cells.positions.size()));
  std::vector<char> below(cells.positions.size(), 1);  // of the faces: those of cells above it
  for (const auto& square : cells.squares)
    for (const auto k : square)
      if (cells.positions[square[2]].y() > 0.5 + 1e-9 && cells.positions[k].y() > 0.5 - 1e-9) below[k] = 0;
  for (std::size_t k = 0; k < below.size(); ++k)
    if (std::abs(cells.positions[k].y() - 0.5) < 1e-9 && !below[k]) jump(0, Eigen::Index(k)) = 1;
  ElasticSupportSum sum(cells.positions.size()), bare(cells.positions.size());
  add_foundation({0, 8, {}}, cells, sum);
  add_foundation({0, 0, {}}, cells, bare);
  CHECK(std::move(sum).taken("", {}).energy(jump) > 8.0 / 2 * 64 * 9);  // (73): nine points of a face that part by 1
  CHECK(std::move(bare).taken("", {}).row.empty());
}
