#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace plate {

class HaloExchange;
struct Traffic;

/// A point that a process has a copy of: where it is there, and whose it is.
struct Copy {
  std::uint32_t point;
  int owner;
  std::uint32_t of_owner;  // its number there
};

/// Rows of a symmetric matrix of 3 x 3 blocks, positive or not but for rows of zeros, of the points of one process: all
/// points are numbered process by process.
struct DistributedRows {
  std::vector<std::size_t> first{0};  // where the blocks of a row begin [owned points + 1]
  std::vector<std::int64_t> column;   // numbers among all, ascending in every row
  std::vector<double> block;          // [9 x columns], row by row
  std::vector<double> position;       // of the points [2 x own points]: rigid motions are its softest vectors
};

/// An approximate inverse of such a matrix, symmetric; unknowns without stiffness stay zero.
class DistributedInverse {
public:
  virtual ~DistributedInverse() = default;
  /// Applies the inverse to the unknowns of the rank's owned points [3 x points, point by point]. Collective: every
  /// rank must call it.
  virtual void apply(std::span<double> values) const = 0;
  /// Number of negative eigenvalues where the matrix was factorised; 0 elsewhere.
  virtual std::size_t negative() const = 0;
};

/// Product y = A x of a symmetric matrix and a vector, of the unknowns of the rank. Collective.
using DistributedProduct = std::function<void(std::span<const double> x, std::span<double> y)>;

/// Request for eigenpairs of such a matrix: which ones, and how they are found.
struct EigenpairRequest {
  std::size_t count = 1;    // of the largest eigenvalues
  std::size_t basis = 2;    // vectors kept at once, above `count`
  double tolerance = 1e-4;  // |A v - lambda v| <= tolerance lambda
  std::size_t most_restarts = 100;
};

/// Eigenvalues, largest first, and of every eigenvector, of length 1 over all processes, the unknowns of the process.
struct DistributedEigenpairs {
  std::vector<double> values;
  std::vector<std::vector<double>> vectors;
};

/// The ranks that share a plate; one process is a communicator of size 1 (single_process()). Collective: every rank
/// must call the member functions that others take part in, in the same order.
class Communicator {
public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// True where plates are discretised in parts, with ghosts, and sums are made independent of the number of ranks.
  /// Also true of the parallel program with one rank, so that one rank gives the bits that several do.
  virtual bool distributed() const { return true; }
  /// Sums, and largest values, over all ranks; collective.
  virtual void sum(std::span<std::int64_t> values) const = 0;
  virtual void largest(std::span<double> values) const = 0;
  /// `texts`: one for every rank; returns what every rank has sent here.
  virtual std::vector<std::string> exchanged(std::vector<std::string> texts) const = 0;
  /// The texts of all ranks, each of which sends the same to every other.
  std::vector<std::string> text_of_each(const std::string& own) const {
    return exchanged(std::vector<std::string>(std::size_t(size()), own));
  }
  virtual std::unique_ptr<HaloExchange> halo_exchange(std::size_t points, const std::vector<Copy>& copies) const = 0;
  virtual std::unique_ptr<DistributedInverse> inverse(const DistributedRows& rows) const = 0;
  /// Traffic that this rank has received so far; null where it is not counted.
  virtual const Traffic* traffic() const { return nullptr; }
  /// `start`: a vector to begin with. Fewer pairs than wanted where they are not found in so many restarts. What the
  /// product throws is thrown.
  virtual DistributedEigenpairs largest_pairs(const DistributedProduct& product, std::span<const double> start,
                                              const EigenpairRequest& wanted) const = 0;
};

/// Values of one kind as what processes send each other, and back.
template <typename T>
std::string text_of(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::string text(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(text.data(), values.data(), text.size());
  return text;
}

template <typename T>
std::vector<T> values_of(const std::string& text) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> values(text.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), text.data(), text.size());
  return values;
}

/// Asks the owners of ghosts for the indices that these have there; returns the ghosts in ascending order. By rank:
/// `ghosts`, the points that the rank owns, and `keys`, by which it finds them: `index(key)`. Collective.
template <typename Key, typename Index>
std::vector<Copy> indices_at_owners(const Communicator& all, const std::vector<std::vector<std::uint32_t>>& ghosts,
                                    const std::vector<std::vector<Key>>& keys, const Index& index) {
  std::vector<std::string> questions, answers;
  for (const auto& asked : keys) questions.push_back(text_of(asked));
  for (const auto& question : all.exchanged(std::move(questions))) {
    std::vector<std::uint32_t> found;
    for (const auto& key : values_of<Key>(question)) found.push_back(index(key));
    answers.push_back(text_of(found));
  }
  const auto replies = all.exchanged(std::move(answers));
  std::vector<Copy> result;
  for (std::size_t owner = 0; owner < ghosts.size(); ++owner) {
    const auto indices = values_of<std::uint32_t>(replies[owner]);
    for (std::size_t i = 0; i < indices.size(); ++i) result.push_back({ghosts[owner][i], int(owner), indices[i]});
  }
  std::ranges::sort(result, {}, &Copy::point);
  return result;
}

}  // namespace plate
