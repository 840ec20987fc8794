#pragma once
#include <Eigen/Core>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>

#include "plate/solve/archive_types.hpp"

// Serialization of the checkpoint of a run, for source files that know all of its types. Classes have a serialize()
// with the members that cannot be recomputed; structures are archived as a whole (archived_members).
namespace plate {

/// Number of members of a structure that is archived as a whole, in the order of its members; 0: archived otherwise.
template <typename Structure>
constexpr int archived_members = 0;

}  // namespace plate

namespace cereal {

/// Archives all members of a structure. The structured bindings do not compile once a member is forgotten.
template <typename Archive, typename Structure>
requires(plate::archived_members<Structure> > 0) void serialize(Archive& archive, Structure& structure) {
  constexpr int members = plate::archived_members<Structure>;
  if constexpr (members == 2) {
    auto& [a, b] = structure;
    archive(a, b);
  } else if constexpr (members == 3) {
    auto& [a, b, c] = structure;
    archive(a, b, c);
  } else if constexpr (members == 4) {
    auto& [a, b, c, d] = structure;
    archive(a, b, c, d);
  } else if constexpr (members == 5) {
    auto& [a, b, c, d, e] = structure;
    archive(a, b, c, d, e);
  } else if constexpr (members == 6) {
    auto& [a, b, c, d, e, f] = structure;
    archive(a, b, c, d, e, f);
  } else if constexpr (members == 7) {
    auto& [a, b, c, d, e, f, g] = structure;
    archive(a, b, c, d, e, f, g);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j] = structure;
    archive(a, b, c, d, e, f, g, h, i, j);
  }
}

}  // namespace cereal

namespace Eigen {

template <typename Archive, typename Scalar, int rows, int columns, int options>
void save(Archive& archive, const Matrix<Scalar, rows, columns, options>& matrix) {
  archive(std::int64_t(matrix.rows()), std::int64_t(matrix.cols()));
  archive(cereal::binary_data(matrix.data(), std::size_t(matrix.size()) * sizeof(Scalar)));
}

template <typename Archive, typename Scalar, int rows, int columns, int options>
void load(Archive& archive, Matrix<Scalar, rows, columns, options>& matrix) {
  std::int64_t of_rows = 0, of_columns = 0;
  archive(of_rows, of_columns);
  matrix.resize(of_rows, of_columns);
  archive(cereal::binary_data(matrix.data(), std::size_t(matrix.size()) * sizeof(Scalar)));
}

}  // namespace Eigen
