#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/formula.hpp"

/// A Mindlin plate on a cloud of points. Knows no cracks and no files.
namespace plate {

/// A material with three planes of symmetry, its axes 1 and 2 in the plane of the plate.
struct Orthotropy {
  double E1 = 0, E2 = 0;             // moduli along the axes [force/length^2]
  double nu12 = 0;                   // strain along 2 over that along 1, less the sign, under stress along 1
  double G12 = 0, G13 = 0, G23 = 0;  // in the plane, and across it [force/length^2]
  double angle = 0;                  // of axis 1 from x, counter-clockwise [degrees]

  /// True where every strain in the plane costs energy: nu12^2 < E1 / E2.
  bool stable() const { return nu12 * nu12 * E2 < E1; }
};

/// Layer of a laminated plate.
struct Ply : Orthotropy {
  double thickness = 0;           // [length]
  std::optional<double> density;  // without it that of the section [mass/length^3]
  std::optional<double> alpha1,   // strains per temperature along the axes; without them that of the section
      alpha2;
};

/// A part of a plate with numbers of its own; what it does not give is that of the section.
struct SectionRegion {
  geometry::Hole shape;
  std::optional<double> thickness, young, poisson, density;
};

/// Meaning of the rotations of a plate. In the plane they are the displacements u = theta_y and v = -theta_x, the
/// moments are the membrane forces, and there is no shear: the bending law with E h in place of E h^3 / 12. Coupling:
/// the moments by the strains in the plane, as of plies that are not symmetric.
enum class PlateLaw { bending, membrane, coupling };

/// Material and thickness of the plate.
struct Section {
  double young = 0;                            // E [force/length^2]
  double poisson = 0;                          // nu
  double thickness = 0;                        // h [length]
  double shear_correction = 5.0 / 6;           // k_s
  double density = 0;                          // rho [mass/length^3], dynamics and own weight
  double thermal_expansion = 0;                // alpha [1/temperature], loads by temperature only
  std::optional<Orthotropy> orthotropic = {};  // instead of young and poisson
  std::vector<Ply> plies = {};                 // instead of these and thickness, from z = -h/2 upwards
  Formula thickness_factor = {};               // h(x, y) / h
  Formula young_factor = {};                   // E(x, y) / E
  std::vector<SectionRegion> regions = {};     // where several overlap the last counts; factors act outside of them
  PlateLaw law = PlateLaw::bending;

  /// True for a section with the same properties everywhere.
  bool uniform() const { return regions.empty() && !thickness_factor.given() && !young_factor.given(); }
  /// True for a material without directions.
  bool isotropic() const { return !orthotropic && plies.empty(); }
  bool simple() const { return uniform() && isotropic(); }
  /// True where bending and stretching act on each other: plies whose stiffness or mass is not symmetric about z = 0,
  /// or that expand by strains of their own.
  bool couples() const;
  /// True where plies have strains per temperature of their own. Free strains then count in temperatures.
  bool expands_by_plies() const;
  /// True where the mass of plies is not symmetric about z = 0.
  bool heavier_on_one_side() const;

  /// The section at a place, the same everywhere.
  Section at(const geometry::Point& x) const;
  /// Radius within which the section is the same as at a place as far as regions tell; 0 where it has factors [length].
  double uniform_within(const geometry::Point& x) const;
  /// Makes the plate some times as thick.
  void thicken(double factor);

  /// D = E h^3 / (12 (1 - nu^2)), of a membrane E h / (1 - nu^2); with directions sqrt(D11 D22) [force length]
  double bending_stiffness() const;
  /// k_s G h with G = E / (2 (1 + nu)); with directions sqrt(S11 S22 - S12^2); of a membrane 0 [force/length]
  double shear_stiffness() const;
  /// rho h [mass/length^2]
  double mass() const;
  /// Integral of rho z; 0 where the mass is symmetric about z = 0 [mass/length]
  double first_moment() const;
  /// h / sqrt(12 k_s): width of the layer beside free edges and faces of cracks in which twist and shear change; with
  /// directions the least of sqrt(D66 / S); of a membrane infinite, as it has none [length]
  double layer() const;
  /// sqrt(k_s G / rho): no crack runs faster [length/time]
  double shear_wave_speed() const;
};

/// Stiffness and mass of a plate at one place; of a membrane forces by strains in place of moments by curvatures (A in
/// place of D), of the coupling moments by strains (B).
struct LocalSection {
  Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();  // Mxx, Myy, Mxy by kappa xx, yy, 2 xy [force length]
  Eigen::Matrix2d shear = Eigen::Matrix2d::Zero();    // Qx, Qy by the shear angles [force/length]
  Eigen::Matrix3d top = Eigen::Matrix3d::Zero();      // stresses at z = h/2 by the same curvatures [force/length]
  double thickness = 0;                               // [length]
  double mass = 0, rotary = 0;                        // integrals of rho and rho z^2 [mass/length^2, mass]

  LocalSection() = default;
  /// Constructs from a section that is the same everywhere.
  LocalSection(const Section& section);

  void add(const LocalSection& other, double weight);
};

/// Resultants and energy of plies that may not expand by a unit of free strain (PlateLaw::membrane), of free curvature
/// (bending), or of one against the other (coupling).
struct HeldPlies {
  Eigen::Vector3d resultants = Eigen::Vector3d::Zero();  // xx, yy, xy: integrals of Q e, Q e z^2, Q e z
  double energy = 0;                                     // likewise of e . Q e / 2
};
HeldPlies held_plies(const Section& section);

/// Strains e (xx, yy, 2 xy) of a ply by a unit of free strain: (1, 1, 0), or those per temperature of its own.
Eigen::Vector3d free_strains(const Section& section, const Ply& ply);

/// Stresses xx, yy, xy by the strains xx, yy, 2 xy in the plane, without stress across it [force/length^2].
Eigen::Matrix3d plane_stress(const Orthotropy& material);

/// Shear stresses xz, yz by the shear angles [force/length^2].
Eigen::Matrix2d transverse_shear(const Orthotropy& material);

}  // namespace plate
