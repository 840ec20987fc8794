#pragma once
#include "plate/state.hpp"
#include <cstdint>
#include <vector>

namespace plate {

/// Degrees of freedom (3 * point + component) that are zero or follow another one. Together they are the matrix P of
/// u = P q; forces go back by its transpose, so that a symmetric stiffness stays symmetric.
class Constraints {
public:
  struct Tie {
    std::uint32_t follower, leader;
    double factor;  // u[follower] = factor * u[leader]
  };

  void fix(std::uint32_t dof);
  /// The leader may follow another one in turn, or be fixed; resolve() settles it. A dof that is held twice keeps its
  /// first tie.
  void tie(std::uint32_t follower, std::uint32_t leader, double factor);

  /// Replaces chains of ties by one tie to a free leader. Call once, after the last fix and tie.
  void resolve();

  const std::vector<Tie>& ties() const { return ties_; }
  const std::vector<std::uint32_t>& fixed() const { return fixed_; }
  bool held(std::uint32_t dof) const;

  void impose(State& state) const;                           // u = P q
  void fold(Forces& forces) const;                           // f = P^T f; zero at held dofs
  void fold_absolute(Forces& forces) const;                  // f = |P|^T f; zero at held dofs
  void fold_diagonal(Forces& diagonal) const;                // m = diag(P^T diag(m) P); zero at held dofs

private:
  template <typename Weight>
  void fold_with(Forces& forces, const Weight& weight) const;

  std::vector<Tie> ties_;
  std::vector<std::uint32_t> fixed_;
  std::vector<std::uint32_t> held_;  // sorted, by resolve()
};

}  // namespace plate
