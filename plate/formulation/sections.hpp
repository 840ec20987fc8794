#pragma once
#include <Eigen/Core>
#include <vector>

#include "plate/model/section.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

struct Heat;

/// The section about every point of a plate: one for all where it is the same everywhere.
class PointSections {
public:
  /// Constructs from a section that is the same everywhere.
  PointSections(const Section& section) : simple_(section.isotropic()), kinds_{LocalSection(section)} {}
  /// Means over the parts of the cells that belong to each point. Throws Refused where a factor is not above 0.
  PointSections(const Section& section, const geometry::Tessellation& cells);

  const LocalSection& operator[](std::size_t k) const { return kinds_[uniform() ? 0 : k]; }
  bool uniform() const { return kinds_.size() == 1; }
  /// True for a uniform section of isotropic material.
  bool simple() const { return simple_ && uniform(); }
  /// Mass that points carry beside that of the plate [mass]. `areas`: of the points.
  void add_masses(const std::vector<double>& masses, const std::vector<double>& areas);
  std::size_t bytes() const { return uniform() ? 0 : kinds_.size() * sizeof(LocalSection); }

private:
  bool simple_;
  std::vector<LocalSection> kinds_;
};

/// Section forces per length and stresses of the faces. M > 0 is tension on the z > 0 face.
struct Resultants {
  Eigen::Matrix3Xd moments;      // Mxx, Myy, Mxy [force]
  Eigen::Matrix2Xd shear;        // Qx, Qy [force/length]
  Eigen::VectorXd von_mises;     // [force/length^2]; where faces differ the larger of both
  Eigen::Matrix3Xd top;          // stresses xx, yy, xy at z = +h/2 [force/length^2]
  Eigen::Matrix3Xd bottom = {};  // at z = -h/2; without columns where it is -top

  /// Stresses xx, yy, xy at z = -h/2 [3 x points].
  Eigen::Matrix3Xd at_bottom() const { return bottom.cols() > 0 ? bottom : -top; }
};

/// Principal stresses of a plane state [force/length^2], and the angle of the largest from the x axis, in (-90, 90]
/// [degrees].
struct PrincipalStresses {
  double largest, smallest, angle;
};

/// `stress`: xx, yy, xy.
PrincipalStresses principal(const Eigen::Vector3d& stress);

/// Gradients at a point.
struct Gradients {
  Eigen::Matrix2d theta = Eigen::Matrix2d::Zero();  // row: theta_x, theta_y; column: d/dx, d/dy
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();  // gamma_xz, gamma_yz
};

/// Stresses xx, yy, xy of moments Mxx, Myy, Mxy, at z = +h/2 [force/length^2].
Eigen::Vector3d stress_at_top(const Eigen::Vector3d& moments, const Section& section);

/// Von Mises stress of these [force/length^2].
double von_mises(const Eigen::Vector3d& moments, const Section& section);

/// Sets point k to moments that bend the plate: stresses of the faces are theirs. `section`: the same everywhere.
void set_moments(Resultants& result, Eigen::Index k, const Eigen::Vector3d& moments, const Section& section);

/// Adds membrane forces to the stresses of both faces; von Mises stress becomes the larger of both.
void add_membrane_forces(Resultants& bending, const PointSections& of_bending, const Resultants& membrane,
                         const PointSections& of_membrane);

/// Completes resultants of a section that couples, which are given as D kappa and A epsilon: M = D kappa + B epsilon,
/// N = A epsilon + B kappa, less what the heat of the membrane has of these, and for both the stresses of the faces and
/// the von Mises stress at every point, the larger of both faces. `heat`: null without any.
void couple(Resultants& bending, Resultants& membrane, const Section& section, const Heat* heat = nullptr);

/// Resultants of these points, not yet set.
Resultants resultants_of(Eigen::Index points);

/// Sets those of point k. `theta`: as in Gradients. `shear`: shear force [force/length].
void set(Resultants& result, Eigen::Index k, const LocalSection& section, const Eigen::Matrix2d& theta,
         const Eigen::Vector2d& shear);

}  // namespace plate
