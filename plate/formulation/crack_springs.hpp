#pragma once
#include <optional>
#include <vector>

#include "plate/formulation/elastic_supports.hpp"
#include "plate/formulation/face_pairs.hpp"
#include "plate/model/part_through_crack.hpp"

namespace plate {

struct Problem;
struct Spring;
enum class PlateLaw;

/// Forces and couples from face to face of a crack at a place, per length: n points to the left of the way along the
/// crack as it is given, s = n turned by +90 degrees; what opens the crack is positive.
struct CarriedAcross {
  double moment = 0, twist = 0, shear = 0;        // M_nn, M_ns [force], Q_n [force/length]
  double normal_force = 0, tangential_force = 0;  // N_nn, N_ns [force/length]
  double rotation = 0, deflection = 0;            // jumps of psi_n and w
  std::optional<double> front_factor = {};        // of a crack through a part of the thickness
};

/// Springs between two places that face each other on a crack, per length.
struct CrackSpring {
  FacePair pair;                                       // its normal to the left of the way along the crack
  double deflection = 0, tangential = 0, sliding = 0;  // [force/length^2, force, force/length^2]
  Eigen::Matrix2d opening = Eigen::Matrix2d::Zero();   // N and M by the opening of the middle plane and the rotation
  std::optional<PartThroughCrack> part = {};

  /// Adds these springs to those of a plate, of its plane, or of what couples both.
  void add(PlateLaw law, ElasticSupportSum& sum) const;
  /// `in_plane`: state of the plane, without columns where there is none.
  CarriedAcross carried(const State& bending, const State& in_plane) const;
};

/// Springs of the pairs that lie on the cracks of a spring.
/// @throws Refused  a depth that is no number, or beyond PartThroughCrack::deepest
std::vector<CrackSpring> crack_springs(const Problem& problem, std::size_t number, const std::vector<FacePair>& pairs);

/// True where the crack nearest to a place goes through a part of the thickness.
bool part_through_at(const Problem& problem, const geometry::Point& x);

}  // namespace plate
