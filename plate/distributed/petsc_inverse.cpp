#include "plate/distributed/petsc_inverse.hpp"

#include <petscksp.h>
#include <slepcsys.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "plate/model/space.hpp"

namespace plate {
namespace {

constexpr PetscInt most_factorised = 3000000;

class PetscInverse : public DistributedInverse {
public:
  PetscInverse(MPI_Comm all, const DistributedRows& rows)
      : unknowns_(PetscInt(unknowns_per_point * (rows.first.size() - 1))) {
    assemble(all, rows);
    PetscInt size = 0;
    require(MatGetSize(matrix_, &size, nullptr));
    if (size <= most_factorised) {
      factorise(all);
    } else {
      near_null_space(all, rows);
      set_up(all, [](PC inverse) { require(PCSetType(inverse, PCGAMG)); });
    }
    require(MatCreateVecs(matrix_, &right_, &solution_));
  }
  ~PetscInverse() override {
    PetscBool over = PETSC_FALSE;
    if (PetscFinalized(&over); over) return;
    VecDestroy(&right_), VecDestroy(&solution_), KSPDestroy(&solver_), MatDestroy(&matrix_);
  }
  PetscInverse(const PetscInverse&) = delete;
  PetscInverse& operator=(const PetscInverse&) = delete;

  std::size_t negative() const override { return std::size_t(negative_pivots_); }

  void apply(std::span<double> values) const override {
    double* entries = nullptr;
    require(VecGetArrayWrite(right_, &entries));
    for (std::size_t i = 0; i < values.size(); ++i) entries[i] = without_stiffness_[i] ? 0 : values[i];
    require(VecRestoreArrayWrite(right_, &entries));
    require(KSPSolve(solver_, right_, solution_));
    const double* found = nullptr;
    require(VecGetArrayRead(solution_, &found));
    std::copy_n(found, values.size(), values.begin());
    require(VecRestoreArrayRead(solution_, &found));
  }

private:
  void assemble(MPI_Comm all, const DistributedRows& rows) {
    require(MatCreate(all, &matrix_));
    require(MatSetSizes(matrix_, unknowns_, unknowns_, PETSC_DETERMINE, PETSC_DETERMINE));
    require(MatSetBlockSize(matrix_, unknowns_per_point));
    require(MatSetType(matrix_, MATAIJ));
    const PetscInt own = unknowns_ / unknowns_per_point;
    PetscInt begin = 0;
    MPI_Exscan(&own, &begin, 1, MPIU_INT, MPI_SUM, all);
    std::vector<PetscInt> here, there;  // blocks of every row, by whose the columns are
    for (std::size_t k = 0; k < std::size_t(own); ++k) {
      here.push_back(1), there.push_back(0);
      for (auto b = rows.first[k]; b < rows.first[k + 1]; ++b) {
        const bool mine = rows.column[b] >= begin && rows.column[b] < begin + own;
        (mine ? here : there).back() += rows.column[b] != begin + PetscInt(k);
      }
    }
    require(MatXAIJSetPreallocation(matrix_, unknowns_per_point, here.data(), there.data(), nullptr, nullptr));
    without_stiffness_.assign(std::size_t(unknowns_), true);
    for (std::size_t k = 0; k < std::size_t(own); ++k) {
      const PetscInt row = begin + PetscInt(k);
      for (auto b = rows.first[k]; b < rows.first[k + 1]; ++b) {
        const auto column = PetscInt(rows.column[b]);
        const double* block = &rows.block[entries_per_block * b];
        require(MatSetValuesBlocked(matrix_, 1, &row, 1, &column, block, ADD_VALUES));
        for (std::size_t c = 0; column == row && c < unknowns_per_point; ++c)
          if (block[(unknowns_per_point + 1) * c] != 0) without_stiffness_[index_by_points(k, c)] = false;
      }
      std::array<double, 9> rest{};
      for (std::size_t c = 0; c < unknowns_per_point; ++c)
        rest[(unknowns_per_point + 1) * c] = without_stiffness_[index_by_points(k, c)] ? 1 : 0;
      require(MatSetValuesBlocked(matrix_, 1, &row, 1, &row, rest.data(), ADD_VALUES));
    }
    require(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    require(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
    require(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
  }

  /// False where it did not succeed.
  template <typename Choose>
  bool set_up(MPI_Comm all, const Choose& choose) {
    KSPDestroy(&solver_);
    require(KSPCreate(all, &solver_));
    require(KSPSetOperators(solver_, matrix_, matrix_));
    require(KSPSetType(solver_, KSPPREONLY));
    PC inverse;
    require(KSPGetPC(solver_, &inverse));
    choose(inverse);
    require(KSPSetUp(solver_));
    PCFailedReason failed = PC_NOERROR;
    require(PCGetFailedReason(inverse, &failed));
    return failed == PC_NOERROR;
  }

  /// MUMPS estimates the memory that a process needs, and some more is given: what it lacks it asks for by failing. It
  /// also fails where the last front of many processes is not positive: then one process takes that.
  void factorise(MPI_Comm all) {
    constexpr PetscInt last_front = 13, more = 14;     // ICNTL: 1: by one process; percent above the estimate
    constexpr PetscInt error = 1, not_positive = -40;  // INFOG(1)
    constexpr PetscInt negative = 12;                  // INFOG(12): negative pivots, but those of a shared last front
    PetscInt percent = 50, by_one = 0;
    for (;;) {
      Mat factor = nullptr;
      const bool found = set_up(all, [&](PC inverse) {
        require(PCSetType(inverse, PCCHOLESKY));
        require(PCFactorSetMatSolverType(inverse, MATSOLVERMUMPS));
        require(PCFactorSetUpMatSolverType(inverse));
        require(PCFactorGetMatrix(inverse, &factor));
        require(MatMumpsSetIcntl(factor, more, percent));
        require(MatMumpsSetIcntl(factor, last_front, by_one));
      });
      PetscInt code = 0;
      require(MatMumpsGetInfog(factor, error, &code));
      require(MatMumpsGetInfog(factor, negative, &negative_pivots_));
      if (found) return;
      if (code == not_positive && by_one == 0)
        by_one = 1;
      else if (percent < 1000)
        percent = percent == 50 ? 200 : 1000;
      else
        throw std::runtime_error("MUMPS finds no factor of the stiffness");
    }
  }

  /// The rigid motions: w = 1; w = x, theta_y = -1; w = y, theta_x = 1, orthogonal and of length 1.
  void near_null_space(MPI_Comm all, const DistributedRows& rows) {
    Vec motions[3];
    for (int motion = 0; motion < 3; ++motion) {
      require(MatCreateVecs(matrix_, &motions[motion], nullptr));
      double* entries = nullptr;
      require(VecGetArrayWrite(motions[motion], &entries));
      for (std::size_t k = 0; unknowns_per_point * k < std::size_t(unknowns_); ++k) {
        const double x = rows.position[2 * k], y = rows.position[2 * k + 1];
        const double of_point[3][unknowns_per_point] = {{1, 0, 0}, {x, 0, -1}, {y, 1, 0}};
        for (std::size_t c = 0; c < unknowns_per_point; ++c)
          entries[index_by_points(k, c)] = without_stiffness_[index_by_points(k, c)] ? 0 : of_point[motion][c];
      }
      require(VecRestoreArrayWrite(motions[motion], &entries));
      for (int before = 0; before < motion; ++before) {
        double along = 0;
        require(VecDot(motions[motion], motions[before], &along));
        require(VecAXPY(motions[motion], -along, motions[before]));
      }
      require(VecNormalize(motions[motion], nullptr));
    }
    MatNullSpace space;
    require(MatNullSpaceCreate(all, PETSC_FALSE, 3, motions, &space));
    require(MatSetNearNullSpace(matrix_, space));
    require(MatNullSpaceDestroy(&space));
    for (auto& motion : motions) require(VecDestroy(&motion));
  }

  PetscInt unknowns_, negative_pivots_ = 0;
  std::vector<char> without_stiffness_;
  Mat matrix_ = nullptr;
  KSP solver_ = nullptr;
  Vec right_ = nullptr, solution_ = nullptr;
};

}  // namespace

Petsc::Petsc() {
  require(PetscOptionsSetValue(nullptr, "-skip_petscrc", nullptr));
  require(SlepcInitializeNoArguments());
  require(PetscPopSignalHandler());
  require(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

Petsc::~Petsc() {
  SlepcFinalize();
}

void require(int code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error("PETSc: " + std::string(text ? text : "unknown error"));
}

std::unique_ptr<DistributedInverse> petsc_inverse(MPI_Comm all, const DistributedRows& rows) {
  return std::make_unique<PetscInverse>(all, rows);
}

}  // namespace plate
