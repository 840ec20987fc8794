#include "cases/papers/bodies/clamped_plate.hpp"

#include <Eigen/Cholesky>

#include "cases/papers/bodies/equilibrium.hpp"
#include "cases/papers/bodies/fractions.hpp"
#include "cases/papers/bodies/loaded.hpp"

namespace boundary_bodies {
namespace {

constexpr double plate_young = 1e9, plate_poisson = 0.2, plate_thickness = 0.05, plate_length = 3, plate_width = 2;

/// (1 - x^2) P_i(x) and its derivative.
std::pair<double, double> bubble_shape(int i, double x) {
  double p = 1, before = 0, slope = 0, slope_before = 0;
  for (int k = 0; k < i; ++k) {
    const double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
    const double next_slope = slope_before + (2 * k + 1) * p;
    before = p, p = next, slope_before = slope, slope = next_slope;
  }
  return {(1 - x * x) * p, (1 - x * x) * slope - 2 * x * p};
}

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

}  // namespace

Solid clamped_plate() {
  return {.body = box_body({30, 20}, 3),
          .material = plane_stress_material(plate_young, plate_poisson),
          .family = family_of(2, 3),
          .spacing = 0.1,
          .horizon = 3,
          .section = plate_thickness,
          .influence = inverse};
}

RitzClampedPlate::RitzClampedPlate(int count) : n_(count) {
  const auto products = shape_products(2 * n_);
  const auto& [plain, left, both, sums] = products;
  const double x = 2 / plate_length, y = 2 / plate_width, C = plate_young / (1 - plate_poisson * plate_poisson),
               G = C * (1 - plate_poisson) / 2;
  const int all = 2 * n_ * n_;
  Eigen::MatrixXd K(all, all);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(all);
  for (int row = 0; row < all; ++row) {
    const auto [c, a, b] = shapes(row);
    if (c == 0) f[row] = clamped_plate_load * sums[a] * sums[b];
    for (int column = 0; column < all; ++column) {
      const auto [d, e, g] = shapes(column);
      const double by_x = x * x * both(a, e) * plain(b, g), by_y = y * y * plain(a, e) * both(b, g);
      K(row, column) = c != d ? 0 : c == 0 ? C * by_x + G * by_y : C * by_y + G * by_x;
      if (c == 0 && d == 1)
        K(row, column) = x * y * (C * plate_poisson * left(a, e) * left(g, b) + G * left(e, a) * left(b, g));
    }
  }
  const int half = n_ * n_;
  K.bottomLeftCorner(half, half) = K.topRightCorner(half, half).transpose();
  weights_ = K.ldlt().solve(f);
}

Eigen::Vector3d RitzClampedPlate::operator()(const Eigen::Vector3d& from_corner) const {
  Eigen::Vector3d u(0, 0, 0);
  Eigen::ArrayXd along_x(2 * n_), along_y(2 * n_);
  for (int i = 0; i < 2 * n_; ++i) {
    along_x[i] = bubble_shape(i, 2 * from_corner[0] / plate_length - 1).first;
    along_y[i] = bubble_shape(i, 2 * from_corner[1] / plate_width - 1).first;
  }
  for (int k = 0; k < 2 * n_ * n_; ++k) {
    const auto [c, a, b] = shapes(k);
    u[c] += weights_[k] * along_x[a] * along_y[b];
  }
  return u;
}

RitzClampedPlate::Products RitzClampedPlate::shape_products(int count) {
  const int points = 2 * count + 8;  // of Fejer's rule, more than the degree of the integrands
  Eigen::MatrixXd value(count, points), slope(count, points);
  Eigen::VectorXd weight(points);
  for (int q = 0; q < points; ++q) {
    const double t = (q + 0.5) * std::numbers::pi / points;
    double sum = 0;
    for (int k = 1; k <= points / 2; ++k) sum += std::cos(2 * k * t) / (4.0 * k * k - 1);
    weight[q] = 2.0 / points * (1 - 2 * sum);
    for (int i = 0; i < count; ++i) std::tie(value(i, q), slope(i, q)) = bubble_shape(i, std::cos(t));
  }
  const Eigen::MatrixXd weighted = value * weight.asDiagonal();
  return {weighted * value.transpose(), slope * weighted.transpose(), slope * weight.asDiagonal() * slope.transpose(),
          value * weight};
}

std::array<int, 3> RitzClampedPlate::shapes(int unknown) const {
  const int c = unknown / (n_ * n_), rest = unknown % (n_ * n_);
  return {c, 2 * (rest / n_) + c, 2 * (rest % n_) + c};
}

Eigen::VectorXd clamped_by_multipliers(const Solid& s, int order) {
  const plate::WeightRows all = stiffness(s, plate::Centre::real_node, order);
  const plate::SparseStiffness B = clamps(s, order);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * s.body.real);
  for (int k = 0; k < s.body.real; ++k) f[2 * k] = clamped_plate_load * s.volume();
  return solution_with_multipliers(plate::SparseStiffness(all.topRows(2 * s.body.real)), B, f,
                                   Eigen::VectorXd::Zero(B.rows()))
      .values;
}

Eigen::VectorXd uncorrected_clamped(const Solid& s, const RitzClampedPlate& reference) {
  const auto none = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); };
  const Conditions clamped{.held = [](const plate::SurfaceNode&, int) { return true; },
                           .displacement = reference,
                           .traction = none,
                           .load = [](const Eigen::Vector3d&) { return Eigen::Vector3d(clamped_plate_load, 0, 0); }};
  return uncorrected(s, clamped, reference);
}

Eigen::Array2d clamped_errors(const Solid& s, const Eigen::VectorXd& u, const RitzClampedPlate& reference) {
  Eigen::Array2d error(0, 0);
  double size = 0;
  for (int k = 0; k < s.body.real; ++k) {
    const Eigen::Vector3d exact = reference(s.at(k));
    for (int a = 0; a < 2; ++a) error[a] = std::max(error[a], std::abs(u[2 * k + a] - exact[a]));
    size = std::max(size, exact.norm());
  }
  return 100 * error / size;
}

}  // namespace boundary_bodies
