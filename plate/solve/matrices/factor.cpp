#include "plate/solve/matrices/factor.hpp"

#include <omp.h>
#include <suitesparse/cholmod.h>
#include <suitesparse/umfpack.h>
#include <algorithm>
#include <new>
#include <stdexcept>

#include "plate/model/communicator.hpp"
#include "plate/model/errors.hpp"

namespace plate {
/// The products of a sparse factorisation are too small to share out, and CHOLMOD starts four threads for its loops
/// whatever it is told: measured 1.3 to 1.8 times as long as with none (3,000 to 10,000 points, one thread allowed),
/// and thirty times as long with two on busy processors. Holds for OpenBLAS built with OpenMP.
class OneThread {
public:
  OneThread() : threads_(omp_get_max_threads()), levels_(omp_get_max_active_levels()) {
    omp_set_num_threads(1);
    omp_set_max_active_levels(0);
  }
  ~OneThread() {
    omp_set_max_active_levels(levels_);
    omp_set_num_threads(threads_);
  }
  OneThread(const OneThread&) = delete;

private:
  int threads_, levels_;
};

/// CHOLMOD's settings and workspace; silent.
class Common {
public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;
  }
  ~Common() { cholmod_finish(&common_); }
  Common(const Common&) = delete;
  cholmod_common* operator&() { return &common_; }
  cholmod_common* operator->() { return &common_; }

private:
  cholmod_common common_;
};

namespace {

/// A view of the matrix; nothing is copied.
cholmod_sparse view(const Eigen::SparseMatrix<double>& lower) {
  cholmod_sparse result{};
  result.nrow = result.ncol = std::size_t(lower.rows());
  result.nzmax = std::size_t(lower.nonZeros());
  result.p = const_cast<int*>(lower.outerIndexPtr());
  result.i = const_cast<int*>(lower.innerIndexPtr());
  result.x = const_cast<double*>(lower.valuePtr());
  result.stype = -1;
  result.itype = CHOLMOD_INT, result.xtype = CHOLMOD_REAL, result.dtype = CHOLMOD_DOUBLE;
  result.sorted = result.packed = 1;
  return result;
}

}  // namespace

struct Factor::Handle {
  Common common;
  cholmod_factor* factor = nullptr;
  cholmod_dense *solution = nullptr, *work = nullptr, *more_work = nullptr;

  explicit Handle(bool positive) {
    common->supernodal = positive ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common->quick_return_if_not_posdef = positive;
    common->final_ll = false;
  }
  ~Handle() {
    for (auto** dense : {&solution, &work, &more_work}) cholmod_free_dense(dense, &common);
    cholmod_free_factor(&factor, &common);
  }
};

Factor::Factor(const Eigen::SparseMatrix<double>& lower, double shift) : Factor(lower, shift, true) {}

Factor Factor::of_any_sign(const Eigen::SparseMatrix<double>& lower) {
  try {
    return Factor(lower);
  } catch (const NotPositive&) {
    return {lower, 0, false};
  }
}

Factor::Factor(const Eigen::SparseMatrix<double>& lower, double shift, bool positive)
    : handle_(std::make_unique<Handle>(positive)) {
  if (lower.rows() == 0) return;  // supports hold the whole plate
  auto& h = *handle_;
  const OneThread one_thread;
  Eigen::SparseMatrix<double> shifted;
  if (shift != 0) {
    shifted = lower;
    for (Eigen::Index c = 0; c < shifted.cols(); ++c) shifted.valuePtr()[shifted.outerIndexPtr()[c]] *= 1 + shift;
  }
  cholmod_sparse matrix = view(shift != 0 ? shifted : lower);
  h.common->nmethods = 1;
  h.common->method[0].ordering = CHOLMOD_NATURAL;
  h.common->postorder = false;
  h.factor = cholmod_analyze(&matrix, &h.common);
  if (!h.factor || h.common->status == CHOLMOD_OUT_OF_MEMORY) throw NumericalError("factorisation: not enough memory");
  cholmod_factorize(&matrix, h.factor, &h.common);
  if (h.common->status == CHOLMOD_OUT_OF_MEMORY) throw NumericalError("factorisation: not enough memory");
  if (h.common->status != CHOLMOD_OK) throw NotPositive("factorisation: the stiffness is not positive");
}

Factor::Factor(std::unique_ptr<const DistributedInverse> shared) : shared_(std::move(shared)) {}

Factor::~Factor() = default;
Factor::Factor(Factor&&) noexcept = default;

Eigen::MatrixXd Factor::solve(const Eigen::MatrixXd& right) const {
  if (shared_) {
    Eigen::MatrixXd result = right;
    for (auto column : result.colwise()) shared_->apply({column.data(), std::size_t(column.size())});
    return result;
  }
  auto& h = *handle_;
  if (!h.factor) return right;
  const OneThread one_thread;
  cholmod_dense b{};
  b.nrow = b.d = std::size_t(right.rows()), b.ncol = std::size_t(right.cols()), b.nzmax = b.nrow * b.ncol;
  b.x = const_cast<double*>(right.data());
  b.xtype = CHOLMOD_REAL, b.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, h.factor, &b, nullptr, &h.solution, nullptr, &h.work, &h.more_work, &h.common))
    throw NumericalError("factorisation: the solution failed");
  return Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(h.solution->x), right.rows(), right.cols());
}

std::size_t Factor::negative() const {
  if (shared_) return shared_->negative();
  if (!handle_->factor) return 0;
  const auto& factor = *handle_->factor;
  if (factor.is_super || factor.is_ll) return 0;
  const auto *first = static_cast<const int*>(factor.p), *end = first + factor.n;
  const auto* values = static_cast<const double*>(factor.x);
  return std::size_t(std::count_if(first, end, [&](int at) { return values[at] < 0; }));
}

std::size_t Factor::bytes() const {
  if (shared_ || !handle_->factor) return 0;  // the libraries of ranks do not say
  const auto& factor = *handle_->factor;
  if (!factor.is_super) return factor.nzmax * (sizeof(double) + sizeof(int));
  return factor.xsize * sizeof(double) + factor.ssize * sizeof(int);
}

namespace {

constexpr std::size_t few = 10000;  // points

/// The graph of the points with unknowns, lower triangle.
struct Graph {
  std::vector<int> first, row;

  Graph(const PointMatrix& matrix, const std::vector<int>& place) {
    for (std::size_t k = 0; k < matrix.points(); ++k) {
      if (place[k] < 0) continue;
      first.push_back(int(row.size()));
      for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b)
        if (const auto at = place[matrix.row[b]]; at >= 0) row.push_back(at);
    }
    first.push_back(int(row.size()));
  }
  cholmod_sparse view() {
    cholmod_sparse result{};
    result.nrow = result.ncol = first.size() - 1;
    result.nzmax = row.size();
    result.p = first.data(), result.i = row.data();
    result.stype = -1;
    result.itype = CHOLMOD_INT, result.xtype = CHOLMOD_PATTERN, result.dtype = CHOLMOD_DOUBLE;
    result.sorted = result.packed = 1;
    return result;
  }
};

}  // namespace

std::vector<int> elimination_order(const PointMatrix& matrix, const Forces& diagonal) {
  std::vector<int> points, place(matrix.points(), -1);
  for (std::size_t k = 0; k < matrix.points(); ++k)
    if ((diagonal.col(Eigen::Index(k)).array() > 0).any()) place[k] = int(points.size()), points.push_back(int(k));
  if (points.empty()) return points;
  Graph graph(matrix, place);
  auto view = graph.view();
  Common common;
  common->supernodal = CHOLMOD_SIMPLICIAL;  // the order is all that is asked for
  common->nmethods = 1;
  common->method[0].ordering = points.size() < few ? CHOLMOD_AMD : CHOLMOD_METIS;
  cholmod_factor* analysis = cholmod_analyze(&view, &common);
  if (!analysis) throw NumericalError("no order of elimination was found");
  std::vector<int> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.push_back(points[std::size_t(static_cast<const int*>(analysis->Perm)[i])]);
  cholmod_free_factor(&analysis, &common);
  return result;
}

namespace {

using Index = GeneralFactor::Matrix::StorageIndex;
static_assert(sizeof(Index) == sizeof(SuiteSparse_long));

std::shared_ptr<void> held(void* object, void (*release)(void**)) {
  return {object, [release](void* one) { release(&one); }};
}

}  // namespace

GeneralFactor::GeneralFactor(const Eigen::SparseMatrix<double>& A) : A_(A) {
  const OneThread one_thread;
  const Index n = A_.cols();
  double info[UMFPACK_INFO]{};
  void *symbolic = nullptr, *numeric = nullptr;
  int status =
      umfpack_dl_symbolic(n, n, A_.outerIndexPtr(), A_.innerIndexPtr(), A_.valuePtr(), &symbolic, nullptr, info);
  const auto order = held(symbolic, umfpack_dl_free_symbolic);
  if (status == UMFPACK_OK)
    status =
        umfpack_dl_numeric(A_.outerIndexPtr(), A_.innerIndexPtr(), A_.valuePtr(), symbolic, &numeric, nullptr, info);
  numeric_ = held(numeric, umfpack_dl_free_numeric);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status != UMFPACK_OK) throw NumericalError("a body that is loose, or conditions that contradict");
  bytes_ = std::size_t(info[UMFPACK_NUMERIC_SIZE] * info[UMFPACK_SIZE_OF_UNIT]);
}

Eigen::VectorXd GeneralFactor::solve(const Eigen::VectorXd& b) const {
  const OneThread one_thread;
  Eigen::VectorXd x(b.size());
  umfpack_dl_solve(UMFPACK_A, A_.outerIndexPtr(), A_.innerIndexPtr(), A_.valuePtr(), x.data(), b.data(), numeric_.get(),
                   nullptr, nullptr);
  return x;
}

}  // namespace plate
