#include "plate/model/section.hpp"

#include <cmath>

namespace plate {

double Section::bending_stiffness() const {
  return young * std::pow(thickness, 3) / (12 * (1 - poisson * poisson));
}

double Section::shear_stiffness() const {
  return shear_correction * young / (2 * (1 + poisson)) * thickness;
}

double Section::shear_wave_speed() const {
  return std::sqrt(shear_stiffness() / (density * thickness));
}

double Section::layer() const {
  return thickness / std::sqrt(12 * shear_correction);
}

}  // namespace plate
