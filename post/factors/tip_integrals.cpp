#include "post/factors/tip_integrals.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shape/smooth_curve.hpp"
#include "plate/model/section.hpp"

namespace post {

using geometry::Point;

Eigen::Vector3d change_ahead(const TipView& plate, std::uint32_t k, const TipFrame& frame, const FreeCurvatures& free) {
  Eigen::Vector3d result(0, 0, 0);
  const Point ahead = frame.velocity(plate.positions[k]);
  const auto shares = plate.gradient_shares(k);
  for (std::size_t i = 0; i < shares.bonds.size(); ++i)
    if (const auto j = shares.bonds[i].neighbour; j < plate.plate_points)
      result += shares.share.col(Eigen::Index(i)).dot(ahead) * (free.col(j) - free.col(k));
  if (frame.curvature == 0) return result;
  // seen from axes that turn with the tip: J K - K J of the symmetric K = (xx, yy, 2 xy), which turns the other way
  const Eigen::Vector3d own = free.col(k);
  return result + frame.curvature * Eigen::Vector3d(own[2], -own[2], 2 * (own[1] - own[0]));
}

namespace {

/// Change of psi = (-theta_y, theta_x) where the axes turn with a tip that moves along a curve: kappa J psi [1/length].
Point turned(const TipFrame& frame, const plate::Kinematics<>& at) {
  return frame.curvature * Point(-at.theta_x, -at.theta_y);
}

}  // namespace

/// The strain energy is that of kappa - kappa_0; the field is carried along with the tip, while kappa_0 stays where it
/// is.
double release_of_free_curvatures(const TipView& plate, const TipFrame& frame, const Ring& ring,
                                  const plate::State& field, const NearField& near, const FreeCurvatures& free) {
  const auto stiffness = plate::LocalSection(plate.section.at(frame.origin)).bending;
  double sum = 0;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const double r = (plate.positions[k] - frame.origin).norm();
    if (r > 2 * ring.outer) continue;
    const Point slope = plate.extension_slope(k, frame, ring);
    if (ring.extension(r) == 0 && slope == Point(0, 0)) continue;
    const auto theta = plate.gradients(k, field).theta;
    Eigen::Matrix2d psi;  // psi = (-theta_y, theta_x)
    psi << -theta.row(1), theta.row(0);
    const Eigen::Vector3d kappa(psi(0, 0), psi(1, 1), psi(0, 1) + psi(1, 0)), own = free.col(k), M = stiffness * own;
    Eigen::Matrix2d held;
    held << M[0], M[2], M[2], M[1];
    const Point ahead = frame.velocity(plate.positions[k]);
    const double carried =
        -(psi * ahead - turned(frame, near(k))).dot(held * slope) + (kappa - own / 2).dot(M) * slope.dot(ahead);
    const double left = (kappa - own).dot(stiffness * change_ahead(plate, k, frame, free));
    sum += plate.areas[k] * (carried + ring.extension(r) * left);
  }
  return sum;
}

TipSurroundings::TipSurroundings(const TipView& plate, const TipFrame& frame, double radius)
    : plate_(&plate), frame_(frame) {
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const double r = (plate.positions[k] - frame_.origin).norm();
    if (r < radius) points_.push_back(k);
    if (r < 2 * plate.spacing) centre_.push_back(k);
  }
  const auto distance = [&](std::uint32_t k) { return (plate.positions[k] - frame_.origin).squaredNorm(); };
  std::stable_sort(points_.begin(), points_.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
}

Eigen::VectorXd TipSurroundings::extensions(const Ring& ring) const {
  Eigen::VectorXd result(Eigen::Index(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i)
    result[Eigen::Index(i)] = ring.extension((plate_->positions[points_[i]] - frame_.origin).norm());
  return result;
}

Eigen::VectorXd TipSurroundings::forward_work(const plate::State& state, const plate::Forces& force,
                                              double radius) const {
  const NearField field(state, plate_->positions, centre_);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto k = points_[i];
    if ((plate_->positions[k] - frame_.origin).norm() > radius) break;
    const plate::PointValues f = force.col(k);
    if (f.isZero(0)) continue;
    const auto gradients = plate_->gradients(k, state);
    const auto own = field(k);
    const Point ahead = frame_.velocity(plate_->positions[k]);
    const double w_slope = ahead.dot(gradients.shear + Point(-own.theta_y, own.theta_x));  // gamma + psi
    const Point turn = frame_.curvature * Point(-own.theta_y, own.theta_x);                // kappa J theta
    result[Eigen::Index(i)] = f[0] * w_slope + f.tail<2>().dot(gradients.theta * ahead - turn);
  }
  return result;
}

namespace {

/// Values of a field at a point for the domain integral: gradients of psi, shear angles and changes ahead.
struct PointStrains {
  Eigen::Matrix2d psi = Eigen::Matrix2d::Zero();  // row: psi_x, psi_y; column: d/dx, d/dy
  geometry::Point gamma{0, 0};
  double w_slope = 0;               // along the velocity, of w
  geometry::Point psi_ahead{0, 0};  // of psi
};

/// The points of a ring and the classical integral over them (theory (48)).
class DomainIntegral : public EnergyRelease {
public:
  DomainIntegral(const TipView& plate, const TipFrame& frame, const Ring& ring)
      : shapes_(plate.shapes), section_(plate.section.at(frame.origin)), frame_(frame) {
    for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
      const Point x = plate.positions[k] - frame.origin;
      if (x.norm() > 2 * ring.outer) continue;
      const Point slope = plate.extension_slope(k, frame, ring);
      if (slope != Point(0, 0))
        points_.push_back({.k = k,
                           .slope = plate.areas[k] * slope,
                           .ahead = frame.velocity(plate.positions[k]),
                           .shear_stiffness = plate.shear_stiffness(k),
                           .shares = plate.gradient_shares(k)});
    }
  }

  double operator()(const NearField& u) const override {
    double sum = 0;
    for (const auto& point : points_) sum += release(point, strains(point, u));
    return sum;
  }

private:
  struct RingPoint {
    std::uint32_t k;
    Point slope;                      // area times grad q
    Point ahead;                      // velocity with the tip
    Eigen::Matrix2d shear_stiffness;  // [force / length]
    plate::GradientShares shares;
  };

  PointStrains strains(const RingPoint& point, const NearField& field) const {
    PointStrains result;
    const auto own = field(point.k);
    for (std::size_t n = 0; n < point.shares.bonds.size(); ++n) {
      const auto& bond = point.shares.bonds[n];
      const auto other = field(bond.neighbour);
      const Point share = point.shares.share.col(Eigen::Index(n));
      result.psi += Point(own.theta_y - other.theta_y, other.theta_x - own.theta_x) * share.transpose();
      result.gamma += share * shear_difference(shapes_[bond.vector_id], own, other);
    }
    result.w_slope = (result.gamma + Point(-own.theta_y, own.theta_x)).dot(point.ahead);
    result.psi_ahead = result.psi * point.ahead - turned(frame_, own);
    return result;
  }

  /// A (M_ab psi_a,x' + Q_b w,x' - W delta_bx') q,b; along a curve x' is the velocity, and the axes turn with it.
  double release(const RingPoint& point, const PointStrains& u) const {
    const Eigen::Vector3d M = section_.bending * Eigen::Vector3d(u.psi(0, 0), u.psi(1, 1), u.psi(0, 1) + u.psi(1, 0));
    Eigen::Matrix2d moments;
    moments << M[0], M[2], M[2], M[1];
    const Point shear = point.shear_stiffness * u.gamma;
    const double energy = (moments.cwiseProduct(u.psi).sum() + shear.dot(u.gamma)) / 2;
    return point.slope.dot(moments * u.psi_ahead + shear * u.w_slope - energy * point.ahead);
  }

  const std::vector<plate::BondShape>& shapes_;
  plate::LocalSection section_;  // the same all over the ring
  TipFrame frame_;
  std::vector<RingPoint> points_;
};

/// Length over which the crack runs back from its tip straight, or on a circle; another end of it counts at 0.7 of its
/// distance, because the field there is singular too (an integral over a ring up to the other tip of a crack 25
/// spacings long was 1.5 % off). `vertices`: from the tip on.
double unbent_length(const geometry::Polyline& vertices, const TipFrame& frame, double spacing, double share_of_end) {
  constexpr double turn = 0.5;  // of a circle [rad]
  constexpr double off = 0.01;  // a curve may leave its circle by this share of the distance from the tip
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const Point x = vertices[i] - frame.origin;
    const bool bent = frame.curvature != 0;
    const double aside =
        std::abs(bent ? frame.by_circle(vertices[i]).y() : x.x() * frame.ahead.y() - x.y() * frame.ahead.x());
    const double reached = (vertices[i - 1] - frame.origin).norm();
    if (bent && x.norm() * std::abs(frame.curvature) > turn) {  // it may come back
      const geometry::Polyline rest(vertices.begin() + std::ptrdiff_t(i), vertices.end());
      return std::min({turn / std::abs(frame.curvature), geometry::distance(rest, frame.origin),
                       share_of_end * (vertices.back() - frame.origin).norm()});
    }
    if (aside > std::max(spacing / 4, bent ? off * x.norm() : 0)) return reached;
  }
  return share_of_end * (vertices.back() - frame.origin).norm();
}

}  // namespace

std::unique_ptr<EnergyRelease> domain_integral(const TipView& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<DomainIntegral>(plate, frame, ring);
}

TipFrame frame_of(const geometry::CrackPath& path, const geometry::Tip& tip, double spacing, bool curved) {
  TipFrame result(tip);
  const auto circle = curved ? geometry::tip_circle(path, tip.at_back, spacing) : std::nullopt;
  if (!circle) return result;
  result.ahead = circle->direction, result.curvature = circle->curvature, result.curve = path.vertices;
  if (!tip.at_back) std::ranges::reverse(result.curve);
  return result;
}

double unbent_length(const TipFrame& frame, double spacing) {
  return unbent_length({frame.curve.rbegin(), frame.curve.rend()}, frame, spacing, 0.7);
}

double clear_distance(const geometry::Outline& outline, const std::vector<geometry::CrackPath>& paths,
                      const geometry::Tip& tip, double spacing, bool curved) {
  const auto& path = paths[tip.crack];
  auto vertices = path.vertices;
  if (tip.at_back) std::reverse(vertices.begin(), vertices.end());
  const bool ends_in_plate = (tip.at_back ? path.front : path.back) != geometry::End::mouth;
  double clear = unbent_length(vertices, frame_of(path, tip, spacing, curved), spacing, ends_in_plate ? 0.7 : 1.0);
  for (const auto& edge : geometry::straight_edges(outline))
    clear = std::min(clear, geometry::distance({edge.from, edge.to}, tip.position));
  for (const auto& circle : geometry::circles(outline))
    clear = std::min(clear, std::abs((tip.position - circle.centre).norm() - circle.radius));
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (i != tip.crack) clear = std::min(clear, geometry::distance(paths[i].vertices, tip.position));
  return clear;
}

geometry::Tip centred(const geometry::Tip& tip, const TipView& plate) {
  const TipFrame frame(tip);
  const double behind = 16 * plate.spacing;  // two steps of the staircase that a crack at 7 degrees is
  double above = behind, below = -behind;
  for (std::size_t k = 0; k < plate.plate_points; ++k) {
    const Point x = frame.local(plate.positions[k]);
    if (x.x() > -1e-3 * plate.spacing || x.x() < -behind || std::abs(x.y()) > behind) continue;
    if (plate::face_of(x.y(), frame.left(), plate.spacing) > 0)
      above = std::min(above, x.y());
    else
      below = std::max(below, x.y());
  }
  geometry::Tip result = tip;
  result.position += (above + below) / 2 * frame.left();
  return result;
}

std::vector<Ring> rings(double clear, double spacing, bool graded) {
  const double most = (clear - spacing / 2) / spacing;
  std::vector<Ring> result;
  if (graded && most > 16) {
    for (const double share : {0.6, 0.4, 0.8})
      result.push_back({std::max(share * clear / 8, 3 * spacing), share * clear});
    return result;
  }
  for (const double outer : {16.0, 11.0, 24.0, 7.0})
    if (outer <= most * (1 + 1e-9)) result.push_back({outer / 2 * spacing, outer * spacing});
  if (most > 4 && (result.empty() || (most < 11 && most > 8.5)))
    result.insert(result.begin(), {most / 2 * spacing, most * spacing});
  return result;
}

}  // namespace post
