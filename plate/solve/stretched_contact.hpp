#pragma once
#include "plate/solve/crack_contact.hpp"

namespace plate {

class MiddlePlane;

/// Contact of the faces of cracks of a plate with large deflections (theory.md, "Faces that touch"). The openings of
/// its rows are linear in the states of the plate and of its plane.
class StretchedContact {
public:
  /// Both must outlive this. `plate` has cracks.
  StretchedContact(const Formulation& plate, const MiddlePlane& plane);

  const FaceRows& rows() const { return rows_; }

  /// Adds to free displacements in the plane the ones by which the faces do not overlap under given deflections.
  /// Returns the forces on the rows. `like`: forces near these, in whose ratio pairs that touch at both faces of the
  /// plate share theirs.
  Eigen::VectorXd part(const State& bending, State& membrane, const Eigen::VectorXd& like) const;

  /// A plate about a state, as its tangent sees it, under a step or a rate.
  struct Tangent {
    const State &bending, &membrane;  // without a change of the forces on the rows
    Eigen::VectorXd forces;           // on the rows, before
    std::vector<char> kept;           // rows that stay closed; empty where there are none
    std::vector<char> apart;          // rows that stay open; empty where there are none
  };
  /// Finds the forces on the rows by which no row is pulled and none overlaps. `solutions`: under loads on the plate
  /// and its plane, stacked.
  /// @throws NumericalError  where the search for what touches fails
  Eigen::VectorXd forces(const Tangent& tangent, const Solutions& solutions) const;

private:
  std::size_t points_;
  const MiddlePlane& plane_;
  FaceRows rows_;
  Eigen::MatrixXd of_plane_;  // compliance of the pairs in the plane
  double lifted_;             // which it has more than the plane
};

}  // namespace plate
