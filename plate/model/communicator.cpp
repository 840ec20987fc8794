#include "plate/model/communicator.hpp"

#include <stdexcept>

#include "plate/model/halo_exchange.hpp"
#include "plate/model/point_map.hpp"

namespace plate {
namespace {

[[noreturn]] void refuse_parts() {
  throw std::logic_error("a single process has no parts of a matrix");
}

class SingleProcess : public Communicator {
public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  bool distributed() const override { return false; }
  void sum(std::span<std::int64_t>) const override {}
  void largest(std::span<double>) const override {}
  std::vector<std::string> exchanged(std::vector<std::string> texts) const override { return texts; }
  std::unique_ptr<HaloExchange> halo_exchange(std::size_t, const std::vector<Copy>&) const override { return nullptr; }
  std::unique_ptr<DistributedInverse> inverse(const DistributedRows&) const override { refuse_parts(); }
  DistributedEigenpairs largest_pairs(const DistributedProduct&, std::span<const double>,
                                      const EigenpairRequest&) const override {
    refuse_parts();
  }
};

}  // namespace

const Communicator& single_process() {
  static const SingleProcess process;
  return process;
}

int PointMap::rank() const {
  return communicator->rank();
}

bool PointMap::distributed() const {
  return communicator->distributed();
}

}  // namespace plate
