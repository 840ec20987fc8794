#include "plate/stiffness_matrix.hpp"

#include <algorithm>

namespace plate {
namespace {

using Entry = MatrixColumn::value_type;

/// The bonds of every point, by its run.
class Bonds {
public:
  explicit Bonds(const FamilyOperator& plate) : plate_(plate), pattern_(plate.points()) {
    for (const auto& run : plate.runs().runs)
      for (std::uint32_t i = 0; i < run.length; ++i) pattern_[run.first_point + i] = run.pattern;
  }
  const PatternBond* begin(std::size_t k) const { return at(pattern_[k]); }
  const PatternBond* end(std::size_t k) const { return at(pattern_[k] + 1); }

private:
  const PatternBond* at(std::size_t pattern) const {
    return plate_.patterns().bonds.data() + plate_.patterns().first[pattern];
  }
  const FamilyOperator& plate_;
  std::vector<std::uint32_t> pattern_;
};

double component(const PatternBond& bond, std::size_t c) {
  return c == 1 ? bond.mx : bond.my;
}

/// Calls add(degree of freedom, value) for a row of K, values of one entry in several parts.
template <typename Add>
void row_of(const FamilyOperator& plate, const Bonds& bonds, std::size_t dof, bool with_dilatation, const Add& add) {
  const std::size_t k = dof / 3, c = dof % 3;
  for (auto bond = bonds.begin(k); bond < bonds.end(k); ++bond) {
    const std::size_t j = std::size_t(std::int64_t(k) + bond->step);
    // shear: w_j - w_k - length/2 m (theta_j + theta_k); curvature: m (theta_j - theta_k)
    const double own_shear = c == 0 ? -1 : -bond->length / 2 * component(*bond, c);
    const double shear = bond->shear * own_shear;
    add(3 * j, shear), add(3 * k, -shear);
    for (const std::size_t d : {1, 2}) {
      const double m = component(*bond, d);
      const double bend = c == 0 ? 0 : -bond->curvature * component(*bond, c) * m;
      add(3 * j + d, bend - shear * bond->length / 2 * m);
      add(3 * k + d, -bend - shear * bond->length / 2 * m);
    }
  }
  if (!with_dilatation || c == 0) return;
  // theta_p = sum D m (theta_j - theta_p) of the point itself and of its neighbours p
  const auto dilatation = [&](std::size_t p, double share) {
    const double factor = plate.dilatation_stiffness()[Eigen::Index(p)] * share;
    if (factor == 0) return;
    for (auto bond = bonds.begin(p); bond < bonds.end(p); ++bond)
      for (const std::size_t d : {1, 2}) {
        const double value = factor * bond->D_kj * component(*bond, d);
        add(3 * std::size_t(std::int64_t(p) + bond->step) + d, value), add(3 * p + d, -value);
      }
  };
  double own = 0;
  for (auto bond = bonds.begin(k); bond < bonds.end(k); ++bond) {
    own -= bond->D_kj * component(*bond, c);
    dilatation(std::size_t(std::int64_t(k) + bond->step), -bond->D_jk * component(*bond, c));
  }
  dilatation(k, own);
}

void merge(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.first < b.first; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].first == entries[last].first)
      entries[last].second += entries[i].second;
    else
      entries[++last] = entries[i];
  }
  if (!entries.empty()) entries.resize(last + 1);
}

/// P^T K P of the unknowns, lower triangle. Every thread makes its own `rows`: rows(dof, add) calls add(degree of freedom,
/// value) for a row of K, values of one entry in several parts.
template <typename MakeRows>
Eigen::SparseMatrix<double> folded_matrix(const MakeRows& make_rows, const Constraints& constraints,
                                          const Unknowns& unknowns) {
  // what every degree of freedom follows, and what follows every unknown
  std::vector<std::vector<std::pair<std::uint32_t, double>>> followers(unknowns.dof.size());
  std::vector<std::vector<Entry>> leaders(unknowns.index.size());
  for (const auto& tie : constraints.ties())
    if (const auto leader = unknowns.index[tie.leader]; leader >= 0) {
      followers[std::size_t(leader)].emplace_back(tie.follower, tie.factor);
      leaders[tie.follower].emplace_back(leader, tie.factor);
    }

  const auto size = unknowns.size();
  std::vector<MatrixColumn> columns(static_cast<std::size_t>(size));
#pragma omp parallel
  {
    std::vector<Entry> entries;
    auto rows = make_rows();
#pragma omp for schedule(dynamic, 256)
    for (Eigen::Index u = 0; u < size; ++u) {
      entries.clear();
      const auto add_row = [&](std::uint32_t dof, double factor) {
        rows(dof, [&](std::size_t other, double value) {
          if (const auto index = unknowns.index[other]; index >= 0) {
            if (index >= u) entries.emplace_back(index, factor * value);
            return;
          }
          for (const auto& [index, share] : leaders[other])
            if (index >= u) entries.emplace_back(index, factor * share * value);
        });
      };
      add_row(unknowns.dof[std::size_t(u)], 1);
      for (const auto& [dof, factor] : followers[std::size_t(u)]) add_row(dof, factor);
      merge(entries);
      columns[std::size_t(u)] = entries;
    }
  }
  return compressed(columns);
}

/// Rows of the Galerkin plate's K; those of one point are found together.
class FamilyRowsOf {
public:
  explicit FamilyRowsOf(const GalerkinOperator& plate) : plate_(plate) {
    // of the first of them, whichever thread this is: their areas differ in the last bit
    const auto& families = plate.families();
    const auto first = std::ranges::find(families.kind, 0u);
    if (first != families.kind.end())
      lattice_ = family_stiffness(families, plate.section(), std::uint32_t(first - families.kind.begin()));
  }

  template <typename Add>
  void operator()(std::size_t dof, const Add& add) {
    if (point_ != dof / 3) find(std::uint32_t(dof / 3));
    for (const auto& [point, block] : blocks_)
      for (std::size_t d = 0; d < 3; ++d) add(3 * std::size_t(point) + d, block(Eigen::Index(dof % 3), Eigen::Index(d)));
  }

private:
  void find(std::uint32_t k) {
    point_ = k;
    blocks_.clear();
    const auto& families = plate_.families();
    add(k, k);
    for (const auto& bond : families.families[k]) add(bond.neighbour, k);
  }

  /// The rows of k in the family of `owner`.
  void add(std::uint32_t owner, std::uint32_t k) {
    const auto& families = plate_.families();
    const auto family = families.families[owner];
    const Eigen::MatrixXd own =
        families.kind[owner] == 0 ? Eigen::MatrixXd() : family_stiffness(families, plate_.section(), owner);
    const Eigen::MatrixXd& K = families.kind[owner] == 0 ? lattice_ : own;
    const auto row = owner == k ? 0 : Eigen::Index(3 * (family.find(k) + 1));
    for (std::size_t b = 0; b <= family.size(); ++b)
      blocks_.emplace_back(b == 0 ? owner : family[b - 1].neighbour, K.block<3, 3>(row, Eigen::Index(3 * b)));
  }

  const GalerkinOperator& plate_;
  std::size_t point_ = std::size_t(-1);
  Eigen::MatrixXd lattice_;  // of kind 0
  std::vector<std::pair<std::uint32_t, Eigen::Matrix3d>> blocks_;
};

}  // namespace

Unknowns unknowns(const Forces& diagonal) {
  Unknowns result;
  for (std::size_t dof = 0; dof < std::size_t(diagonal.size()); ++dof) {
    const bool free = at_dof(diagonal, dof) > 0;
    result.index.push_back(free ? std::int32_t(result.dof.size()) : -1);
    if (free) result.dof.push_back(std::uint32_t(dof));
  }
  return result;
}

Eigen::SparseMatrix<double> compressed(const std::vector<MatrixColumn>& columns) {
  const auto size = Eigen::Index(columns.size());
  Eigen::SparseMatrix<double> result(size, size);
  std::int64_t count = 0;
  for (Eigen::Index u = 0; u < size; ++u)
    result.outerIndexPtr()[u] = int(count), count += std::int64_t(columns[std::size_t(u)].size());
  result.outerIndexPtr()[size] = int(count);
  result.resizeNonZeros(count);
  for (Eigen::Index u = 0; u < size; ++u) {
    auto at = result.outerIndexPtr()[u];
    for (const auto& [row, value] : columns[std::size_t(u)])
      result.innerIndexPtr()[at] = row, result.valuePtr()[at++] = value;
  }
  return result;
}

Eigen::SparseMatrix<double> stiffness_matrix(const FamilyOperator& plate, const Constraints& constraints,
                                             const Unknowns& unknowns, bool with_dilatation) {
  const Bonds bonds(plate);
  const auto make_rows = [&] {
    return [&](std::size_t dof, const auto& add) { row_of(plate, bonds, dof, with_dilatation, add); };
  };
  return folded_matrix(make_rows, constraints, unknowns);
}

Eigen::SparseMatrix<double> stiffness_matrix(const GalerkinOperator& plate, const Constraints& constraints,
                                             const Unknowns& unknowns) {
  return folded_matrix([&] { return FamilyRowsOf(plate); }, constraints, unknowns);
}

Eigen::SparseMatrix<double> point_graph(const geometry::Families& families) {
  const auto size = Eigen::Index(families.points());
  Eigen::SparseMatrix<double> result(size, size);
  std::vector<int> counts;
  for (std::size_t k = 0; k < families.points(); ++k)
    counts.push_back(int(families[k].size()) + 1);
  result.reserve(counts);
  for (std::size_t k = 0; k < families.points(); ++k) {
    result.insert(Eigen::Index(k), Eigen::Index(k)) = 1;
    for (const auto& bond : families[k])
      if (bond.neighbour > k) result.insert(bond.neighbour, Eigen::Index(k)) = 1;
  }
  result.makeCompressed();
  return result;
}

}  // namespace plate
