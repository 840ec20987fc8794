#include "plate/galerkin/stiffness.hpp"

#include <omp.h>

#include "plate/galerkin/family_stiffness.hpp"
#include "plate/solve/matrices/attached_matrix.hpp"
#include "plate/solve/matrices/matrix_pattern.hpp"

namespace plate {
namespace {

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

PointMatrix stiffness_matrix(const GalerkinFamilies& all, const PointSections& sections) {
  const auto points = all.areas.size();
  auto result = zeros(points, [&](Column& column, std::uint32_t k) {
    for (const auto& bond : all.families[k]) {
      column.couple(bond.neighbour);
      for (const auto& next : all.families[bond.neighbour]) column.couple(next.neighbour);
    }
  });
  // every thread has columns of its own, and adds the families to them in their order; of the lattice there is one,
  // whichever thread this is: areas of its points differ in the last bit
  const auto shares = [&](std::uint32_t k) { return sections.uniform() && all.kind[k] == 0; };
  const auto lattice = sections.uniform() ? lattice_family(all) : std::nullopt;
#pragma omp parallel
  {
    const auto threads = std::size_t(omp_get_num_threads()), thread = std::size_t(omp_get_thread_num());
    const auto begin = std::uint32_t(points * thread / threads), end = std::uint32_t(points * (thread + 1) / threads);
    FamilyStiffness own(all, sections), shared(lattice ? *lattice->families : all, sections);
    if (lattice) shared.find(lattice->point);
    for (std::uint32_t k = 0; k < points && begin < end; ++k) {
      const Members members(all.families, k);
      if (members.point[members.count - 1] < begin || members.point[0] >= end) continue;
      if (!shares(k)) own.find(k);
      add_family(shares(k) ? shared : own, members, begin, end, result);
    }
  }
  return result;
}

PointMatrix stiffness_matrix(const GalerkinOperator& plate) {
  return with(plate.own_matrix(), plate.attached());
}

}  // namespace plate
