#include "plate/solve/matrices/general_factor.hpp"

#include <suitesparse/umfpack.h>
#include <new>

#include "plate/model/numerical_error.hpp"
#include "plate/solve/matrices/one_thread.hpp"

namespace plate {

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
