#include "plate/bonds/rows/lattice_operator.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "plate/bonds/rows/folded_row.hpp"
#include "plate/bonds/rows/gathered_points.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/reduction.hpp"

namespace plate {

std::size_t Tasks::begin(int thread, int threads) const {
  if (until_.empty() || thread == threads) return until_.size();
  const double share = until_.back() * (double(thread) / threads);
  return std::size_t(std::lower_bound(until_.begin(), until_.end(), share) - until_.begin());
}

namespace {

double shortest_bond(const FamilyOperator& plate) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& vector : plate.families().vectors()) shortest = std::min(shortest, vector.norm());
  return shortest;
}

/// Shear weights in single precision as multiples of one power of two, so that their sum over a family is exact: its
/// rounding would act on the whole deflection, as a foundation does.
template <typename Real>
Patterns rounded(Patterns patterns, const std::vector<std::uint32_t>& pattern_of, const OperatedPart& part) {
  if constexpr (std::is_same_v<Real, float>) {
    std::vector<char> used(patterns.first.size() - 1, part.wanted.empty());
    for (std::size_t k = 0; k < part.wanted.size(); ++k)
      if (part.wanted[k]) used[pattern_of[k]] = 1;
    double largest = 0;  // sum over a family
    for (std::size_t p = 0; p < used.size(); ++p) {
      double sum = 0;
      for (auto b = patterns.first[p]; b < patterns.first[p + 1]; ++b) sum += std::abs(patterns.bonds[b].shear);
      if (used[p]) largest = std::max(largest, sum);
    }
    largest = largest_of(part, largest);
    const double quantum = std::exp2(std::ceil(std::log2(largest)) - std::numeric_limits<float>::digits);
    if (largest > 0)
      for (auto& bond : patterns.bonds) bond.shear = std::round(bond.shear / quantum) * quantum;
  }
  return patterns;
}

/// Rough time of a row, in operations on a vector.
template <typename Real>
double row_work(const RowPattern<Real>& pattern, double length) {
  const std::size_t bonds = pattern.fold ? pattern.fold->bonds.size() : pattern.pairs.size() + pattern.singles.size();
  return ((pattern.fold ? 13 : 24) * double(bonds) + 40) * length / double(Lane<Real>::size());
}

}  // namespace

/// Work arrays of one thread: the fields of a gathered row.
template <typename Real>
struct LatticeRows<Real>::Scratch {
  std::size_t size;  // numbers of a field
  std::unique_ptr<Real[]> values;

  explicit Scratch(std::size_t field_size) : size(field_size), values(new Real[7 * field_size]()) {}
  Real* of(std::size_t n) { return values.get() + n * size; }
  Fields<Real> fields() { return {of(0), of(1), of(2), of(3)}; }
};

template <typename Real>
LatticeRows<Real>::LatticeRows(const FamilyOperator& plate) : exchange_(plate.part().exchange) {
  if (exchange_ && plate.part().pending.size() != plate.points())
    throw std::invalid_argument("what of a part of a plate waits for others is not known");
  q_.setZero(Eigen::Index(plate.points()));
  const double spacing = shortest_bond(plate);
  std::vector<std::uint32_t> pattern_of(plate.points());
  for (const auto& run : plate.runs().runs) std::fill_n(pattern_of.begin() + run.first_point, run.length, run.pattern);
  const Patterns patterns = rounded<Real>(plate.patterns(), pattern_of, plate.part());
  add_columns(patterns, add_rows(plate.runs(), patterns, spacing, plate.part()), pattern_of, spacing, plate.part());
  select_wanted(plate.part().wanted);
  share_out();
}

template <typename Real>
std::vector<std::uint32_t> LatticeRows<Real>::add_rows(const geometry::FamilyRuns& runs, const Patterns& patterns,
                                                       double spacing, const OperatedPart& part) {
  std::vector<std::uint32_t> loose;
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> known;  // pattern, may be folded
  std::size_t in_rows = 0, folded = 0;
  const auto pattern_of = [&](std::uint32_t pattern, bool foldable) {
    const auto [entry, fresh] = known.try_emplace({pattern, foldable}, std::uint32_t(patterns_.size()));
    if (fresh)
      patterns_.push_back(row_pattern<Real>(patterns.of(pattern), patterns.stiffness[pattern],
                                            foldable ? std::optional(spacing) : std::nullopt));
    return entry->second;
  };
  for (const auto& run : runs.runs) {
    if (run.length < lanes) {
      for (std::uint32_t i = 0; i < run.length; ++i) loose.push_back(run.first_point + i);
      continue;
    }
    auto pattern = pattern_of(run.pattern, true);
    const auto first = std::int64_t(run.first_point), last = first + run.length - 1;
    if (patterns_[pattern].fold &&
        (first + patterns_[pattern].lowest < 0 ||
         last + patterns_[pattern].highest + std::int64_t(FoldLane<Real>::size()) > q_.size()))
      pattern = pattern_of(run.pattern, false);  // a fold also reads beyond what its points see
    const auto read = run.length + (patterns_[pattern].fold ? std::uint32_t(FoldLane<Real>::size()) : 0);
    const bool waits = part.waits(run.first_point, read, patterns.of(run.pattern));
    rows_.push_back({run.first_point, run.length, pattern, waits});
    in_rows += run.length, folded += patterns_[pattern].fold ? run.length : 0;
  }
  const double all = std::max<double>(1, double(q_.size()));
  row_share_ = double(in_rows) / all, folded_share_ = double(folded) / all;
  return loose;
}

template <typename Real>
void LatticeRows<Real>::add_columns(const Patterns& patterns, const std::vector<std::uint32_t>& points,
                                    const std::vector<std::uint32_t>& pattern_of, double spacing,
                                    const OperatedPart& part) {
  constexpr std::uint32_t longest = 128;
  auto found = point_columns(patterns, points, {pattern_of, part.block}, spacing, lanes, longest, farthest, pitch);
  if (!part.wanted.empty()) std::erase_if(found.rest, [&](std::uint32_t k) { return !part.wanted[k]; });
  const auto first_pattern = std::uint32_t(patterns_.size());
  for (const auto& one : found.patterns) patterns_.push_back(row_pattern<Real>(one.bonds, one.stiffness, spacing));
  for (const auto& column : found.columns) {
    gathered_.push_back({std::uint32_t(column.points.size()), first_pattern + column.pattern, column.reach,
                         gathered_points_.size(), sources_.size(),
                         std::ranges::any_of(column.sources, [&](auto k) { return part.waits(k, 1, {}); })});
    gathered_points_.insert(gathered_points_.end(), column.points.begin(), column.points.end());
    sources_.insert(sources_.end(), column.sources.begin(), column.sources.end());
  }
  packet_share_ = double(found.rest.size()) / std::max<double>(1, double(q_.size()));
  const auto inside = std::ranges::stable_partition(
      found.rest, [&](std::uint32_t k) { return part.waits(k, 1, patterns.of(pattern_of[k])); });
  packets_.add(patterns, {found.rest.begin(), inside.begin()}, pattern_of);
  waiting_packets_ = packets_.size();
  packets_.add(patterns, {inside.begin(), inside.end()}, pattern_of);
}

/// Leaves out rows and columns of which nothing is wanted; they are found with all, so that what is wanted is computed
/// the same way in every part.
template <typename Real>
void LatticeRows<Real>::select_wanted(const std::vector<char>& wanted) {
  if (wanted.empty()) return;
  std::erase_if(rows_, [&](const Row& row) {
    return std::none_of(wanted.begin() + row.first, wanted.begin() + row.first + row.length, [](char w) { return w; });
  });
  std::erase_if(gathered_, [&](const GatheredRow& row) {
    const auto* const first = gathered_points_.data() + row.first_point;
    return std::none_of(first, first + row.length, [&](std::uint32_t k) { return wanted[k]; });
  });
}

template <typename Real>
void LatticeRows<Real>::share_out() {
  constexpr double per_source = 3;
  std::size_t one = 0;
  const auto add = [&](bool waits, double work) { (waits ? waiting_ : inside_).add(one++, work); };
  for (const auto& row : rows_) add(row.waits, row_work(patterns_[row.pattern], row.length));
  for (const auto& row : gathered_) {
    const double sources = (2 * row.reach + 1) * (row.length + 2 * row.reach);
    add(row.waits, row_work(patterns_[row.pattern], row.length) + per_source * sources);
    field_size_ = std::max(field_size_, std::size_t((2 * row.reach + 1) * pitch) + pitch);
  }
  for (std::size_t i = 0; i < packets_.size(); ++i) add(i < waiting_packets_, packets_.work(i));
}

template <typename Real>
void LatticeRows<Real>::row_dilatation(const Row& row, const Fields<Real>& in, Real* q) const {
  const auto& pattern = patterns_[row.pattern];
  if (pattern.fold) {
    visit_disc(pattern.fold->radius_squared, [&]<int r>(std::integral_constant<int, r>) {
      FoldedRow<Real, r>(pattern, in, row.first, row.length).dilatation(q);
    });
    return;
  }
  along<Real>(row.first, row.length,
              [&](const auto& place) { place.store(pattern.stiffness * dilatation(place, pattern, in), q); });
}

template <typename Real>
void LatticeRows<Real>::row_force(const Row& row, const Fields<Real>& in, const ForceFields<Real>& out) const {
  const auto& pattern = patterns_[row.pattern];
  if (pattern.fold) {
    visit_disc(pattern.fold->radius_squared, [&]<int r>(std::integral_constant<int, r>) {
      FoldedRow<Real, r>(pattern, in, row.first, row.length).force(out);
    });
    return;
  }
  along<Real>(row.first, row.length, [&](const auto& place) { force(place, pattern, in, out); });
}

/// The row's points and what they see, in rows of their own.
template <typename Real>
typename LatticeRows<Real>::Row LatticeRows<Real>::gather_row(const GatheredRow& row, const Fields<Real>& in, bool all,
                                                              Scratch& scratch) const {
  const std::size_t width = row.length + 2 * row.reach;
  const std::uint32_t* source = sources_.data() + row.first_source;
  for (std::size_t r = 0; r < 2 * row.reach + 1; ++r, source += width) {
    Real *const w = scratch.of(0) + r * pitch, *const x = scratch.of(1) + r * pitch,
                *const y = scratch.of(2) + r * pitch, *const q = scratch.of(3) + r * pitch;
    for (std::size_t i = 0; i < width; ++i) x[i] = in.y[source[i]], y[i] = -in.x[source[i]];
    for (std::size_t i = 0; all && i < width; ++i) w[i] = in.w[source[i]], q[i] = in.q[source[i]];
  }
  return {std::uint32_t(row.reach * pitch + row.reach), row.length, row.pattern, row.waits};
}

template <typename Real>
void LatticeRows<Real>::gathered_dilatation(const GatheredRow& row, const Fields<Real>& in, Scratch& scratch) const {
  const std::uint32_t* const points = gathered_points_.data() + row.first_point;
  const Row local = gather_row(row, in, false, scratch);
  Real* const q = scratch.of(4);
  row_dilatation(local, scratch.fields(), q);
  for (std::uint32_t i = 0; i < row.length; ++i) q_[points[i]] = q[local.first + i];
}

template <typename Real>
void LatticeRows<Real>::gathered_force(const GatheredRow& row, const Fields<Real>& in, const ForceFields<Real>& out,
                                       Scratch& scratch) const {
  const std::uint32_t* const points = gathered_points_.data() + row.first_point;
  const Row local = gather_row(row, in, true, scratch);
  const ForceFields<Real> turned{scratch.of(4), scratch.of(5), scratch.of(6)};
  row_force(local, scratch.fields(), turned);
  for (std::uint32_t i = 0; i < row.length; ++i) {
    const auto k = points[i], at = local.first + i;
    out.force[k] = turned.force[at], out.couple_x[k] = -turned.couple_y[at], out.couple_y[k] = turned.couple_x[at];
  }
}

/// Calls the right one for every row, gathered row and packet of a thread's share of tasks.
template <typename Real>
template <typename OnRow, typename OnGathered, typename OnPacket>
void LatticeRows<Real>::for_share(const Tasks& tasks, const OnRow& row, const OnGathered& gathered,
                                  const OnPacket& packet) const {
  tasks.for_share([&](std::size_t task) {
    if (task < rows_.size())
      row(rows_[task]);
    else if (task < rows_.size() + gathered_.size())
      gathered(gathered_[task - rows_.size()]);
    else
      packet(task - rows_.size() - gathered_.size());
  });
}

/// Two exchanges, each behind the work on rows inside: what a state waits for behind their dilatations, dilatations
/// behind their forces. Of several threads the first waits, while the others go on with what needs nothing of it.
template <typename Real>
void LatticeRows<Real>::internal_force(const Values<Real>& state, Values<Real>& forces, PendingExchange* rest) const {
  const auto count = state.cols();
  if (rest && !exchange_) rest->complete(), rest = nullptr;
  if (forces.cols() != count) forces.setZero(3, count);  // what is not wanted stays zero
  const Real* const w = state.data();
  const Fields<Real> in{w, w + count, w + 2 * count, q_.data()};
  const ForceFields<Real> out{forces.data(), forces.data() + count, forces.data() + 2 * count};
#pragma omp parallel
  {
    Scratch scratch(field_size_);
    const auto dilatations = [&](const Tasks& tasks) {
      for_share(
          tasks, [&](const Row& row) { row_dilatation(row, in, q_.data()); },
          [&](const GatheredRow& row) { gathered_dilatation(row, in, scratch); },
          [&](std::size_t one) { packets_.dilatation(one, in, q_.data()); });
    };
    const auto forces_of = [&](const Tasks& tasks) {
      for_share(
          tasks, [&](const Row& row) { row_force(row, in, out); },
          [&](const GatheredRow& row) { gathered_force(row, in, out, scratch); },
          [&](std::size_t one) { packets_.force(one, in, out); });
    };
    dilatations(inside_);
    if (rest) {
#pragma omp master
      rest->complete();
#pragma omp barrier
    }
    dilatations(waiting_);
#pragma omp barrier
#pragma omp master
    if (exchange_) exchange_->start(std::span(q_.data(), std::size_t(q_.size())));
    forces_of(inside_);
    if (exchange_) {
#pragma omp master
      exchange_->finish();
#pragma omp barrier
    }
    forces_of(waiting_);
  }
}

template <typename Real>
std::size_t LatticeRows<Real>::bytes() const {
  const auto of = [](const auto& values) { return values.size() * sizeof(values[0]); };
  std::size_t sum = of(rows_) + of(gathered_) + of(gathered_points_) + of(sources_) + packets_.bytes() +
                    inside_.bytes() + waiting_.bytes() + std::size_t(q_.size()) * sizeof(Real);
  for (const auto& pattern : patterns_) sum += of(pattern.pairs) + of(pattern.singles);
  return sum;
}

template class LatticeRows<double>;
template class LatticeRows<float>;

}  // namespace plate
