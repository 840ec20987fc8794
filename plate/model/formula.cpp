#include "plate/model/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace plate {

struct Formula::Parsed {
  std::string text;
  double x = 0, y = 0;
  mu::Parser parser;
};

namespace {

/// Shortens a long text to what fits into a line.
std::string begin_of(const std::string& text) {
  constexpr std::size_t most = 60;
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

/// Returns what is wrong with a text that assigns, empty where none does: a place to store to makes a formula that
/// means another thing than it says.
std::string error_of_assignments(const std::string& text) {
  const std::string comparing = "=<>!";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool before = i > 0 && comparing.find(text[i - 1]) != std::string::npos;
    if (!before && (i + 1 == text.size() || text[i + 1] != '='))
      return fmt::format("'=' at character {}: nothing can be assigned", i + 1);
  }
  return "";
}

}  // namespace

Formula::Formula(const std::string& text) {
  auto found = parsed(text);
  if (const auto* error = std::get_if<std::string>(&found)) throw std::invalid_argument(*error);
  *this = std::get<Formula>(std::move(found));
}

std::variant<Formula, std::string> Formula::parsed(const std::string& text) {
  if (auto error = error_of_assignments(text); !error.empty()) return error;
  Formula result;
  result.parsed_ = std::make_shared<Parsed>();
  result.parsed_->text = text;
  auto& parser = result.parsed_->parser;
  try {
    parser.DefineVar("x", &result.parsed_->x);
    parser.DefineVar("y", &result.parsed_->y);
    parser.DefineConst("pi", std::numbers::pi);
    parser.SetExpr(text);
    int results = 0;
    parser.Eval(results);
    if (results != 1) return fmt::format("{} expressions, must be one", results);
  } catch (const mu::Parser::exception_type& error) {
    const auto where = error.GetPos();
    return error.GetToken().empty()
               ? error.GetMsg()
               : fmt::format(
                     "\"{}\" at character {} ({}); known are x, y, pi, functions as sin, sqrt, exp, abs, min, "
                     "and c ? a : b",
                     error.GetToken(), where + 1, error.GetMsg());
  }
  return result;
}

std::string Formula::text() const {
  return parsed_ ? parsed_->text : "";
}

double Formula::operator()(const geometry::Point& x) const {
  parsed_->x = x.x(), parsed_->y = x.y();
  try {
    return parsed_->parser.Eval();
  } catch (const mu::Parser::exception_type&) {  // of a build of the library that throws where it divides by zero
    return std::numeric_limits<double>::quiet_NaN();
  }
}

FormulaError::FormulaError(const Formula& formula, const geometry::Point& x)
    : std::domain_error(fmt::format("\"{}\" is {:g} at ({:.6g}, {:.6g}): it needs a finite value wherever it acts",
                                    begin_of(formula.text()), formula(x), x.x(), x.y())),
      formula_(formula.text()) {}

FormulaError::FormulaError(const Formula& formula, double share)
    : std::domain_error(
          fmt::format("\"{}\" varies so much between points that its sum may be wrong by {:.0f} %: refine, "
                      "or give what is narrow as loads on parts, lines or points",
                      begin_of(formula.text()), 100 * share)),
      formula_(formula.text()) {}

}  // namespace plate
