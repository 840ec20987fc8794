#pragma once
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include "geometry/shape/outline.hpp"

namespace plate {

/// A number for every place, given as text: an expression in x, y and pi, as "100 * sin(pi * x / 2)". It is evaluated
/// by one thread at a time.
class Formula {
public:
  Formula() = default;
  /// Constructs the formula of a text that is known to be one. Throws std::invalid_argument where parsed() has none.
  explicit Formula(const std::string& text);
  /// Parses a text. Returns the formula, or what is wrong with the text and where.
  static std::variant<Formula, std::string> parsed(const std::string& text);

  bool given() const { return bool(parsed_); }
  std::string text() const;
  /// Value at x; a value that is not finite is returned as it is.
  double operator()(const geometry::Point& x) const;

private:
  struct Parsed;
  std::shared_ptr<Parsed> parsed_;
};

/// A formula that gives no load.
class FormulaError : public std::domain_error {
public:
  /// Constructs the error of a formula that has no finite value at a place where it is needed.
  FormulaError(const Formula& formula, const geometry::Point& x);
  /// Constructs the error of a formula that varies so much between points that its integral may be wrong by this share.
  FormulaError(const Formula& formula, double share);
  const std::string& formula() const { return formula_; }

private:
  std::string formula_;
};

}  // namespace plate
