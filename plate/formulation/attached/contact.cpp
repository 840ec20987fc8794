#include "plate/formulation/attached/contact.hpp"

#include <algorithm>

namespace plate {
namespace {

constexpr std::size_t many = 2000;

}  // namespace

Contact::Contact(const std::vector<Place>& places) {
  struct Entry {
    std::uint32_t row, place;
    double factor;
  };
  std::vector<Entry> entries;
  first_.push_back(0);
  for (const auto& [stiffness, form] : places) {
    for (const auto& [dof, factor] : form)
      if (factor != 0)
        terms_.emplace_back(dof, factor), entries.push_back({dof, std::uint32_t(stiffness_.size()), factor});
    stiffness_.push_back(stiffness);
    first_.push_back(terms_.size());
  }
  std::ranges::stable_sort(entries, {}, &Entry::row);
  for (const auto& [row, place, factor] : entries) {
    if (row_.empty() || row_.back() != row) row_.push_back(row), first_of_row_.push_back(of_row_.size());
    of_row_.emplace_back(place, factor);
  }
  first_of_row_.push_back(of_row_.size());
}

Contact::Place Contact::place(std::size_t number) const {
  return {stiffness_[number],
          {terms_.begin() + std::ptrdiff_t(first_[number]), terms_.begin() + std::ptrdiff_t(first_[number + 1])}};
}

template <typename Real, typename Acts>
std::vector<double> Contact::pressures(const Values<Real>& state, const Acts& acts) const {
  std::vector<double> result(places());
  const Real* const u = state.data();
#pragma omp parallel for schedule(static) if (places() > many)
  for (std::size_t p = 0; p < stiffness_.size(); ++p) {
    double w = 0;
    for (auto i = first_[p]; i < first_[p + 1]; ++i) w += terms_[i].second * double(u[terms_[i].first]);
    result[p] = acts(p, w) ? stiffness_[p] * w : 0;
  }
  return result;
}

template <typename Real>
void Contact::add(double factor, const std::vector<double>& pressures, Values<Real>& forces) const {
  Real* const f = forces.data();
#pragma omp parallel for schedule(static) if (row_.size() > many)
  for (std::size_t r = 0; r < row_.size(); ++r) {
    double sum = 0;
    for (auto i = first_of_row_[r]; i < first_of_row_[r + 1]; ++i)
      sum += of_row_[i].second * pressures[of_row_[i].first];
    f[row_[r]] += Real(factor * sum);
  }
}

namespace {

constexpr auto below = [](std::size_t, double w) { return w < 0; };

}  // namespace

std::vector<char> Contact::touching(const State& state) const {
  const auto pressed = pressures(state, below);
  std::vector<char> result(places());
  for (std::size_t p = 0; p < result.size(); ++p) result[p] = pressed[p] < 0;
  return result;
}

template <typename Real>
void Contact::add_force(double factor, const Values<Real>& state, Values<Real>& forces) const {
  add(-factor, pressures(state, below), forces);
}

template void Contact::add_force(double, const Values<double>&, Values<double>&) const;
template void Contact::add_force(double, const Values<float>&, Values<float>&) const;

void Contact::add_force(double factor, const State& state, const std::vector<char>& touching, Forces& forces) const {
  add(-factor, pressures(state, [&](std::size_t p, double) { return touching[p] != 0; }), forces);
}

double Contact::energy(const State& state) const {
  const auto pressed = pressures(state, below);
  double sum = 0;
  for (std::size_t p = 0; p < pressed.size(); ++p)
    if (pressed[p] < 0) sum += pressed[p] * pressed[p] / stiffness_[p] / 2;
  return sum;
}

std::pair<double, double> Contact::shares(const State& state) const {
  const auto pressed = pressures(state, below);
  std::pair<double, double> result{0, 0};
  for (std::size_t p = 0; p < pressed.size(); ++p)
    result.second += stiffness_[p], result.first += pressed[p] < 0 ? stiffness_[p] : 0;
  return result;
}

std::size_t Contact::bytes() const {
  return stiffness_.size() * (sizeof(double) + sizeof(std::size_t)) +
         row_.size() * (sizeof(row_[0]) + sizeof(std::size_t)) + (terms_.size() + of_row_.size()) * sizeof(terms_[0]);
}

}  // namespace plate
