#include "plate/formulation/elastic_supports.hpp"

#include <algorithm>
#include <cmath>

#include "plate/formulation/foundations.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

/// visit(row, sum of weight(value) * state) for every row of an attachment.
template <typename Real, typename Weight, typename Visit>
void for_each_row(const ElasticSupport& a, const Values<Real>& state, const Weight& weight, const Visit& visit) {
  constexpr std::size_t many = 2000;
  const Real* const u = state.data();
#pragma omp parallel for schedule(static) if (a.row.size() > many)
  for (std::size_t r = 0; r < a.row.size(); ++r) {
    double sum = 0;
    for (auto i = a.first[r]; i < a.first[r + 1]; ++i) sum += weight(a.value[i]) * double(u[a.column[i]]);
    visit(a.row[r], sum);
  }
}

double unchanged(double value) {
  return value;
}

template <typename Real>
void add_product(const ElasticSupport& a, double factor, const Values<Real>& state, Values<Real>& forces) {
  Real* const f = forces.data();
  for_each_row(a, state, unchanged, [&](std::uint32_t row, double sum) { f[row] += Real(factor * sum); });
}

/// forces += factor K state, of a unilateral foundation where it is in contact.
template <typename Real>
void add_bilateral(const ElasticSupport& a, double factor, const Values<Real>& state, Values<Real>& forces) {
  if (a.contact)
    a.contact->add_force(-factor, state, forces);
  else
    add_product(a, factor, state, forces);
}

}  // namespace

Forces ElasticSupport::force(const State& state) const {
  Forces result = zero_like(state);
  add_bilateral(*this, -1, state, result);
  return result;
}

double ElasticSupport::energy(const State& state) const {
  if (contact) return contact->energy(state);
  return -force(state).cwiseProduct(state).sum() / 2;
}

ElasticSupports::ElasticSupports(std::vector<ElasticSupport> parts) {
  for (auto& part : parts) parts_.push_back(std::make_shared<const ElasticSupport>(std::move(part)));
}

void ElasticSupports::add_force(const State& state, Forces& forces) const {
  for (const auto& part : parts_) add_bilateral(*part, -1, state, forces);
}

void ElasticSupports::add_force(const Values<float>& state, Values<float>& forces) const {
  for (const auto& part : parts_) add_bilateral(*part, -1, state, forces);
}

void ElasticSupports::take_force(const State& state, Forces& forces) const {
  for (const auto& part : parts_) add_bilateral(*part, 1, state, forces);
}

std::vector<std::shared_ptr<const ElasticSupport>> ElasticSupports::holding() const {
  std::vector<std::shared_ptr<const ElasticSupport>> result;
  for (const auto& part : parts_)
    if (part->holds) result.push_back(part);
  return result;
}

void ElasticSupports::add_absolute_product(const State& state, Forces& forces) const {
  double* const f = forces.data();
  for (const auto& part : parts_)
    for_each_row(
        *part, state, [](double value) { return std::abs(value); },
        [&](std::uint32_t row, double sum) { f[row] += sum; });
}

void ElasticSupports::add_diagonal(Forces& diagonal) const {
  for (const auto& part : parts_)
    for (std::size_t r = 0; r < part->row.size(); ++r)
      for (auto i = part->first[r]; i < part->first[r + 1]; ++i)
        if (part->column[i] == part->row[r]) diagonal.data()[part->row[r]] += part->value[i];
}

void ElasticSupports::add_energies(const State& state, Eigen::VectorXd& energies) const {
  for (const auto& part : parts_) {
    const Forces force = part->force(state);
    energies -= force.cwiseProduct(state).colwise().sum().transpose() / 2;
  }
}

double ElasticSupports::energy(const State& state, const PointMap& map) const {
  Forces force = zero_like(state);
  add_force(state, force);
  return ordered_sum<1>(map, std::size_t(state.cols()), [&](std::size_t n) {
    const auto k = Eigen::Index(n);
    return std::array<double, 1>{map.owns(n) ? -state.col(k).dot(force.col(k)) / 2 : 0};
  })[0];
}

std::size_t ElasticSupports::bytes() const {
  std::size_t sum = 0;
  for (const auto& part : parts_)
    sum += part->row.size() * (sizeof(std::uint32_t) + sizeof(std::size_t)) +
           part->column.size() * (sizeof(std::uint32_t) + sizeof(double)) +
           (part->contact ? part->contact->bytes() : 0);
  return sum;
}

bool ElasticSupports::unilateral() const {
  return std::ranges::any_of(parts_, [](const auto& part) { return bool(part->contact); });
}

ContactState ElasticSupports::touching(const State& state) const {
  ContactState result;
  for (const auto& part : parts_)
    result.push_back(part->contact ? part->contact->touching(state) : std::vector<char>());
  return result;
}

double ElasticSupports::contact_share(const State& state, const PointMap& map) const {
  const auto [touching, all] = exact_sum<2>(map, parts_.size(), [&](std::size_t i, const auto& add) {
    if (!parts_[i]->contact) return;
    parts_[i]->contact->for_each(state, [&](std::size_t point, double stiffness, bool touches) {
      if (map.owns(point)) add(0, touches ? stiffness : 0), add(1, stiffness);
    });
  });
  return all > 0 ? touching / all : 0;
}

void ElasticSupports::add_change(const State& state, const ContactState& touching, Forces& forces) const {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (const auto& contact = parts_[i]->contact) {
      contact->add_force(-1, state, forces);
      contact->add_force(1, state, touching[i], forces);
    }
}

void ElasticSupportSum::add(double stiffness, const std::vector<FormTerm>& form) {
  std::vector<Dof> dofs;
  Eigen::VectorXd factors{Eigen::Index(form.size())};
  for (const auto& term : form) factors[Eigen::Index(dofs.size())] = term.factor, dofs.push_back(term.dof);
  add(dofs, stiffness * factors * factors.transpose());
}

void ElasticSupportSum::add_unilateral(double stiffness, const std::vector<FormTerm>& form) {
  places_.emplace_back(stiffness, form);
  add(stiffness, form);
}

void ElasticSupportSum::add(const std::vector<Dof>& dofs, const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  const auto at = [&](Eigen::Index i) { return std::uint64_t(index_in_state(dofs[std::size_t(i)], points_)); };
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      if (matrix(i, j) != 0) entries_.push_back({at(i) << 32 | at(j), matrix(i, j)});
}

ElasticSupport ElasticSupportSum::taken(std::string name, const std::optional<geometry::Point>& position,
                                        bool holds) && {
  ElasticSupport result{.name = std::move(name), .position = position, .holds = holds, .points = points_};
  std::ranges::stable_sort(entries_, {}, &Entry::place);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto [place, value] = entries_[i];
    if (i > 0 && place == entries_[i - 1].place) {
      result.value.back() += value;
      continue;
    }
    if (const auto row = std::uint32_t(place >> 32); result.row.empty() || result.row.back() != row) {
      result.row.push_back(row);
      result.first.push_back(result.column.size());
    }
    result.column.push_back(std::uint32_t(place));
    result.value.push_back(value);
  }
  result.first.push_back(result.column.size());
  entries_.clear();
  if (!places_.empty()) {
    std::vector<Contact::Place> places;
    for (const auto& [stiffness, form] : places_) {
      places.push_back({stiffness, {}});
      for (const auto& [dof, factor] : form)
        places.back().form.emplace_back(std::uint32_t(index_in_state(dof, points_)), factor);
    }
    result.contact = std::make_shared<const Contact>(places);
  }
  return result;
}

}  // namespace plate
