#pragma once
#include "plate/formulation/boundary.hpp"
#include "post/files/summary.hpp"

namespace plate {
class Operator;
}

namespace post {

/// Of the nodal force `value`, conjugate to w (component 0) or a rotation (1, 2), at a place.
Wrench wrench(const geometry::Point& at, std::size_t component, double value);

/// Nodal forces as the balance sees them.
struct Applied {
  Wrench sum;
  double size = 0;       // sum of the sizes of all, couples over half the diagonal of the plate [force]
  Eigen::VectorXd held;  // on what is held

  void add(double factor, const Applied& other);
};

/// The reactions of a plate by edges and pins, from what its forces leave on what is held, and by foundations and
/// springs. What two hold together, as
/// the point at a corner of two edges, is shared equally between them.
class Supports {
public:
  /// `boundary` must outlive this.
  explicit Supports(const plate::Boundary& boundary);

  Applied nothing() const;
  /// Not carried over to the free degrees of freedom.
  Applied applied(const plate::Forces& forces) const;
  /// Of edges and pins, then of foundations and springs. `internal`: force -K u on what is held; `loads`: that act;
  /// `inertia`: mass times acceleration, in motion; `state`: u.
  Balance balance(const Eigen::VectorXd& internal, const Applied& loads, const Applied* inertia,
                  const plate::State& state) const;
  /// What the elastic forces of the plate do along w to every support, as functionals of its state [supports x 3
  /// points, as State::data()]; of many supports, to all together.
  Eigen::MatrixXd elastic_forces(const plate::Operator& plate) const;

private:
  /// What a unit of force on a degree of freedom that is held does to its holder, with what its leaders take.
  struct Share {
    std::uint32_t holder, held;  // number among those that are held
    Wrench unit;
  };

  const plate::Boundary* boundary_;
  std::vector<Share> shares_;  // by holders
  geometry::Point centre_{0, 0};
  double arm_ = 0;  // half the diagonal of the plate
};

}  // namespace post
