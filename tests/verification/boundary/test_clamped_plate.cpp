// The clamped plate of Sca21 6.2 by Lagrange multipliers; local reference by Ritz's method.
#include <catch2/catch.hpp>

#include "tests/dense.hpp"
#include "tests/verification/boundary/fractions.hpp"
#include "tests/verification/boundary/loaded.hpp"

namespace bb = boundary_bodies;
using bb::Solid;

namespace {

constexpr double young = 1e9, poisson = 0.2, thickness = 0.05, length = 3, width = 2, load = 1e6;  // load: any

/// Sca21, table 4; plane stress, as the plate is thin; influence as for its bars.
Solid plate_in_plane() {
  return {plate::box_body({30, 20}, 3),
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

/// Least energy over products of shapes: u even in x and y, v odd in both, the middle of the plate at 0.
class Ritz {
public:
  explicit Ritz(int count) : n_(count) {
    const int all = 2 * n_ * n_;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(all, all);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(all);
    const Eigen::Matrix3d C =
        young / (1 - poisson * poisson) * Eigen::Matrix3d{{1, poisson, 0}, {poisson, 1, 0}, {0, 0, (1 - poisson) / 2}};
    const int points = 4 * n_ + 8;  // more than the degree of the integrands
    for (int a = 0; a < points; ++a)
      for (int b = 0; b < points; ++b) {
        const auto [x, wx] = quadrature(a, points);
        const auto [y, wy] = quadrature(b, points);
        const auto [value, strain] = at(x, y);
        const double area = wx * wy * length * width / 4;
        K.noalias() += area * strain.transpose() * C * strain;
        f += area * load * value.row(0).transpose();
      }
    weights_ = dense::solution(K, f);
  }

  Eigen::Vector3d operator()(const Eigen::Vector3d& from_corner) const {
    const auto [value, strain] = at(2 * from_corner[0] / length - 1, 2 * from_corner[1] / width - 1);
    const Eigen::Vector2d u = value * weights_;
    return {u[0], u[1], 0};
  }

private:
  /// Fejer's rule.
  static std::pair<double, double> quadrature(int i, int points) {
    const double t = (i + 0.5) * std::numbers::pi / points;
    double sum = 0;
    for (int k = 1; k <= points / 2; ++k) sum += std::cos(2 * k * t) / (4.0 * k * k - 1);
    return {std::cos(t), 2.0 / points * (1 - 2 * sum)};
  }

  /// Displacements and strains (2 gamma_xy) of each product.
  std::pair<Eigen::MatrixXd, Eigen::MatrixXd> at(double x, double y) const {
    Eigen::MatrixXd value = Eigen::MatrixXd::Zero(2, 2 * n_ * n_), strain = Eigen::MatrixXd::Zero(3, 2 * n_ * n_);
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j)
        for (int c = 0; c < 2; ++c) {
          const auto [p, dp] = shape(2 * i + c, x);
          const auto [q, dq] = shape(2 * j + c, y);
          const int column = c * n_ * n_ + i * n_ + j;
          value(c, column) = p * q;
          const double by_x = dp * q * 2 / length, by_y = p * dq * 2 / width;
          strain.col(column) = c == 0 ? Eigen::Vector3d(by_x, 0, by_y) : Eigen::Vector3d(0, by_y, by_x);
        }
    return {value, strain};
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
  return plate::solution_with_multipliers(plate::SparseStiffness(all.topRows(2 * s.body.real)), B, f,
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
