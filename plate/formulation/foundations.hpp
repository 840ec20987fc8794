#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "plate/formulation/elastic_supports.hpp"
#include "plate/model/state.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct Foundation;

/// Unilateral foundation: presses where w < 0 and does not pull. The energy of every place is
/// stiffness / 2 min(w, 0)^2 with w a form in some degrees of freedom. The force is continuous, so that steps of a
/// motion and equilibria see no jumps (theory.md, "Soil that lifts off"). Any number of threads gives the same bits.
class Contact {
public:
  struct Place {
    double stiffness;
    std::vector<std::pair<std::uint32_t, double>> form;  // degrees of freedom as State::data(), factors
  };
  explicit Contact(const std::vector<Place>& places);

  std::size_t places() const { return stiffness_.size(); }
  Place place(std::size_t number) const;
  /// 1 where it touches.
  std::vector<char> touching(const State& state) const;
  template <typename Real>
  void add_force(double factor, const Values<Real>& state, Values<Real>& forces) const;
  /// Adds the forces of a foundation in contact at the `touching` places and nowhere else, whatever the state.
  void add_force(double factor, const State& state, const std::vector<char>& touching, Forces& forces) const;
  double energy(const State& state) const;
  /// visit(point, stiffness, touches) of every place.
  template <typename Visit>
  void for_each(const State& state, const Visit& visit) const {
    const auto touches = touching(state);
    for (std::size_t p = 0; p < touches.size(); ++p)
      visit(point(p, std::size_t(state.cols())), stiffness_[p], touches[p] != 0);
  }
  /// Point at which a place lies, of so many points: the first point of its form.
  std::size_t point(std::size_t place, std::size_t points) const { return terms_[first_[place]].first % points; }
  std::size_t bytes() const;

private:
  /// w of every place, where `acts(place, w)`, else 0, times the stiffness.
  template <typename Real, typename Acts>
  std::vector<double> pressures(const Values<Real>& state, const Acts& acts) const;
  template <typename Real>
  void add(double factor, const std::vector<double>& pressures, Values<Real>& forces) const;

  std::vector<double> stiffness_;
  std::vector<std::size_t> first_;                       // of the terms of every place
  std::vector<std::pair<std::uint32_t, double>> terms_;  // degree of freedom, factor
  std::vector<std::uint32_t> row_;                       // degrees of freedom that are pressed, ascending
  std::vector<std::size_t> first_of_row_;
  std::vector<std::pair<std::uint32_t, double>> of_row_;  // place, factor
};

/// The stiffness of a foundation under points in the middles of cells: its pressure under a deflection that is linear
/// in each cell acts as any pressure does (theory.md, "Elastic foundations"), the shear by differences between
/// neighbouring points, on either side of cracks too.
void add_foundation(const Foundation& foundation, const geometry::Cloud& cloud, ElasticSupportSum& sum);

/// Foundation under a plate whose points are corners of cells: acts on the linear function that the corners carry.
void add_foundation(const Foundation& foundation, const geometry::Tessellation& cells, ElasticSupportSum& sum);

}  // namespace plate
