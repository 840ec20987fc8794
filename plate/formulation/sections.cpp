#include "plate/formulation/sections.hpp"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/cells/tessellation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"

namespace plate {
namespace {

using geometry::Point;
using Corners = std::array<Point, 3>;

Point middle(const Corners& t) {
  return (t[0] + t[1] + t[2]) / 3;
}

/// Middles of the four parts of a triangle that its sides' middles make.
std::array<Point, 4> samples(const Corners& t) {
  const Point a = (t[1] + t[2]) / 2, b = (t[2] + t[0]) / 2, c = (t[0] + t[1]) / 2;
  return {middle({t[0], c, b}), middle({c, t[1], a}), middle({b, a, t[2]}), middle({a, b, c})};
}

LocalSection local(const Section& section, const Point& x) {
  const Section own = section.at(x);
  const auto refuse = [&](Subject subject, const char* words, double value) {
    throw Refused({{subject, 0,
                    fmt::format("the {} is {:.4g} at ({:.6g}, {:.6g}), must be > 0 and finite all over the "
                                "plate",
                                words, value, x.x(), x.y())}});
  };
  if (!(own.thickness > 0) || !std::isfinite(own.thickness))
    refuse(Subject::thickness_factor, "thickness", own.thickness);
  if (own.isotropic() && (!(own.young > 0) || !std::isfinite(own.young)))
    refuse(Subject::young_factor, "modulus", own.young);
  return own;
}

/// visit(point, place, area) for samples of the parts of cells that belong to points: of a triangle what is between a
/// corner, the middles of its sides and its own middle.
void for_samples(const geometry::Tessellation& cells,
                 const std::function<void(std::uint32_t, const Point&, double)>& visit) {
  const auto triangle = [&](const geometry::Tessellation::Triangle& cell, double share) {
    const Corners t{cells.positions[cell[0]], cells.positions[cell[1]], cells.positions[cell[2]]};
    const Point m = middle(t), side = t[1] - t[0], other = t[2] - t[0];
    const double part = share * std::abs(side.x() * other.y() - side.y() * other.x()) / 48;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &own = t[i], next = (t[i] + t[(i + 1) % 3]) / 2, last = (t[i] + t[(i + 2) % 3]) / 2;
      for (const auto& half : {Corners{own, next, m}, Corners{own, m, last}})
        for (const auto& x : samples(half)) visit(cell[i], x, part);
    }
  };
  for (const auto& [a, b, c, d] : cells.squares)  // along both diagonals, as families are; each half as much
    for (const auto& half : {geometry::Tessellation::Triangle{a, b, c}, {a, c, d}, {a, b, d}, {b, c, d}})
      triangle(half, 0.5);
  for (const auto& cell : cells.triangles) triangle(cell, 1);
}

/// Stiffness of layers side by side along n: curvatures across them and twists jump and moments do not, those along
/// them do not jump; shear angles likewise. Sums over samples, in the axes n and t.
struct Layers {
  double area = 0;
  Point n{1, 0};
  Eigen::Matrix2d across = Eigen::Matrix2d::Zero();  // of A^-1, A of kappa_nn and 2 kappa_nt
  Eigen::Vector2d mixed{0, 0};                       // of A^-1 B, B to kappa_tt
  double along = 0;                                  // of C - B A^-1 B
  double shear_across = 0, shear_mixed = 0, shear_along = 0;

  /// Transformation of curvatures along x and y into curvatures nn, nt, tt [3 x 3].
  Eigen::Matrix3d turn() const {
    const double c = n.x(), s = n.y();
    Eigen::Matrix3d result;
    result << c * c, s * s, c * s, -2 * c * s, 2 * c * s, c * c - s * s, s * s, c * c, -c * s;
    return result;
  }
  void add(const LocalSection& l, double part) {
    const Eigen::Matrix3d back = turn().inverse(), D = back.transpose() * l.bending * back;
    const Eigen::Matrix2d inverse = D.topLeftCorner<2, 2>().inverse();
    const Eigen::Vector2d B = D.topRightCorner<2, 1>();
    area += part, across += part * inverse, mixed += part * inverse * B;
    along += part * (D(2, 2) - B.dot(inverse * B));
    const Point t(-n.y(), n.x());
    const double nn = n.dot(l.shear * n), nt = n.dot(l.shear * t), tt = t.dot(l.shear * t);
    if (nn == 0) return;  // of a membrane
    shear_across += part / nn, shear_mixed += part * nt / nn, shear_along += part * (tt - nt * nt / nn);
  }
  void set(LocalSection& l) const {
    Eigen::Matrix3d D;
    const Eigen::Matrix2d A = (across / area).inverse();
    const Eigen::Vector2d m = mixed / area, B = A * m;
    D << A, B, B.transpose(), along / area + m.dot(B);
    l.bending = turn().transpose() * D * turn();
    if (shear_across == 0) return;
    Eigen::Matrix2d S, axes;
    const double nn = area / shear_across, m_shear = shear_mixed / area;
    S << nn, nn * m_shear, nn * m_shear, shear_along / area + nn * m_shear * m_shear;
    axes << n.x(), -n.y(), n.y(), n.x();
    l.shear = axes * S * axes.transpose();
  }
};

}  // namespace

PointSections::PointSections(const Section& section, const geometry::Tessellation& cells)
    : simple_(section.isotropic()) {
  if (section.uniform()) {
    kinds_.emplace_back(section);
    return;
  }
  // means; where the stiffness varies, across and along the direction in which it does
  const auto points = cells.positions.size();
  std::vector<LocalSection> sums(points);
  std::vector<Point> first(points, Point(0, 0)), slope(points, Point(0, 0));
  std::vector<Layers> layers(points);
  for_samples(cells, [&](std::uint32_t k, const Point& x, double part) {
    const auto l = local(section, x);
    sums[k].add(l, part), layers[k].area += part;
    first[k] += part * (x - cells.positions[k]), slope[k] += part * l.bending(0, 0) * (x - cells.positions[k]);
  });
  kinds_.resize(points);
  for (std::size_t k = 0; k < points; ++k) {
    kinds_[k].add(sums[k], 1 / layers[k].area);
    const Point way = slope[k] - kinds_[k].bending(0, 0) * first[k];
    const double size = kinds_[k].bending(0, 0) * std::pow(layers[k].area, 1.5);
    layers[k] = {};
    if (way.norm() > 1e-9 * size) layers[k].n = way.normalized();
  }
  for_samples(cells, [&](std::uint32_t k, const Point& x, double part) { layers[k].add(local(section, x), part); });
  for (std::size_t k = 0; k < points; ++k) layers[k].set(kinds_[k]);
}

void PointSections::add_masses(const std::vector<double>& masses, const std::vector<double>& areas) {
  if (masses.empty()) return;
  if (uniform()) kinds_.assign(areas.size(), kinds_.front());
  for (std::size_t k = 0; k < areas.size(); ++k) kinds_[k].mass += masses[k] / areas[k];
}

namespace {

/// Squares of shares: those of the stresses themselves may be beyond double precision.
double von_mises(const Eigen::Vector3d& stress) {
  const double size = stress.lpNorm<Eigen::Infinity>();
  if (size == 0) return 0;
  const Eigen::Vector3d s = stress / size;
  return size * std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]);
}

}  // namespace

PrincipalStresses principal(const Eigen::Vector3d& stress) {
  const double mean = (stress[0] + stress[1]) / 2, half = (stress[0] - stress[1]) / 2;
  const double radius = std::hypot(half, stress[2]);
  return {mean + radius, mean - radius, std::atan2(stress[2], half) / 2 * 180 / std::numbers::pi};
}

Eigen::Vector3d stress_at_top(const Eigen::Vector3d& moments, const Section& section) {
  const double h = section.thickness, by_moment = section.law == PlateLaw::membrane ? 1 / h : 6 / (h * h);
  if (section.isotropic()) return moments * by_moment;
  const LocalSection l(section);
  return l.top * l.bending.ldlt().solve(moments);
}

double von_mises(const Eigen::Vector3d& moments, const Section& section) {
  return von_mises(stress_at_top(moments, section));
}

void set_moments(Resultants& result, Eigen::Index k, const Eigen::Vector3d& moments, const Section& section) {
  result.moments.col(k) = moments;
  result.top.col(k) = stress_at_top(moments, section);
  result.von_mises[k] = von_mises(Eigen::Vector3d(result.top.col(k)));
}

void add_membrane_forces(Resultants& bending, const PointSections& of_bending, const Resultants& membrane,
                         const PointSections& of_membrane) {
  const auto count = bending.moments.cols();
  bending.bottom = Eigen::Matrix3Xd::Zero(3, count);
  const auto stress = [](const LocalSection& section, const Eigen::Vector3d& resultant) -> Eigen::Vector3d {
    return section.top * section.bending.inverse() * resultant;
  };
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Vector3d bent = stress(of_bending[std::size_t(k)], bending.moments.col(k)),
                          stretched = stress(of_membrane[std::size_t(k)], membrane.moments.col(k));
    bending.top.col(k) = stretched + bent, bending.bottom.col(k) = stretched - bent;
    bending.von_mises[k] =
        std::max(von_mises(Eigen::Vector3d(stretched + bent)), von_mises(Eigen::Vector3d(stretched - bent)));
  }
}

void couple(Resultants& bending, Resultants& membrane, const Section& section, const Heat* heat) {
  const auto by = [&](PlateLaw law) {
    Section result = section;
    result.law = law;
    return LocalSection(result).bending;
  };
  const Eigen::Matrix3d A = by(PlateLaw::membrane), B = by(PlateLaw::coupling), D = by(PlateLaw::bending);
  const Eigen::Matrix3d top = plane_stress(section.plies.back()), bottom = plane_stress(section.plies.front());
  const double half = section.thickness / 2;
  const Eigen::Matrix3Xd strains = A.ldlt().solve(membrane.moments), curvatures = D.ldlt().solve(bending.moments);
  bending.moments += B * strains, membrane.moments += B * curvatures;
  Eigen::Matrix3Xd at_top = strains + half * curvatures, at_bottom = strains - half * curvatures;
  if (heat && !heat->none()) {
    const auto of = [&](PlateLaw law) {
      Section result = section;
      result.law = law;
      return moments_held_flat(result);
    };
    const Eigen::RowVectorXd mean = heat->curvature.transpose(), across = heat->beside.transpose();
    const Eigen::Vector3d with_other = of(PlateLaw::coupling);
    membrane.moments -= of(PlateLaw::membrane) * mean + with_other * across;
    bending.moments -= with_other * mean + of(PlateLaw::bending) * across;
    at_top -= free_strains(section, section.plies.back()) * (mean + half * across);
    at_bottom -= free_strains(section, section.plies.front()) * (mean - half * across);
  }
  bending.top = top * at_top, bending.bottom = bottom * at_bottom;
  for (Eigen::Index k = 0; k < strains.cols(); ++k)
    bending.von_mises[k] =
        std::max(von_mises(Eigen::Vector3d(bending.top.col(k))), von_mises(Eigen::Vector3d(bending.bottom.col(k))));
  membrane.von_mises = bending.von_mises, membrane.top = bending.top, membrane.bottom = bending.bottom;
}

Resultants resultants_of(Eigen::Index points) {
  return {Eigen::Matrix3Xd(3, points), Eigen::Matrix2Xd(2, points), Eigen::VectorXd(points),
          Eigen::Matrix3Xd::Zero(3, points)};
}

void set(Resultants& result, Eigen::Index k, const LocalSection& section, const Eigen::Matrix2d& theta,
         const Eigen::Vector2d& shear) {
  // strains at z: z * (theta_y,x , -theta_x,y , theta_y,y - theta_x,x)
  const Eigen::Vector3d strains(theta(1, 0), -theta(0, 1), theta(1, 1) - theta(0, 0));
  result.moments.col(k) = section.bending * strains;
  result.shear.col(k) = shear;
  result.top.col(k) = section.top * strains;
  result.von_mises[k] = von_mises(Eigen::Vector3d(result.top.col(k)));
}

}  // namespace plate
