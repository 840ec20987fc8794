#pragma once
#include <mpi.h>

#include "plate/model/communicator.hpp"

namespace plate {

/// The processes of MPI. MPI must have been initialised for calls from one thread at a time (MPI_THREAD_FUNNELED), and
/// PETSc (Petsc).
class MpiCommunicator : public Communicator {
public:
  explicit MpiCommunicator(MPI_Comm all);

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void sum(std::span<std::int64_t> values) const override;
  void largest(std::span<double> values) const override;
  std::vector<std::string> exchanged(std::vector<std::string> texts) const override;
  std::unique_ptr<HaloExchange> halo_exchange(std::size_t points, const std::vector<Copy>& copies) const override;
  std::unique_ptr<DistributedInverse> inverse(const DistributedRows& rows) const override;
  DistributedEigenpairs largest_pairs(const DistributedProduct& product, std::span<const double> start,
                                      const EigenpairRequest& wanted) const override;

private:
  MPI_Comm all_;
  int rank_ = 0, size_ = 1;
};

}  // namespace plate
