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

/// Serialization of the checkpoint of a run, for source files that know all of its types. Classes have a serialize()
/// with the members that cannot be recomputed; structures are taken apart by a structured binding, which does not
/// compile once a member is forgotten.
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
