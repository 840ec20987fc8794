#pragma once
#include <initializer_list>
#include <utility>
#include <vector>

namespace post {

/// sum c_a z^(a/2) conj(z)^(b/2) with a + b = `degree`, of an odd field i times that; a, b >= -3. Terms that are 0 are
/// none.
class Powers {
public:
  explicit Powers(int degree) : degree_(degree), factors_(std::size_t(degree + 2 * beyond + 1)) {}
  Powers(int degree, std::initializer_list<std::pair<int, double>> terms) : Powers(degree) {
    for (const auto& [a, c] : terms) at(a) += c;
  }

  int degree() const { return degree_; }
  double& at(int a) { return factors_[std::size_t(a + beyond)]; }
  double at(int a) const { return factors_[std::size_t(a + beyond)]; }

  /// visit(a, b, c) in ascending a.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (int a = -3; a <= degree_ + 3; ++a)
      if (const double c = at(a); c != 0) visit(a, degree_ - a, c);
  }

private:
  static constexpr int beyond = 5;  // a that are asked for, or set to 0
  int degree_;
  std::vector<double> factors_;
};

/// `sum` and `other` of one degree.
inline void add(Powers& sum, const Powers& other, double factor = 1) {
  other.for_each([&](int a, int, double c) { sum.at(a) += factor * c; });
}

/// Derivatives by z and by conj(z), as if these were independent.
inline Powers d_dz(const Powers& f) {
  Powers result(f.degree() - 2);
  f.for_each([&](int a, int, double c) {
    if (a != 0) result.at(a - 2) = c * a / 2;
  });
  return result;
}

inline Powers d_dconj(const Powers& f) {
  Powers result(f.degree() - 2);
  f.for_each([&](int a, int b, double c) {
    if (b != 0) result.at(a) = c * b / 2;
  });
  return result;
}

}  // namespace post
