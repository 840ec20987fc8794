#include <slepceps.h>

#include <algorithm>
#include <exception>

#include "plate/distributed/petsc_inverse.hpp"

namespace plate {
namespace {

/// The product as PETSc calls it; what it throws waits until PETSc has returned.
struct Called {
  const DistributedProduct& product;
  std::size_t size;
  std::exception_ptr thrown = nullptr;
};

PetscErrorCode multiply(Mat matrix, Vec from, Vec to) {
  Called* called = nullptr;
  if (const auto code = MatShellGetContext(matrix, &called)) return code;
  const double* x = nullptr;
  double* y = nullptr;
  if (const auto code = VecGetArrayRead(from, &x)) return code;
  if (const auto code = VecGetArrayWrite(to, &y)) return code;
  try {
    called->product({x, called->size}, {y, called->size});
  } catch (...) {
    called->thrown = std::current_exception();
  }
  if (const auto code = VecRestoreArrayRead(from, &x)) return code;
  if (const auto code = VecRestoreArrayWrite(to, &y)) return code;
  return called->thrown ? PETSC_ERR_USER : 0;
}

class Pairs {
public:
  Pairs(MPI_Comm all, Called& called) {
    const auto size = PetscInt(called.size);
    require(MatCreateShell(all, size, size, PETSC_DETERMINE, PETSC_DETERMINE, &called, &matrix_));
    require(MatShellSetOperation(matrix_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    require(MatCreateVecs(matrix_, &vector_, nullptr));
    require(EPSCreate(all, &solver_));
    require(EPSSetOperators(solver_, matrix_, nullptr));
    require(EPSSetProblemType(solver_, EPS_HEP));
    require(EPSSetType(solver_, EPSKRYLOVSCHUR));
    require(EPSSetWhichEigenpairs(solver_, EPS_LARGEST_REAL));
    require(EPSSetConvergenceTest(solver_, EPS_CONV_REL));
  }
  ~Pairs() { EPSDestroy(&solver_), VecDestroy(&vector_), MatDestroy(&matrix_); }
  Pairs(const Pairs&) = delete;
  Pairs& operator=(const Pairs&) = delete;

  void find(std::span<const double> start, const EigenpairRequest& wanted) {
    double* entries = nullptr;
    require(VecGetArrayWrite(vector_, &entries));
    std::ranges::copy(start, entries);
    require(VecRestoreArrayWrite(vector_, &entries));
    require(EPSSetInitialSpace(solver_, 1, &vector_));
    require(EPSSetDimensions(solver_, PetscInt(wanted.count), PetscInt(wanted.basis), PETSC_DEFAULT));
    require(EPSSetTolerances(solver_, wanted.tolerance, PetscInt(wanted.most_restarts)));
    require(EPSSolve(solver_));
  }

  DistributedEigenpairs found(const EigenpairRequest& wanted, std::size_t size) const {
    PetscInt count = 0;
    require(EPSGetConverged(solver_, &count));
    DistributedEigenpairs result;
    for (PetscInt i = 0; i < std::min(count, PetscInt(wanted.count)); ++i) {
      require(EPSGetEigenpair(solver_, i, &result.values.emplace_back(), nullptr, vector_, nullptr));
      const double* entries = nullptr;
      require(VecGetArrayRead(vector_, &entries));
      result.vectors.emplace_back(entries, entries + size);
      require(VecRestoreArrayRead(vector_, &entries));
    }
    return result;
  }

private:
  Mat matrix_ = nullptr;
  Vec vector_ = nullptr;
  EPS solver_ = nullptr;
};

}  // namespace

DistributedEigenpairs slepc_eigenpairs(MPI_Comm all, const DistributedProduct& product, std::span<const double> start,
                                       const EigenpairRequest& wanted) {
  Called called{product, start.size()};
  try {
    Pairs pairs(all, called);
    pairs.find(start, wanted);
    return pairs.found(wanted, start.size());
  } catch (const std::runtime_error&) {
    if (called.thrown) std::rethrow_exception(called.thrown);
    throw;
  }
}

}  // namespace plate
