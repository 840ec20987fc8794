#include "plate/factor.hpp"

#include <omp.h>
#include <suitesparse/cholmod.h>

#include <stdexcept>

#include "plate/numerical_error.hpp"

namespace plate {
namespace {

class Common {
public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.quick_return_if_not_posdef = true;
  }
  ~Common() { cholmod_finish(&common_); }
  Common(const Common&) = delete;
  cholmod_common* operator&() { return &common_; }
  cholmod_common* operator->() { return &common_; }

private:
  cholmod_common common_;
};

/// The products of a sparse factorisation are too small to share out: two threads took 1.4 to 3.3 times as long as one
/// (Dai 4.1, 250,000 points). Holds for OpenBLAS built with OpenMP.
class OneThread {
public:
  OneThread() : before_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;

private:
  int before_;
};

/// A view of the matrix; nothing is copied.
cholmod_sparse view(const Eigen::SparseMatrix<double>& lower, int xtype) {
  cholmod_sparse result{};
  result.nrow = result.ncol = std::size_t(lower.rows());
  result.nzmax = std::size_t(lower.nonZeros());
  result.p = const_cast<int*>(lower.outerIndexPtr());
  result.i = const_cast<int*>(lower.innerIndexPtr());
  result.x = xtype == CHOLMOD_PATTERN ? nullptr : const_cast<double*>(lower.valuePtr());
  result.stype = -1;
  result.itype = CHOLMOD_INT, result.xtype = xtype, result.dtype = CHOLMOD_DOUBLE;
  result.sorted = result.packed = 1;
  return result;
}

}  // namespace

struct Factor::Handle {
  Common common;
  cholmod_factor* factor = nullptr;
  cholmod_dense *solution = nullptr, *work = nullptr, *more_work = nullptr;

  ~Handle() {
    for (auto** dense : {&solution, &work, &more_work}) cholmod_free_dense(dense, &common);
    cholmod_free_factor(&factor, &common);
  }
};

Factor::Factor(const Eigen::SparseMatrix<double>& lower, std::vector<int> order, double shift)
    : handle_(std::make_unique<Handle>()) {
  auto& h = *handle_;
  const OneThread one_thread;
  Eigen::SparseMatrix<double> shifted;
  if (shift != 0) {
    shifted = lower;
    for (Eigen::Index c = 0; c < shifted.cols(); ++c) shifted.valuePtr()[shifted.outerIndexPtr()[c]] *= 1 + shift;
  }
  cholmod_sparse matrix = view(shift != 0 ? shifted : lower, CHOLMOD_REAL);
  if (!order.empty()) {
    h.common->nmethods = 1;
    h.common->method[0].ordering = CHOLMOD_GIVEN;
  }
  h.factor = order.empty() ? cholmod_analyze(&matrix, &h.common)
                           : cholmod_analyze_p(&matrix, order.data(), nullptr, 0, &h.common);
  if (!h.factor || h.common->status == CHOLMOD_OUT_OF_MEMORY) throw NumericalError("factorisation: not enough memory");
  cholmod_factorize(&matrix, h.factor, &h.common);
  if (h.common->status == CHOLMOD_OUT_OF_MEMORY) throw NumericalError("factorisation: not enough memory");
  if (h.common->status != CHOLMOD_OK) throw NumericalError("factorisation: the stiffness is not positive");
}

Factor::~Factor() = default;
Factor::Factor(Factor&&) noexcept = default;

Eigen::MatrixXd Factor::solve(const Eigen::MatrixXd& right) const {
  auto& h = *handle_;
  const OneThread one_thread;
  cholmod_dense b{};
  b.nrow = b.d = std::size_t(right.rows()), b.ncol = std::size_t(right.cols()), b.nzmax = b.nrow * b.ncol;
  b.x = const_cast<double*>(right.data());
  b.xtype = CHOLMOD_REAL, b.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, h.factor, &b, nullptr, &h.solution, nullptr, &h.work, &h.more_work, &h.common))
    throw NumericalError("factorisation: the solution failed");
  return Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(h.solution->x), right.rows(), right.cols());
}

std::size_t Factor::bytes() const {
  return handle_->factor->xsize * sizeof(double) + handle_->factor->ssize * sizeof(int);
}

std::vector<int> nested_dissection(const Eigen::SparseMatrix<double>& lower) {
  Common common;
  cholmod_sparse graph = view(lower, CHOLMOD_PATTERN);
  std::vector<int> result(std::size_t(lower.rows()));
  if (!cholmod_metis(&graph, nullptr, 0, true, result.data(), &common))
    throw NumericalError("nested dissection failed");
  return result;
}

}  // namespace plate
