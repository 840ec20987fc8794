#pragma once
#include <mpi.h>

#include "plate/model/communicator.hpp"

namespace plate {

/// By Krylov-Schur (SLEPc).
SharedPairs slepc_pairs(MPI_Comm all, const SharedProduct& product, std::span<const double> start,
                        const PairsWanted& wanted);

}  // namespace plate
