#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/face_pairs.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/state.hpp"

namespace plate {

class AssembledPlate;

/// Opening and contact force of two places that face each other on a crack. Top is z = h/2.
struct FaceContact {
  geometry::Point position;
  double length;                       // of the crack that they stand for [length]
  double opening_top, opening_bottom;  // of the crack at both faces of the plate [length]
  double force_top, force_bottom;      // that presses there, along the crack [force/length]
};

/// Linear equilibrium of a plate and of the same plate in its plane, of which the faces of cracks touch without
/// friction.
struct TouchingFaces {
  State bending, membrane;  // change by the contact
  std::vector<FaceContact> faces;
  std::size_t factor_bytes = 0;

  double least_opening() const;  // [length]
  double largest_force() const;  // along the crack [force/length]
  /// The pair nearest to a tip; null where there is none.
  const FaceContact* next_to(const geometry::Point& tip) const;
  double length() const;        // of all cracks [length]
  double closed_share() const;  // of the length of the cracks, at one face of the plate or at both
};

/// Equilibria of a plate and of the same plate in its plane without contact.
struct FreeFaces {
  const State &bending, &membrane;
};

/// Sums of what every rank adds, the same bits on each of them. Collective.
Eigen::MatrixXd sum_of_ranks(const Formulation& plate, const Eigen::MatrixXd& own);

/// States under several loads.
using Solutions = std::function<std::vector<State>(const std::vector<Forces>& loads)>;

/// Pairs of places on the faces of cracks at both faces of the plate. Rows: all pairs at z = h/2, then at z = -h/2.
/// Every rank has all rows, their openings and forces; states and nodal forces are those of its points. Collective:
/// every rank must call all member functions but press().
class FaceRows {
public:
  /// The plate must outlive this.
  explicit FaceRows(const Formulation& plate);

  const std::vector<FacePair>& pairs() const { return pairs_; }
  const Eigen::VectorXd& arms() const { return arms_; }  // h/2 at the pairs [length]
  /// Openings of all pairs by unit forces that press each of them apart: symmetric and positive [pairs x pairs].
  /// `solutions`: of the plate or of its plane, which may have other `points` beyond edges.
  Eigen::MatrixXd compliance(std::size_t points, const Solutions& solutions) const;
  /// Openings of all rows by unit forces on some [rows x some]. `solutions`: under loads on the plate and its plane,
  /// stacked, which have the same `points`.
  Eigen::MatrixXd columns(std::span<const Eigen::Index> some, std::size_t points, const Solutions& solutions) const;
  /// Openings of all rows [length].
  Eigen::VectorXd openings(const State& bending, const State& membrane) const;
  /// Adds the nodal forces of forces that press the rows apart. Pairs that are pressed evenly do not bend the plate.
  void press(const Eigen::VectorXd& forces, Forces& on_bending, Forces& on_membrane) const;
  /// Size of an opening that is none but for the errors of an equilibrium [length].
  double error_of_openings(const State& bending, const State& membrane) const;
  std::vector<FaceContact> contacts(const Eigen::VectorXd& openings, const Eigen::VectorXd& forces) const;

private:
  const Formulation& plate_;
  std::vector<FacePair> pairs_;
  Eigen::VectorXd arms_;
};

/// Gives what supports hold a compliance of rounding, which is returned: faces that cannot turn, or cannot move, share
/// a force evenly.
double lift_compliance(Eigen::MatrixXd& compliance);

/// Contact of the faces of cracks of a linear plate. The factors and the compliance of the faces are found once, for
/// all loads. Collective: every rank must call each member function.
class ContactOfFaces {
public:
  /// Both must outlive this.
  /// @throws NumericalError  where a factor of the stiffness fails
  ContactOfFaces(const Formulation& plate, const Formulation& membrane);
  ~ContactOfFaces();

  /// Finds where faces of cracks touch. They stay straight through the thickness, so that their opening at z = -h/2
  /// and h/2 is that of the plane less and plus h/2 times that of the rotations. Both openings and the forces that
  /// press there are not negative, and one of them is zero (theory.md, "Faces that touch"). `free`: equilibria without
  /// contact.
  /// @throws NumericalError  where the search for what touches fails
  TouchingFaces operator()(const FreeFaces& free) const;

  std::size_t bytes() const;  // of the factors

private:
  const Formulation& plate_;
  FaceRows rows_;
  Constraints across_, in_plane_;
  std::unique_ptr<const AssembledPlate> bent_, flat_;  // null without cracks
  Eigen::MatrixXd compliance_;                         // of the rows
};

/// Contact of faces under one load, as ContactOfFaces finds it.
/// @throws NumericalError  where the factor of the stiffness, or the search for what touches, fails
TouchingFaces touching_faces(const Formulation& plate, const Formulation& membrane, const FreeFaces& free);

}  // namespace plate
