#include "plate/model/section.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/shape/crack_path.hpp"

namespace plate {
namespace {

using geometry::Point;

bool contains(const geometry::Hole& shape, const Point& x) {
  if (const auto* circle = std::get_if<geometry::Circle>(&shape))
    return (x - circle->centre).squaredNorm() <= circle->radius * circle->radius;
  const auto& v = std::get<geometry::Polygon>(shape).vertices;
  bool inside = false;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    if ((v[i].y() > x.y()) != (v[j].y() > x.y()) &&
        x.x() < v[j].x() + (x.y() - v[j].y()) / (v[i].y() - v[j].y()) * (v[i].x() - v[j].x()))
      inside = !inside;
  return inside;
}

double distance_to_boundary(const geometry::Hole& shape, const Point& x) {
  if (const auto* circle = std::get_if<geometry::Circle>(&shape))
    return std::abs((x - circle->centre).norm() - circle->radius);
  auto ring = std::get<geometry::Polygon>(shape).vertices;
  ring.push_back(ring.front());
  return geometry::distance(ring, x);
}

/// Stress at z = h/2 over the moment, or over the membrane force.
double stress_by_moment(const Section& s) {
  const double h = s.thickness;
  return s.law == PlateLaw::membrane ? 1 / h : 6 / (h * h);
}

void set_isotropic(LocalSection& l, const Section& s) {
  const double D = s.bending_stiffness(), nu = s.poisson;
  l.bending << D, D * nu, 0, D * nu, D, 0, 0, 0, D * (1 - nu) / 2;
  l.shear = s.shear_stiffness() * Eigen::Matrix2d::Identity();
  l.top = stress_by_moment(s) * l.bending;
}

void set_orthotropic(LocalSection& l, const Section& s) {
  l.bending =
      (s.law == PlateLaw::membrane ? s.thickness : std::pow(s.thickness, 3) / 12) * plane_stress(*s.orthotropic);
  if (s.law == PlateLaw::bending) l.shear = s.shear_correction * s.thickness * transverse_shear(*s.orthotropic);
  l.top = stress_by_moment(s) * l.bending;
}

/// Integral of 1 (membrane), z (coupling) or z^2 (bending) over a ply from `z` upwards.
double integral(PlateLaw law, double z, double thickness) {
  const double end = z + thickness;
  switch (law) {
    case PlateLaw::membrane:
      return thickness;
    case PlateLaw::coupling:
      return thickness * (end + z) / 2;
    case PlateLaw::bending:
      break;
  }
  return (std::pow(end, 3) - std::pow(z, 3)) / 3;
}

/// Integrals over the plies, whose middle plane is that of the plate.
void set_plies(LocalSection& l, const Section& s) {
  l.mass = l.rotary = 0;
  const bool bends = s.law == PlateLaw::bending;
  double z = -s.thickness / 2;
  for (const auto& ply : s.plies) {
    const double density = ply.density.value_or(s.density);
    l.bending += integral(s.law, z, ply.thickness) * plane_stress(ply);
    if (bends) l.shear += s.shear_correction * ply.thickness * transverse_shear(ply);
    l.mass += density * ply.thickness, l.rotary += density * integral(PlateLaw::bending, z, ply.thickness);
    z += ply.thickness;
  }
  l.top = (bends ? s.thickness / 2 : 1) * plane_stress(s.plies.back());
}

}  // namespace

LocalSection::LocalSection(const Section& s) : thickness(s.thickness) {
  const double h = s.thickness;
  mass = s.density * h, rotary = s.density * h * h * h / 12;
  if (!s.plies.empty())
    set_plies(*this, s);
  else if (s.law == PlateLaw::coupling)
    return;  // of one material: none
  else if (s.isotropic())
    set_isotropic(*this, s);
  else
    set_orthotropic(*this, s);
}

void LocalSection::add(const LocalSection& other, double weight) {
  bending += weight * other.bending, shear += weight * other.shear, top += weight * other.top;
  thickness += weight * other.thickness, mass += weight * other.mass, rotary += weight * other.rotary;
}

Section Section::at(const Point& x) const {
  Section s{young, poisson, thickness, shear_correction, density, thermal_expansion, orthotropic, plies};
  s.law = law;
  const auto region =
      std::find_if(regions.rbegin(), regions.rend(), [&](const auto& r) { return contains(r.shape, x); });
  if (region != regions.rend()) {
    s.thickness = region->thickness.value_or(thickness), s.young = region->young.value_or(young);
    s.poisson = region->poisson.value_or(poisson), s.density = region->density.value_or(density);
    return s;
  }
  if (thickness_factor.given()) s.thickness *= thickness_factor(x);
  if (young_factor.given()) s.young *= young_factor(x);
  return s;
}

double Section::uniform_within(const Point& x) const {
  if (thickness_factor.given() || young_factor.given()) return 0;
  double result = INFINITY;
  for (const auto& region : regions) result = std::min(result, distance_to_boundary(region.shape, x));
  return result;
}

bool Section::expands_by_plies() const {
  return std::ranges::any_of(plies, [](const Ply& ply) { return ply.alpha1 || ply.alpha2; });
}

bool Section::couples() const {
  constexpr double rounding = 1e-9;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero(), B = A;
  double z = -thickness / 2;
  for (const auto& ply : plies) {
    A += ply.thickness * plane_stress(ply), B += integral(PlateLaw::coupling, z, ply.thickness) * plane_stress(ply);
    z += ply.thickness;
  }
  return B.cwiseAbs().maxCoeff() > rounding * thickness * A.cwiseAbs().maxCoeff() || heavier_on_one_side() ||
         expands_by_plies();
}

bool Section::heavier_on_one_side() const {
  constexpr double rounding = 1e-9;
  double mass = 0, first = 0;  // integrals of rho and rho z
  double z = -thickness / 2;
  for (const auto& ply : plies) {
    const double rho = ply.density.value_or(density);
    mass += rho * ply.thickness, first += rho * integral(PlateLaw::coupling, z, ply.thickness);
    z += ply.thickness;
  }
  return std::abs(first) > rounding * thickness * mass;
}

double Section::first_moment() const {
  double result = 0, z = -thickness / 2;
  for (const auto& ply : plies) {
    result += ply.density.value_or(density) * integral(PlateLaw::coupling, z, ply.thickness);
    z += ply.thickness;
  }
  return result;
}

void Section::thicken(double factor) {
  thickness *= factor;
  for (auto& ply : plies) ply.thickness *= factor;
  for (auto& region : regions)
    if (region.thickness) *region.thickness *= factor;
}

double Section::bending_stiffness() const {
  if (isotropic() && law == PlateLaw::membrane) return young * thickness / (1 - poisson * poisson);
  if (isotropic()) return young * std::pow(thickness, 3) / (12 * (1 - poisson * poisson));
  const LocalSection l(*this);
  return std::sqrt(l.bending(0, 0) * l.bending(1, 1));
}

double Section::shear_stiffness() const {
  if (law == PlateLaw::membrane) return 0;
  if (isotropic()) return shear_correction * young / (2 * (1 + poisson)) * thickness;
  return std::sqrt(LocalSection(*this).shear.determinant());
}

double Section::mass() const {
  return plies.empty() ? density * thickness : LocalSection(*this).mass;
}

double Section::shear_wave_speed() const {
  return std::sqrt(shear_stiffness() / mass());
}

double Section::layer() const {
  if (law == PlateLaw::membrane) return INFINITY;
  if (isotropic()) return thickness / std::sqrt(12 * shear_correction);
  const LocalSection l(*this);
  const auto& D = l.bending;  // twist along the axes, and at 45 degrees to them
  const double twist = std::min(D(2, 2), (D(0, 0) + D(1, 1) - 2 * D(0, 1)) / 4);
  return std::sqrt(twist / l.shear.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
}

namespace {

/// cos and sin of an angle in degrees, exact at right angles.
Eigen::Vector2d direction(double degrees) {
  const double quarter = std::round(degrees / 90), rest = (degrees - 90 * quarter) * std::numbers::pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch ((int(std::fmod(quarter, 4)) + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace

Eigen::Matrix3d plane_stress(const Orthotropy& m) {
  const double nu21 = m.nu12 * m.E2 / m.E1, rest = 1 - m.nu12 * nu21;
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  own(0, 0) = m.E1 / rest, own(1, 1) = m.E2 / rest, own(0, 1) = own(1, 0) = nu21 * m.E1 / rest, own(2, 2) = m.G12;
  const auto n = direction(m.angle);
  const double c = n.x(), s = n.y();
  Eigen::Matrix3d turn;  // strains along the axes by those along x and y
  turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return turn.transpose() * own * turn;
}

Eigen::Vector3d free_strains(const Section& section, const Ply& ply) {
  if (!section.expands_by_plies()) return {1, 1, 0};
  const double along = ply.alpha1.value_or(section.thermal_expansion),
               across = ply.alpha2.value_or(section.thermal_expansion);
  const auto n = direction(ply.angle);
  const double c = n.x(), s = n.y();
  return {c * c * along + s * s * across, s * s * along + c * c * across, 2 * c * s * (along - across)};
}

HeldPlies held_plies(const Section& section) {
  HeldPlies result;
  double z = -section.thickness / 2;
  for (const auto& ply : section.plies) {
    const Eigen::Vector3d strains = free_strains(section, ply), stresses = plane_stress(ply) * strains;
    const double share = integral(section.law, z, ply.thickness);
    result.resultants += share * stresses, result.energy += share * strains.dot(stresses) / 2;
    z += ply.thickness;
  }
  return result;
}

Eigen::Matrix2d transverse_shear(const Orthotropy& m) {
  const auto n = direction(m.angle);
  Eigen::Matrix2d turn;
  turn << n.x(), n.y(), -n.y(), n.x();
  return turn.transpose() * Eigen::Vector2d(m.G13, m.G23).asDiagonal() * turn;
}

}  // namespace plate
