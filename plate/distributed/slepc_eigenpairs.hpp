#pragma once
#include <mpi.h>

#include "plate/model/communicator.hpp"

namespace plate {

/// Eigenpairs by Krylov-Schur (SLEPc).
DistributedEigenpairs slepc_eigenpairs(MPI_Comm all, const DistributedProduct& product, std::span<const double> start,
                                       const EigenpairRequest& wanted);

}  // namespace plate
