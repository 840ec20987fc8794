#pragma once
#include "fracture/breakage/damaged_plate.hpp"
#include "plate/bonds/rows/lattice_operator.hpp"
#include "tests/verification/verified_plate.hpp"

/// A square of 10 x 10 points whose bonds break.
namespace broken_plate {

struct Plate {
  explicit Plate(std::vector<plate::Support> supports) : content(of(std::move(supports))) {}

  static cases::Case of(std::vector<plate::Support> supports) {
    auto c = verified_plate::square(0.2);
    c.supports = std::move(supports);
    return c;
  }

  /// Breaks all bonds over the line at x, up to y, at once; `u`: the state. Returns the energy that it takes.
  double break_across(double x, double y = 10, const plate::State& u = {}) {
    std::vector<fracture::PointPair> bonds;
    const auto& at = whole->cloud().positions;
    for (std::uint32_t k = 0; k < at.size(); ++k)
      for (const auto& bond : whole->families()[k]) {
        const auto &p = at[k], &q = at[bond.neighbour];
        if (k > bond.neighbour || (p.x() - x) * (q.x() - x) >= 0) continue;
        if (p.y() + (x - p.x()) / (q.x() - p.x()) * (q.y() - p.y()) < y) bonds.push_back({k, bond.neighbour});
      }
    damaged.break_bonds(bonds, 1);
    const plate::State none, rest = plate::State::Zero(3, Eigen::Index(at.size()));
    return damaged.carry_on_all({u.size() > 0 ? u : rest, none, 0});
  }

  cases::Case content;
  std::unique_ptr<plate::Formulation> whole = verified_plate::assembled(content);
  fracture::DamagedPlate damaged{*whole->breaking(), whole->boundary(), {content.section, content.discretization}};
};

}  // namespace broken_plate
