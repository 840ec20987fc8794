#pragma once
#include <optional>
#include <vector>

#include "post/factors/srif.hpp"
#include "post/files/table.hpp"

namespace plate {
class Formulation;
}

namespace post {

class TipMethods;
struct StoredRun;

/// Factors of the same tips that were found in other ways: how far they are off bounds the errors.
struct OtherFactors {
  std::vector<std::vector<Srif>> coarser = {};  // with twice the spacing, row by row; a single row is for all
  std::string formulation = {};                 // another one
  std::vector<std::vector<Srif>> second = {};   // by it, row by row, the recommended of each tip first
  bool closed = false;                          // faces of cracks touch

  /// Widens the errors of a row.
  void widen_row(std::size_t number, std::vector<Srif>& row, double thickness) const;
};

/// The intensity factors of a run row by row, with all that bears on their estimated errors. The tips of all rows are
/// the same.
class FactorRows {
public:
  explicit FactorRows(double thickness) : thickness_(thickness) {}

  /// Sets the factors that count in estimated errors.
  void compare_with(OtherFactors others) { others_ = std::move(others); }
  /// The factors of all rows where they are known already, the recommended ones of each tip first.
  void known(std::vector<std::vector<Srif>> rows) { known_ = std::move(rows); }
  bool known() const { return !known_.empty(); }
  /// Sets the truncation error of every tip in a motion, which the estimated errors do not include: a share of the
  /// largest factor that the tip ever has.
  void truncated(std::vector<double> shares) { truncated_ = std::move(shares); }

  /// A row. `found`: without meaning where all rows are known. Throws plate::NumericalError where one is not finite.
  void add(std::vector<Srif> found, const std::string& when);
  /// The rows of srif.csv at these times: a factor that is small beside what its tip has at other times is no less
  /// resolved for it.
  Table table(const std::vector<double>& times);

  const std::vector<std::vector<Srif>>& rows() const { return rows_; }
  std::vector<Srif> last() const { return rows_.empty() ? std::vector<Srif>{} : rows_.back(); }
  /// Largest factor of every tip so far, by any method: largest_with_plane().
  const std::vector<double>& largest() const { return largest_; }
  /// Warnings of tips where truncation leaves out more than 3 % of the largest factor. `tolerance`: of the analysis.
  std::vector<std::string> warnings(double tolerance) const;

  /// The rows so far.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(rows_, largest_);
  }

private:
  double thickness_;
  OtherFactors others_;
  std::vector<std::vector<Srif>> known_, rows_;
  std::vector<double> truncated_, largest_;
};

/// The rows of srif.csv: time,tip,x,y,method,K1,K2,K3,F1,F2,F3,estimated_error,fit_residual,samples,
/// estimated_error_K1,estimated_error_K2,estimated_error_K3,overlaps_at (name_of(Overlap)), and where loads act in the
/// plane N1,N2,estimated_error_N1,estimated_error_N2; a factor that is not resolved is empty.
void append(Table& table, double time, const std::vector<Srif>& srifs);
std::vector<std::string> srif_columns();

/// A plate in its plane, and the methods for its tips.
struct PlateInPlane {
  const plate::Formulation& membrane;
  const std::vector<TipMethods>& methods;
};

/// The rows of srif.csv, found again in the states of a finished run of this plate. `in_plane`: where loads act there.
/// Throws std::runtime_error where it is a run of another plate or has no displacements in the plane,
/// plate::NumericalError where a factor is not finite.
Table stored_factors(const StoredRun& run, const plate::Formulation& plate, const SrifOptions& options,
                     const std::vector<TipMethods>& methods, const std::optional<PlateInPlane>& in_plane = {});

}  // namespace post
