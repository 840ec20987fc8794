#include "plate/bonds/stiffness_matrix.hpp"

#include <omp.h>

#include <algorithm>

#include "plate/galerkin/stiffness.hpp"

namespace plate {
namespace {

constexpr std::size_t piece = 512;  // columns that one thread finds at once

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

std::uint32_t neighbour(std::uint32_t k, const PatternBond& bond) {
  return std::uint32_t(std::int64_t(k) + bond.step);
}

Eigen::Vector2d direction(const PatternBond& bond) {
  return {bond.mx, bond.my};
}

/// The rows of one column of blocks, from the diagonal on, each once.
class Column {
public:
  explicit Column(std::size_t points) : seen_by_(points, none) {}

  void begin(std::uint32_t k) {
    k_ = k;
    rows_.clear();
    couple(k);
  }
  void couple(std::uint32_t row) {
    if (row < k_ || seen_by_[row] == k_) return;
    seen_by_[row] = k_;
    rows_.push_back(row);
  }
  const std::vector<std::uint32_t>& sorted() {
    std::sort(rows_.begin(), rows_.end());
    return rows_;
  }

private:
  static constexpr auto none = std::uint32_t(-1);
  std::uint32_t k_ = 0;
  std::vector<std::uint32_t> rows_, seen_by_;
};

/// A matrix of zeros with the rows that couple(column, k) names.
template <typename Couple>
PointMatrix zeros(std::size_t points, const Couple& couple) {
  std::vector<std::vector<std::uint32_t>> rows((points + piece - 1) / piece);
  PointMatrix result;
  result.first.assign(points + 1, 0);
#pragma omp parallel
  {
    Column column(points);
#pragma omp for schedule(dynamic)
    for (std::size_t p = 0; p < rows.size(); ++p)
      for (auto k = p * piece; k < std::min(points, (p + 1) * piece); ++k) {
        column.begin(std::uint32_t(k));
        couple(column, std::uint32_t(k));
        const auto& sorted = column.sorted();
        rows[p].insert(rows[p].end(), sorted.begin(), sorted.end());
        result.first[k + 1] = sorted.size();
      }
  }
  for (std::size_t k = 0; k < points; ++k) result.first[k + 1] += result.first[k];
  result.row.reserve(result.first.back());
  for (const auto& some : rows) result.row.insert(result.row.end(), some.begin(), some.end());
  result.block.assign(result.row.size(), Eigen::Matrix3d::Zero());
  return result;
}

/// The blocks of one column at a time, by their rows.
class ColumnBlocks {
public:
  explicit ColumnBlocks(PointMatrix& matrix) : matrix_(matrix), place_(matrix.points()) {}

  void begin(std::uint32_t k) {
    k_ = k;
    for (auto b = matrix_.first[k]; b < matrix_.first[k + 1]; ++b) place_[matrix_.row[b]] = std::uint32_t(b);
  }
  /// Of a row of the column, from the diagonal on.
  Eigen::Matrix3d& at(std::uint32_t row) { return matrix_.block[place_[row]]; }
  bool has(std::uint32_t row) const { return row >= k_; }

private:
  PointMatrix& matrix_;
  std::uint32_t k_ = 0;
  std::vector<std::uint32_t> place_;
};

/// Bending and shear of the bonds of point k.
void add_bonds(const Bonds& bonds, std::uint32_t k, ColumnBlocks& column) {
  for (auto bond = bonds.begin(k); bond < bonds.end(k); ++bond) {
    const auto j = neighbour(k, *bond);
    const Eigen::Vector2d m = direction(*bond), half = bond->length / 2 * m;
    // shear: w_j - w_k - length / 2 m (theta_j + theta_k); curvature: m (theta_j - theta_k)
    const Eigen::Vector3d own(-1, -half.x(), -half.y()), other(1, -half.x(), -half.y());
    Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
    bend.bottomRightCorner<2, 2>() = bond->curvature * m * m.transpose();
    column.at(k) += bond->shear * own * own.transpose() + bend;
    if (column.has(j)) column.at(j) += bond->shear * other * own.transpose() - bend;
  }
}

/// Dilatations of k and of its neighbours p: theta_p = sum D m (theta_j - theta_p).
void add_dilatations(const FamilyOperator& plate, const Bonds& bonds, std::uint32_t k, ColumnBlocks& column) {
  const auto add = [&](std::uint32_t p, const Eigen::Vector2d& by_k) {
    const Eigen::Vector2d factor = plate.dilatation_stiffness()[p] * by_k;
    Eigen::Vector2d sum(0, 0);
    for (auto bond = bonds.begin(p); bond < bonds.end(p); ++bond) {
      const Eigen::Vector2d by_j = bond->D_kj * direction(*bond);
      sum -= by_j;
      const auto j = neighbour(p, *bond);
      if (column.has(j)) column.at(j).bottomRightCorner<2, 2>() += by_j * factor.transpose();
    }
    if (column.has(p)) column.at(p).bottomRightCorner<2, 2>() += sum * factor.transpose();
  };
  Eigen::Vector2d own(0, 0);
  for (auto bond = bonds.begin(k); bond < bonds.end(k); ++bond) {
    own -= bond->D_kj * direction(*bond);
    add(neighbour(k, *bond), -bond->D_jk * direction(*bond));
  }
  add(k, own);
}

/// A point and its neighbours, ascending, with their places in its family; 0: the point itself.
struct Members {
  std::array<std::uint32_t, FamilyStiffness::most_members> point, place;
  std::size_t count = 0;

  Members(const geometry::Families& families, std::uint32_t k) {
    std::uint32_t i = 0;
    bool taken = false;
    const auto take = [&](std::uint32_t j, std::uint32_t at) { point[count] = j, place[count++] = at; };
    for (const auto& bond : families[k]) {
      if (!taken && bond.neighbour > k) take(k, 0), taken = true;
      take(bond.neighbour, ++i);
    }
    if (!taken) take(k, 0);
  }
};

/// Adds the blocks of one family in the columns begin ... end - 1.
void add_family(const FamilyStiffness& family, const Members& members, std::uint32_t begin, std::uint32_t end,
                PointMatrix& matrix) {
  for (std::size_t c = 0; c < members.count; ++c) {
    const auto k = members.point[c];
    if (k < begin || k >= end) continue;
    auto at = matrix.first[k];
    for (auto r = c; r < members.count; ++r) {
      while (matrix.row[at] != members.point[r]) ++at;
      matrix.block[at] += family.block(members.place[r], members.place[c]);
    }
  }
}

}  // namespace

PointMatrix stiffness_matrix(const FamilyOperator& plate, bool with_dilatation) {
  const Bonds bonds(plate);
  auto result = zeros(plate.points(), [&](Column& column, std::uint32_t k) {
    for (auto bond = bonds.begin(k); bond < bonds.end(k); ++bond) {
      const auto p = neighbour(k, *bond);
      column.couple(p);
      if (!with_dilatation) continue;
      for (auto next = bonds.begin(p); next < bonds.end(p); ++next) column.couple(neighbour(p, *next));
    }
  });
#pragma omp parallel
  {
    ColumnBlocks column(result);
#pragma omp for schedule(dynamic, 64)
    for (std::uint32_t k = 0; k < plate.points(); ++k) {
      column.begin(k);
      add_bonds(bonds, k, column);
      if (with_dilatation) add_dilatations(plate, bonds, k, column);
    }
  }
  return result;
}

PointMatrix stiffness_matrix(const GalerkinOperator& plate) {
  const auto& all = plate.families();
  const auto points = plate.points();
  auto result = zeros(points, [&](Column& column, std::uint32_t k) {
    for (const auto& bond : all.families[k]) {
      column.couple(bond.neighbour);
      for (const auto& next : all.families[bond.neighbour]) column.couple(next.neighbour);
    }
  });
  // every thread has columns of its own, and adds the families to them in their order; of the lattice there is one,
  // whichever thread this is: areas of its points differ in the last bit
  const auto lattice = std::uint32_t(std::ranges::find(all.kind, 0u) - all.kind.begin());
#pragma omp parallel
  {
    const auto threads = std::size_t(omp_get_num_threads()), thread = std::size_t(omp_get_thread_num());
    const auto begin = std::uint32_t(points * thread / threads), end = std::uint32_t(points * (thread + 1) / threads);
    FamilyStiffness own(all, plate.section()), shared(all, plate.section());
    if (lattice < points) shared.find(lattice);
    for (std::uint32_t k = 0; k < points && begin < end; ++k) {
      const Members members(all.families, k);
      if (members.point[members.count - 1] < begin || members.point[0] >= end) continue;
      if (all.kind[k] != 0) own.find(k);
      add_family(all.kind[k] == 0 ? shared : own, members, begin, end, result);
    }
  }
  return result;
}

}  // namespace plate
