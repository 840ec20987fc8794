#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/point_map.hpp"
#include "plate/model/space.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Contact;

/// The stiffness of one foundation, spring or stiffener, symmetric and without negative eigenvalues, by rows. Rows
/// and columns are indices of the memory of a State: index_in_state() of their degrees of freedom.
struct ElasticSupport {
  std::string name;                         // foundation0, ..., spring0, ..., stiffener0, ... in the order of the case
  std::optional<geometry::Point> position;  // of a spring at a point [length]
  bool holds = true;                        // against rigid motions: neither a stiffener nor springs on cracks
  bool joins = false;                       // the points of a row move as one body
  std::size_t points = 0;                   // of the plate and beside it
  std::vector<std::uint32_t> row = {};      // ascending; those that are not zero
  std::vector<std::size_t> first = {};      // where the entries of a row begin [rows + 1]
  std::vector<std::uint32_t> column = {};
  std::vector<double> value = {};
  std::shared_ptr<const Contact> contact = {};  // of a unilateral foundation; the matrix is that of contact everywhere

  /// Forces of the elastic supports on the plate, -K state [3 x points]; unilateral foundations press where they are in
  /// contact.
  Forces force(const State& state) const;
  double energy(const State& state) const;

  /// visit(row, column, value) by degrees of freedom.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    const auto dof = [&](std::uint32_t index) { return dof_at(index, points); };
    for (std::size_t r = 0; r < row.size(); ++r)
      for (auto i = first[r]; i < first[r + 1]; ++i) visit(dof(row[r]), dof(column[i]), value[i]);
  }
};

/// Contact of each unilateral foundation, by its places; empty for other supports.
using ContactState = std::vector<std::vector<char>>;

/// Elastic supports of a plate: foundations, springs and stiffeners. A plate without has none, and its products do
/// nothing here. Copies share what they hold. Any number of threads gives the same bits.
class ElasticSupports {
public:
  ElasticSupports() = default;
  explicit ElasticSupports(std::vector<ElasticSupport> parts);

  const std::vector<std::shared_ptr<const ElasticSupport>>& parts() const { return parts_; }
  /// Supports that hold the plate against rigid motions.
  std::vector<std::shared_ptr<const ElasticSupport>> holding() const;
  /// visit(k, j) for points that springs between the faces of cracks let move as one body.
  template <typename Visit>
  void for_each_joined(const Visit& visit) const {
    for (const auto& part : parts_)
      if (part->joins)
        part->for_each([&](const Dof& row, const Dof& column, double) { visit(row.point, column.point); });
  }

  void add_force(const State& state, Forces& forces) const;  // forces += -K state
  void add_force(const Values<float>& state, Values<float>& forces) const;
  /// forces -= -K state: what is left is the plate's own.
  void take_force(const State& state, Forces& forces) const;
  void add_absolute_product(const State& state, Forces& forces) const;
  void add_diagonal(Forces& diagonal) const;
  void add_energies(const State& state, Eigen::VectorXd& energies) const;  // of every point
  double energy(const State& state, const PointMap& map = {}) const;
  std::size_t bytes() const;

  bool unilateral() const;
  ContactState touching(const State& state) const;
  /// Share of all unilateral foundations that is in contact.
  double contact_share(const State& state, const PointMap& map = {}) const;
  /// Adds the forces on a state with the contact `touching` less those with its present contact, over all unilateral
  /// foundations.
  void add_change(const State& state, const ContactState& touching, Forces& forces) const;

private:
  std::vector<std::shared_ptr<const ElasticSupport>> parts_;
};

/// A part of a form: factor times a degree of freedom.
struct FormTerm {
  Dof dof;
  double factor;
};

/// Sum of springs that become one elastic support.
class ElasticSupportSum {
public:
  explicit ElasticSupportSum(std::size_t points) : points_(points) {}

  /// Adds a spring with the energy stiffness / 2 (sum of factor * u)^2.
  void add(double stiffness, const std::vector<FormTerm>& form);
  /// A symmetric matrix of some degrees of freedom.
  void add(const std::vector<Dof>& dofs, const Eigen::Ref<const Eigen::MatrixXd>& matrix);
  /// Adds a place of a unilateral foundation.
  void add_unilateral(double stiffness, const std::vector<FormTerm>& form);
  ElasticSupport taken(std::string name, const std::optional<geometry::Point>& position, bool holds = true) &&;

private:
  struct Entry {
    std::uint64_t place;  // row, then column
    double value;
  };
  std::size_t points_;
  std::vector<Entry> entries_;
  std::vector<std::pair<double, std::vector<FormTerm>>> places_;  // that touch
};

}  // namespace plate
