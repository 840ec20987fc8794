#include "plate/solve/matrices/factor.hpp"

#include <stdexcept>

#include "plate/model/numerical_error.hpp"
#include "plate/solve/matrices/cholmod.hpp"
#include "plate/solve/matrices/one_thread.hpp"

namespace plate {
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

  Handle() {
    common->supernodal = CHOLMOD_SUPERNODAL;
    common->quick_return_if_not_posdef = true;
  }
  ~Handle() {
    for (auto** dense : {&solution, &work, &more_work}) cholmod_free_dense(dense, &common);
    cholmod_free_factor(&factor, &common);
  }
};

Factor::Factor(const Eigen::SparseMatrix<double>& lower, double shift) : handle_(std::make_unique<Handle>()) {
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

}  // namespace plate
