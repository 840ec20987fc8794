#pragma once
#include "fracture/growth/quasi_static/tips.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "fracture/growth/words.hpp"

/// Quasi-static growth on plates that are given as formulas.
namespace formula_tips {

using namespace fracture;

inline const plate::Section section{1000, 0.3, 0.5, 5.0 / 6, 0};  // toughness: half the fracture energy
constexpr double spacing = 0.01;

/// A crack from the left edge of [0, 6] x [-1, 1]. compliance(a) and its derivative.
struct Formula {
  std::function<double(double)> compliance, slope;
  Factors factors{1, 0, 0};

  LoadedPlate operator()(const std::vector<geometry::Polyline>& cracks) const {
    const double a = geometry::length(cracks[0]);
    const geometry::Point end = cracks[0].back();
    if (a >= 6) return {"the crack reached the right edge", 0, {}};
    return {"", compliance(a), {{{end, {1, 0}, 0, true}, factors, slope(a) / 2}}};
  }
};

using Solve = std::function<LoadedPlate(const std::vector<geometry::Polyline>& cracks)>;

/// Tips of a plate that is a formula: nothing is solved, and there is nothing to draw.
class FormulaTips : public QuasiStaticTips {
public:
  FormulaTips(const Growth& growth, const geometry::Outline& outline, std::vector<geometry::Polyline> cracks,
              Solve solve)
      : QuasiStaticTips(growth, section, outline, spacing, std::move(cracks)), solve_(std::move(solve)) {}

  const plate::Formulation& plate() const override { throw std::logic_error("a formula has no points"); }
  const plate::State& state() const override { throw std::logic_error("a formula has no state"); }
  const plate::StaticSolution& solution() const override { throw std::logic_error("a formula is not solved"); }
  std::optional<std::vector<post::Srif>> factors(double) override { return std::nullopt; }
  plate::Mesh draw(post::Frame&, const plate::State&) const override { return {}; }

private:
  LoadedPlate whole_load(const std::vector<geometry::Polyline>& cracks) override { return solve_(cracks); }

  Solve solve_;
};

struct Result {
  std::string outcome;
  std::size_t advances;
  Ledger ledger;
  std::vector<geometry::Polyline> cracks;
};

inline Result grown(const Growth& growth, const geometry::Outline& outline, std::vector<geometry::Polyline> cracks,
                    Solve solve, const std::function<void(const Equilibrium&, const FormulaTips&)>& observe) {
  FormulaTips tips(growth, outline, std::move(cracks), std::move(solve));
  const auto found = grow_quasi_statically(growth, tips, [&](const Equilibrium& state) { observe(state, tips); });
  for (std::size_t c = 0; c < tips.cracks().size(); ++c) {  // what is drawn is what has grown, the last piece too
    const auto& line = tips.record().cracks.lines.at(c);
    CHECK(line.vertices.front() == tips.cracks()[c].front());
    CHECK(line.vertices.back() == tips.cracks()[c].back());
    CHECK(geometry::length(line.vertices) == Approx(geometry::length(tips.cracks()[c])));
    REQUIRE(line.advances.size() == line.vertices.size());
    const auto first = std::ranges::find(line.advances, 0.0);
    CHECK(std::is_sorted(first, line.advances.end()));
    CHECK(std::is_sorted(line.advances.begin(), first, std::greater()));
  }
  return {fracture::in_words(found.ended, false), tips.advances(), found.ledger, tips.cracks()};
}

}  // namespace formula_tips
