#pragma once

/// A Mindlin plate on a cloud of points. Knows no cracks and no files.
namespace plate {

/// Material and thickness of the plate.
struct Section {
  double young = 0;                   // E [force/length^2]
  double poisson = 0;                 // nu
  double thickness = 0;               // h [length]
  double shear_correction = 5.0 / 6;  // k_s
  double density = 0;                 // rho [mass/length^3], dynamics only
  double thermal_expansion = 0;       // alpha [1/temperature], loads by temperature only

  /// D = E h^3 / (12 (1 - nu^2)) [force length]
  double bending_stiffness() const;
  /// k_s G h with G = E / (2 (1 + nu)) [force/length]
  double shear_stiffness() const;
  /// h / sqrt(12 k_s): width of the layer beside free edges and faces of cracks in which twist and shear change
  /// [length]
  double layer() const;
  /// sqrt(k_s G / rho): no crack runs faster [length/time]
  double shear_wave_speed() const;
};

}  // namespace plate
