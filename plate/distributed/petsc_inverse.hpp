#pragma once
#include <mpi.h>

#include "plate/model/communicator.hpp"

namespace plate {

/// Initialises PETSc and SLEPc for as long as it lives. Requires MPI_Init.
class Petsc {
public:
  Petsc();
  ~Petsc();
  Petsc(const Petsc&) = delete;
  Petsc& operator=(const Petsc&) = delete;
};

/// @throws std::runtime_error  what PETSc or SLEPc say where the code that they return is not 0
void require(int code);

/// Inverse by a factor of MUMPS; of more than `most_factorised` unknowns by smoothed aggregation (GAMG).
std::unique_ptr<DistributedInverse> petsc_inverse(MPI_Comm all, const DistributedRows& rows);

/// Eigenpairs by Krylov-Schur (SLEPc).
DistributedEigenpairs slepc_eigenpairs(MPI_Comm all, const DistributedProduct& product, std::span<const double> start,
                                       const EigenpairRequest& wanted);

}  // namespace plate
