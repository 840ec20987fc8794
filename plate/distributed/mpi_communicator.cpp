#include "plate/distributed/mpi_communicator.hpp"

#include <map>
#include <numeric>
#include <stdexcept>

#include "plate/distributed/petsc_inverse.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/halo_exchange.hpp"

namespace plate {
namespace {

std::vector<int> sizes_of(const std::vector<std::string>& texts) {
  std::vector<int> sizes;
  for (const auto& text : texts) sizes.push_back(int(text.size()));
  return sizes;
}

/// Offsets at which the pieces begin.
std::vector<int> begins_of(const std::vector<int>& sizes) {
  std::vector<int> begins(sizes.size(), 0);
  std::partial_sum(sizes.begin(), sizes.end() - (sizes.empty() ? 0 : 1), begins.begin() + (sizes.empty() ? 0 : 1));
  return begins;
}

template <typename Real>
MPI_Datatype type_of() {
  return std::is_same_v<Real, float> ? MPI_FLOAT : MPI_DOUBLE;
}

/// Points that go to neighbours, or come from them, neighbour by neighbour.
struct Route {
  std::vector<int> neighbours, counts;
  std::vector<std::uint32_t> points;

  void add(int neighbour, const std::vector<std::uint32_t>& these) {
    if (these.empty()) return;
    neighbours.push_back(neighbour), counts.push_back(int(these.size()));
    points.insert(points.end(), these.begin(), these.end());
  }
};

/// Buffer for one direction of one halo exchange: the values of all points of a route, and the offset at which those of
/// each neighbour begin.
struct Shipment {
  std::vector<int> counts, begins;
  std::vector<std::byte> values;

  Shipment(const Route& route, std::size_t components, std::size_t size) : counts(route.counts) {
    for (int& count : counts) count *= int(components);
    begins = begins_of(counts);
    values.resize(route.points.size() * components * size);
  }
  template <typename Real>
  Real* as() {
    return reinterpret_cast<Real*>(values.data());
  }
};

/// Neighbourhood collectives on the graph of ranks and the ghosts that they have of each other. Of every kind of values
/// that it ever fetched it keeps what they are sent from and received in.
class MpiHaloExchange : public HaloExchange {
public:
  MpiHaloExchange(MPI_Comm all, std::size_t points, Route out, Route in)
      : points_(points), out_(std::move(out)), in_(std::move(in)) {
    MPI_Dist_graph_create_adjacent(all, int(in_.neighbours.size()), in_.neighbours.data(), MPI_UNWEIGHTED,
                                   int(out_.neighbours.size()), out_.neighbours.data(), MPI_UNWEIGHTED, MPI_INFO_NULL,
                                   0, &graph_);
  }
  ~MpiHaloExchange() override {
    int over = 0;
    MPI_Finalized(&over);
    if (!over) MPI_Comm_free(&graph_);
  }
  MpiHaloExchange(const MpiHaloExchange&) = delete;
  MpiHaloExchange& operator=(const MpiHaloExchange&) = delete;

  void start(std::span<double> values) const override { start_with(values, double_); }
  void start(std::span<float> values) const override { start_with(values, single_); }

  void finish() const override {
    MPI_Wait(&request_, MPI_STATUS_IGNORE);
    put(double_), put(single_);
  }

  void progress() const override {
    int done = 0;  // then the request is none, of which MPI_Wait says so at once
    MPI_Test(&request_, &done, MPI_STATUS_IGNORE);
  }

private:
  /// State of the exchanges of one value type: the target of the exchange in progress, and the buffers used so far, by
  /// the number of components.
  template <typename Real>
  struct OfKind {
    std::span<Real> target;                                          // none: nothing is on its way
    std::map<std::size_t, std::pair<Shipment, Shipment>> shipments;  // out, in
  };

  template <typename Real>
  void start_with(std::span<Real> values, OfKind<Real>& kind) const {
    if (!double_.target.empty() || !single_.target.empty()) throw std::logic_error("an exchange began within another");
    kind.target = values;
    const std::size_t components = values.size() / points_;
    auto kept = kind.shipments.find(components);
    if (kept == kind.shipments.end())
      kept = kind.shipments
                 .try_emplace(components, Shipment(out_, components, sizeof(Real)),
                              Shipment(in_, components, sizeof(Real)))
                 .first;
    auto& [out, in] = kept->second;
    Real* to = out.template as<Real>();
    for (const auto k : out_.points)
      for (std::size_t c = 0; c < components; ++c) *to++ = values[c * points_ + k];
    MPI_Ineighbor_alltoallv(out.values.data(), out.counts.data(), out.begins.data(), type_of<Real>(), in.values.data(),
                            in.counts.data(), in.begins.data(), type_of<Real>(), graph_, &request_);
  }

  template <typename Real>
  void put(OfKind<Real>& kind) const {
    if (kind.target.empty()) return;
    const std::size_t components = kind.target.size() / points_;
    const Real* from = kind.shipments.at(components).second.template as<Real>();
    for (const auto k : in_.points)
      for (std::size_t c = 0; c < components; ++c) kind.target[c * points_ + k] = *from++;
    kind.target = {};
  }

  std::size_t points_;
  Route out_, in_;
  MPI_Comm graph_ = MPI_COMM_NULL;
  mutable MPI_Request request_ = MPI_REQUEST_NULL;
  mutable OfKind<double> double_;
  mutable OfKind<float> single_;
};

}  // namespace

MpiCommunicator::MpiCommunicator(MPI_Comm all) : all_(all) {
  MPI_Comm_rank(all, &rank_);
  MPI_Comm_size(all, &size_);
}

void MpiCommunicator::sum(std::span<std::int64_t> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_INT64_T, MPI_SUM, all_);
}

void MpiCommunicator::largest(std::span<double> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, MPI_MAX, all_);
}

std::vector<std::string> MpiCommunicator::exchanged(std::vector<std::string> texts) const {
  const auto out = sizes_of(texts);
  std::vector<int> in(texts.size());
  MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, all_);
  std::string sent;
  for (const auto& text : texts) sent += text;
  std::string received(std::size_t(std::accumulate(in.begin(), in.end(), 0)), '\0');
  const auto out_begins = begins_of(out), in_begins = begins_of(in);
  MPI_Alltoallv(sent.data(), out.data(), out_begins.data(), MPI_BYTE, received.data(), in.data(), in_begins.data(),
                MPI_BYTE, all_);
  std::vector<std::string> result;
  for (std::size_t from = 0; from < in.size(); ++from)
    result.push_back(received.substr(std::size_t(in_begins[from]), std::size_t(in[from])));
  return result;
}

std::unique_ptr<HaloExchange> MpiCommunicator::halo_exchange(std::size_t points,
                                                             const std::vector<Copy>& copies) const {
  const auto processes = std::size_t(size_);
  std::vector<std::vector<std::uint32_t>> here(processes), there(processes);
  for (const auto& copy : copies) {
    here[std::size_t(copy.owner)].push_back(copy.point);
    there[std::size_t(copy.owner)].push_back(copy.of_owner);
  }
  std::vector<std::string> asked;
  for (const auto& points_there : there) asked.push_back(text_of(points_there));
  const auto wanted = exchanged(std::move(asked));
  Route out, in;
  for (int other = 0; other < size_; ++other) {
    out.add(other, values_of<std::uint32_t>(wanted[std::size_t(other)]));
    in.add(other, here[std::size_t(other)]);
  }
  return std::make_unique<MpiHaloExchange>(all_, points, std::move(out), std::move(in));
}

std::unique_ptr<DistributedInverse> MpiCommunicator::inverse(const DistributedRows& rows) const {
  return petsc_inverse(all_, rows);
}

DistributedEigenpairs MpiCommunicator::largest_pairs(const DistributedProduct& product, std::span<const double> start,
                                                     const EigenpairRequest& wanted) const {
  return slepc_eigenpairs(all_, product, start, wanted);
}

}  // namespace plate
