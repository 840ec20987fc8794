#pragma once
#include <Eigen/Core>
#include <vector>

namespace plate {

/// Solution x >= 0 of C x + c >= 0 with x (C x + c) = 0, of a C with x C x > 0, by block principal pivoting with single
/// pivots where blocks do not end (Judice and Pires 1994).
struct Complementarity {
  Eigen::VectorXd x, rest;  // rest: C x + c
  std::size_t iterations = 0;

  /// Shape of C: symmetric, or gaps beside forces, of which each moves the other against itself.
  enum class Shape : bool { symmetric, mixed };

  /// `kept`: rows with C x + c = 0 and x of any sign; empty where there are none.
  /// @throws NumericalError  where C is not positive, or the search does not end
  Complementarity(const Eigen::MatrixXd& C, const Eigen::VectorXd& c, const std::vector<char>& kept = {},
                  Shape shape = Shape::symmetric);

private:
  std::vector<std::size_t> wrong_ones(const Eigen::VectorXd& compliances, const Eigen::VectorXd& c) const;
  void solve(const Eigen::MatrixXd& C, const Eigen::VectorXd& c);

  Shape shape_;
  std::vector<char> kept_, pressed_;
};

}  // namespace plate
