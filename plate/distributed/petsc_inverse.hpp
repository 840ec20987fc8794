#pragma once
#include <mpi.h>

#include "plate/model/ranks/ranks.hpp"

namespace plate {

/// While it lives, PETSc is ready. After MPI_Init.
class Petsc {
public:
  Petsc();
  ~Petsc();
  Petsc(const Petsc&) = delete;
  Petsc& operator=(const Petsc&) = delete;
};

/// By MUMPS, a factor of the matrix; of more than `most_factorised` unknowns by smoothed aggregation (GAMG).
std::unique_ptr<SharedInverse> petsc_inverse(MPI_Comm all, const SharedRows& rows);

}  // namespace plate
