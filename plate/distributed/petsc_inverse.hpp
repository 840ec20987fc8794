#pragma once
#include <mpi.h>

#include "plate/model/communicator.hpp"

namespace plate {

/// While it lives, PETSc and SLEPc are ready. After MPI_Init.
class Petsc {
public:
  Petsc();
  ~Petsc();
  Petsc(const Petsc&) = delete;
  Petsc& operator=(const Petsc&) = delete;
};

/// @throws std::runtime_error  what PETSc or SLEPc say where the code that they return is not 0
void require(int code);

/// By MUMPS, a factor of the matrix; of more than `most_factorised` unknowns by smoothed aggregation (GAMG).
std::unique_ptr<DistributedInverse> petsc_inverse(MPI_Comm all, const DistributedRows& rows);

}  // namespace plate
