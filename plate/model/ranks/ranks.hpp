#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plate {

class Exchange;

/// A point that a process has a copy of: where it is there, and whose it is.
struct Copy {
  std::uint32_t point;
  int owner;
  std::uint32_t of_owner;  // its number there
};

/// Rows of a symmetric matrix of 3 x 3 blocks that is positive but for rows of zeros, of the points of one process:
/// all points are numbered process by process.
struct SharedRows {
  std::vector<std::size_t> first{0};  // where the blocks of a row begin [own points + 1]
  std::vector<std::int64_t> column;   // numbers among all, ascending in every row
  std::vector<double> block;          // [9 x columns], row by row
  std::vector<double> position;       // of the points [2 x own points]: rigid motions are its softest vectors
};

/// An approximate inverse of such a matrix, symmetric; unknowns without stiffness stay zero.
class SharedInverse {
public:
  virtual ~SharedInverse() = default;
  /// Of the unknowns of the process's own points [3 x points, point by point]. All processes call it at once.
  virtual void apply(std::span<double> values) const = 0;
};

struct Traffic;
/// A symmetric matrix by its product with a vector: y = A x, of the unknowns of the process. All call it at once.
using SharedProduct = std::function<void(std::span<const double> x, std::span<double> y)>;

/// Which eigenpairs of such a matrix are wanted, and how they are found.
struct PairsWanted {
  std::size_t count = 1;    // of the largest eigenvalues
  std::size_t basis = 2;    // vectors kept at once, above `count`
  double tolerance = 1e-4;  // |A v - lambda v| <= tolerance lambda
  std::size_t most_restarts = 100;
};

/// Eigenvalues, largest first, and of every eigenvector, of length 1 over all processes, the unknowns of the process.
struct SharedPairs {
  std::vector<double> values;
  std::vector<std::vector<double>> vectors;
};

/// The processes that share a plate. What they do together all of them call, in the same order.
class Ranks {
public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual void sum(std::span<std::int64_t> values) const = 0;
  virtual void largest(std::span<double> values) const = 0;
  /// `texts`: one for every process; returns what every process has sent here.
  virtual std::vector<std::string> exchanged(std::vector<std::string> texts) const = 0;
  virtual std::unique_ptr<Exchange> exchange(std::size_t points, const std::vector<Copy>& copies) const = 0;
  virtual std::unique_ptr<SharedInverse> inverse(const SharedRows& rows) const = 0;
  /// What has come to this process so far, where that is counted.
  virtual const Traffic* traffic() const { return nullptr; }
  /// `start`: a vector to begin with. Fewer pairs than wanted where they are not found in so many restarts. What the
  /// product throws is thrown.
  virtual SharedPairs largest_pairs(const SharedProduct& product, std::span<const double> start,
                                    const PairsWanted& wanted) const = 0;
};

/// Those of the thread in hand; nothing where one process holds the whole plate.
const Ranks* ranks();

/// While it lives, the thread is one of these.
class AmongRanks {
public:
  explicit AmongRanks(const Ranks& ranks);
  ~AmongRanks();
  AmongRanks(const AmongRanks&) = delete;
  AmongRanks& operator=(const AmongRanks&) = delete;

private:
  const Ranks* before_;
};

}  // namespace plate
