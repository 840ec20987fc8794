// The clamped plate of Sca21 6.2 by Lagrange multipliers; local reference by Ritz's method.

#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"
#include "tests/verification/boundary/fractions.hpp"
#include "tests/verification/boundary/loaded.hpp"

namespace bb = boundary_bodies;
using bb::Solid;

namespace {

constexpr double young = 1e9, poisson = 0.2, thickness = 0.05, length = 3, width = 2, load = 1e6;  // load: any

/// Sca21, table 4; plane stress, as the plate is thin; influence as for its bars.
Solid plate_in_plane() {
  return {edge_bodies::box_body({30, 20}, 3),
          bb::plane_stress_material(young, poisson),
          bb::family_of(2, 3),
          0.1,
          3,
          thickness,
          bb::inverse};
}

/// (1 - x^2) P_i(x) and its derivative.
std::pair<double, double> shape(int i, double x) {
  double p = 1, before = 0, slope = 0, slope_before = 0;
  for (int k = 0; k < i; ++k) {
    const double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
    const double next_slope = slope_before + (2 * k + 1) * p;
    before = p, p = next, slope_before = slope, slope = next_slope;
  }
  return {(1 - x * x) * p, (1 - x * x) * slope - 2 * x * p};
}

/// Least energy over products of shapes: u even in x and y, v odd in both, the middle of the plate at 0. Unknown
/// c n^2 + i n + j: component c, shapes 2 i + c along x and 2 j + c along y.
class Ritz {
public:
  explicit Ritz(int count) : n_(count) {
    const auto products = shape_products(2 * n_);
    const auto& [plain, left, both, sums] = products;
    const double x = 2 / length, y = 2 / width, C = young / (1 - poisson * poisson), G = C * (1 - poisson) / 2;
    const int all = 2 * n_ * n_;
    Eigen::MatrixXd K(all, all);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(all);
    for (int row = 0; row < all; ++row) {
      const auto [c, a, b] = shapes(row);
      if (c == 0) f[row] = load * sums[a] * sums[b];
      for (int column = 0; column < all; ++column) {
        const auto [d, e, g] = shapes(column);
        const double by_x = x * x * both(a, e) * plain(b, g), by_y = y * y * plain(a, e) * both(b, g);
        K(row, column) = c != d ? 0 : c == 0 ? C * by_x + G * by_y : C * by_y + G * by_x;
        if (c == 0 && d == 1)
          K(row, column) = x * y * (C * poisson * left(a, e) * left(g, b) + G * left(e, a) * left(b, g));
      }
    }
    const int half = n_ * n_;
    K.bottomLeftCorner(half, half) = K.topRightCorner(half, half).transpose();
    weights_ = dense::solution(K, f);
  }

  Eigen::Vector3d operator()(const Eigen::Vector3d& from_corner) const {
    Eigen::Vector3d u(0, 0, 0);
    Eigen::ArrayXd along_x(2 * n_), along_y(2 * n_);
    for (int i = 0; i < 2 * n_; ++i) {
      along_x[i] = shape(i, 2 * from_corner[0] / length - 1).first;
      along_y[i] = shape(i, 2 * from_corner[1] / width - 1).first;
    }
    for (int k = 0; k < 2 * n_ * n_; ++k) {
      const auto [c, a, b] = shapes(k);
      u[c] += weights_[k] * along_x[a] * along_y[b];
    }
    return u;
  }

private:
  /// Integrals over [-1, 1] of shape a times shape b, of the derivative of a times b, of both derivatives, of shape a.
  struct Products {
    Eigen::MatrixXd plain, left, both;
    Eigen::VectorXd sums;
  };

  static Products shape_products(int count) {
    const int points = 2 * count + 8;  // of Fejer's rule, more than the degree of the integrands
    Eigen::MatrixXd value(count, points), slope(count, points);
    Eigen::VectorXd weight(points);
    for (int q = 0; q < points; ++q) {
      const double t = (q + 0.5) * std::numbers::pi / points;
      double sum = 0;
      for (int k = 1; k <= points / 2; ++k) sum += std::cos(2 * k * t) / (4.0 * k * k - 1);
      weight[q] = 2.0 / points * (1 - 2 * sum);
      for (int i = 0; i < count; ++i) std::tie(value(i, q), slope(i, q)) = shape(i, std::cos(t));
    }
    const Eigen::MatrixXd weighted = value * weight.asDiagonal();
    return {weighted * value.transpose(), slope * weighted.transpose(), slope * weight.asDiagonal() * slope.transpose(),
            value * weight};
  }

  std::array<int, 3> shapes(int unknown) const {
    const int c = unknown / (n_ * n_), rest = unknown % (n_ * n_);
    return {c, 2 * (rest / n_) + c, 2 * (rest % n_) + c};
  }

  int n_;
  Eigen::VectorXd weights_;
};

/// Rows of values at the edges that are 0: both components, at the cells of corners the normal one only (Sca21, remark
/// 4).
plate::SparseStiffness clamps(const Solid& s, int order) {
  const plate::WeightRows values = plate::for_each_unknown(plate::surface_values(s.body, order), 2);
  const auto& surface = s.body.surface;
  std::vector<int> faces(std::size_t(s.body.real), 0);
  for (const auto& face : surface) ++faces[std::size_t(face.inner)];
  std::vector<Eigen::Triplet<double>> rows;
  int count = 0;
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (int a = 0; a < 2; ++a)
      if (a == surface[i].axis || faces[std::size_t(surface[i].inner)] == 1)
        rows.emplace_back(count++, 2 * int(i) + a, 1.0);
  plate::WeightRows chosen(count, 2 * Eigen::Index(surface.size()));
  chosen.setFromTriplets(rows.begin(), rows.end());
  return plate::WeightRows(chosen * values);
}

Eigen::VectorXd by_multipliers(const Solid& s, int order) {
  const plate::WeightRows all = bb::stiffness(s, plate::Centre::real_node, order);
  const plate::SparseStiffness B = clamps(s, order);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * s.body.real);
  for (int k = 0; k < s.body.real; ++k) f[2 * k] = load * s.volume();
  return edge_bodies::solution_with_multipliers(plate::SparseStiffness(all.topRows(2 * s.body.real)), B, f,
                                                Eigen::VectorXd::Zero(B.rows()))
      .values;
}

/// Sca21 70, in percent of the largest displacement: of u, of v.
Eigen::Array2d largest_errors(const Solid& s, const Eigen::VectorXd& u, const Ritz& reference) {
  Eigen::Array2d error(0, 0);
  double size = 0;
  for (int k = 0; k < s.body.real; ++k) {
    const Eigen::Vector3d exact = reference(s.at(k));
    for (int a = 0; a < 2; ++a) error[a] = std::max(error[a], std::abs(u[2 * k + a] - exact[a]));
    size = std::max(size, exact.norm());
  }
  return 100 * error / size;
}

}  // namespace

TEST_CASE("clamped plate of Sca21 6.2: the reference is there to four figures") {
  const Ritz fine(12), coarse(9);
  double off = 0, size = 0;
  const Solid s = plate_in_plane();
  for (int k = 0; k < s.body.real; ++k) {
    off = std::max(off, (fine(s.at(k)) - coarse(s.at(k))).norm());
    size = std::max(size, fine(s.at(k)).norm());
  }
  CHECK(off < 1e-4 * size);  // measured: 2.2e-5
}

TEST_CASE("clamped plate of Sca21 6.2: errors fall with the order, from 1.5 % to the 0.5 % of a finite horizon") {
  const Solid s = plate_in_plane();
  const Ritz reference(12);
  const bb::Conditions clamped{[](const plate::SurfaceNode&, int) { return true; }, reference,
                               [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); },
                               [](const Eigen::Vector3d&) { return Eigen::Vector3d(load, 0, 0); }};
  const auto none = largest_errors(s, bb::uncorrected(s, clamped, reference), reference);
  CHECK((none - Eigen::Array2d(7.430, 1.002)).abs().maxCoeff() < 0.005);  // u, v in percent of the largest displacement
  const std::vector<Eigen::Array2d> expected{
      {1.471, 1.479}, {0.587, 0.519}, {0.487, 0.245}, {0.488, 0.222}, {0.490, 0.219}};
  const Eigen::VectorXd converged = by_multipliers(s, 5);
  double before = 1e9;
  for (int order = 1; order <= 5; ++order) {
    const Eigen::VectorXd u = by_multipliers(s, order);
    CHECK((largest_errors(s, u, reference) - expected[std::size_t(order - 1)]).abs().maxCoeff() < 0.002);
    const double left = (u - converged).cwiseAbs().maxCoeff() / converged.cwiseAbs().maxCoeff();
    if (order < 5) CHECK(left < 0.6 * before);  // measured: 0.40, 0.23, 0.31
    before = left;
  }
}
