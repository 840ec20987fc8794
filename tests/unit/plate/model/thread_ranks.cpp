#include "tests/unit/plate/model/thread_ranks.hpp"

#include <omp.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <barrier>
#include <exception>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "plate/model/communicator.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/reduction.hpp"
#include "tests/unit/plate/model/thread_mail.hpp"

namespace thread_ranks {
namespace {

/// What all threads see. Between two meetings everyone writes to a place of its own, or everyone reads.
struct Common {
  explicit Common(int count)
      : meeting(count), whole(std::size_t(count)), real(std::size_t(count)), texts(std::size_t(count)) {}
  std::barrier<> meeting;
  std::vector<std::span<std::int64_t>> whole;
  std::vector<std::span<double>> real;
  std::vector<std::vector<std::string>> texts;  // of every sender, to every receiver
  Post post;
  std::shared_ptr<Mail> mail;  // of the latest exchange
};

class ThreadHaloExchange : public plate::HaloExchange {
public:
  ThreadHaloExchange(std::shared_ptr<Mail> mail, int rank, std::size_t points, std::vector<plate::Copy> copies)
      : mail_(std::move(mail)), rank_(std::size_t(rank)), points_(points), copies_(std::move(copies)) {}

  void start(std::span<double> values) const override { doubles_ = begun(values); }
  void start(std::span<float> values) const override { floats_ = begun(values); }
  void finish() const override {
    take(doubles_), take(floats_);
    doubles_ = {}, floats_ = {};
  }

private:
  template <typename Real>
  std::span<Real> begun(std::span<Real> values) const {
    if (!doubles_.empty() || !floats_.empty()) throw std::logic_error("an exchange began within another");
    mail_->put(rank_, values);
    for (const auto& copy : copies_)  // whoever reads them now finds no numbers
      for (std::size_t at = copy.point; at < values.size(); at += points_)
        values[at] = std::numeric_limits<Real>::quiet_NaN();
    return values;
  }

  template <typename Real>
  void take(std::span<Real> values) const {
    if (values.empty()) return;
    const std::size_t components = values.size() / points_;
    mail_->take<Real>(rank_, [&](const std::vector<std::vector<Real>>& all) {
      for (const auto& copy : copies_)
        for (std::size_t c = 0; c < components; ++c) {
          const auto& from = all[std::size_t(copy.owner)];
          values[c * points_ + copy.point] = from[c * (from.size() / components) + copy.of_owner];
        }
    });
  }

  std::shared_ptr<Mail> mail_;
  std::size_t rank_, points_;
  std::vector<plate::Copy> copies_;
  mutable std::span<double> doubles_;  // that wait for theirs
  mutable std::span<float> floats_;
};

/// Every thread has the factor of the whole matrix.
class ThreadInverse : public plate::DistributedInverse {
public:
  ThreadInverse(const plate::Communicator& all, const plate::DistributedRows& rows) : all_(all) {
    const auto own = std::int64_t(rows.first.size()) - 1;
    const auto counts = plate::gathered(all, std::vector<std::int64_t>{own});
    begin_ = 3 * std::accumulate(counts.begin(), counts.begin() + all.rank(), std::int64_t(0));
    struct Entry {
      std::int64_t row, column;
      double value;
    };
    std::vector<Entry> entries;
    for (std::int64_t k = 0; k < own; ++k)
      for (auto b = rows.first[std::size_t(k)]; b < rows.first[std::size_t(k) + 1]; ++b)
        for (std::int64_t i = 0; i < 9; ++i)
          if (const double value = rows.block[9 * b + std::size_t(i)]; value != 0)
            entries.push_back({begin_ + 3 * k + i / 3, 3 * rows.column[b] + i % 3, value});
    const auto size = 3 * std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
    Eigen::SparseMatrix<double> matrix(size, size);
    std::vector<Eigen::Triplet<double>> triplets;
    without_stiffness_.setConstant(size, true);
    for (const auto& e : plate::gathered(all, entries)) {
      triplets.emplace_back(int(e.row), int(e.column), e.value);
      if (e.row == e.column) without_stiffness_[e.row] = false;
    }
    for (int i = 0; i < size; ++i)
      if (without_stiffness_[i]) triplets.emplace_back(i, i, 1);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    const Eigen::SparseMatrix<double> skew = matrix - Eigen::SparseMatrix<double>(matrix.transpose());
    if (!(skew.norm() < 1e-12 * matrix.norm())) throw std::logic_error("the rows are not those of a symmetric matrix");
    factor_.compute(matrix);
  }

  std::size_t negative() const override { return std::size_t((factor_.vectorD().array() < 0).count()); }

  void apply(std::span<double> values) const override {
    auto right = plate::gathered(all_, std::vector<double>(values.begin(), values.end()));
    Eigen::Map<Eigen::VectorXd> map(right.data(), Eigen::Index(right.size()));
    map = without_stiffness_.select(0, map).eval();
    map = factor_.solve(map).eval();
    std::copy_n(right.begin() + begin_, values.size(), values.begin());
  }

private:
  const plate::Communicator& all_;
  std::int64_t begin_ = 0;
  Eigen::Array<bool, Eigen::Dynamic, 1> without_stiffness_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

/// Every thread goes through the same Krylov space, whole, orthogonal and without a restart.
class ThreadPairs {
public:
  ThreadPairs(const plate::Communicator& all, const plate::DistributedProduct& product, std::size_t own)
      : all_(all), product_(product), own_(own) {
    const auto counts = plate::gathered(all, std::vector<std::int64_t>{std::int64_t(own)});
    begin_ = std::accumulate(counts.begin(), counts.begin() + all.rank(), std::int64_t(0));
  }

  plate::DistributedEigenpairs find(std::span<const double> start, const plate::EigenpairRequest& wanted) const {
    constexpr Eigen::Index most = 200;
    Eigen::VectorXd next = whole(start);
    Eigen::MatrixXd basis(next.size(), 0), projected = Eigen::MatrixXd::Zero(most, most);
    for (Eigen::Index n = 0; n < most; ++n) {
      for (int twice = 0; twice < 2; ++twice) next -= basis * (basis.transpose() * next).eval();
      basis.conservativeResize(Eigen::NoChange, n + 1);
      basis.col(n) = next.normalized();
      std::vector<double> image(own_);
      product_({basis.col(n).data() + begin_, own_}, image);
      next = whole(image);
      projected.row(n).head(n + 1) = next.transpose() * basis;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(projected.topLeftCorner(n + 1, n + 1),
                                                                Eigen::ComputeEigenvectors);
      const double left = (next - basis * (basis.transpose() * next)).norm();
      if (found(ritz, left, wanted)) return pairs(basis, ritz, wanted);
    }
    return {};
  }

private:
  using Ritz = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

  Eigen::VectorXd whole(std::span<const double> own) const {
    const auto all = plate::gathered(all_, std::vector<double>(own.begin(), own.end()));
    return Eigen::Map<const Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
  }

  static bool found(const Ritz& ritz, double left, const plate::EigenpairRequest& wanted) {
    const auto size = ritz.eigenvalues().size(), count = Eigen::Index(wanted.count);
    if (size < count) return false;
    const double residual = left * ritz.eigenvectors().bottomRightCorner(1, count).cwiseAbs().maxCoeff();
    return residual <= wanted.tolerance * ritz.eigenvalues()[size - count];
  }

  plate::DistributedEigenpairs pairs(const Eigen::MatrixXd& basis, const Ritz& ritz,
                                     const plate::EigenpairRequest& wanted) const {
    plate::DistributedEigenpairs result;
    for (std::size_t i = 1; i <= wanted.count; ++i) {
      const auto column = ritz.eigenvalues().size() - Eigen::Index(i);
      result.values.push_back(ritz.eigenvalues()[column]);
      const Eigen::VectorXd own = basis.middleRows(begin_, Eigen::Index(own_)) * ritz.eigenvectors().col(column);
      result.vectors.emplace_back(own.begin(), own.end());
    }
    return result;
  }

  const plate::Communicator& all_;
  const plate::DistributedProduct& product_;
  std::size_t own_;
  std::int64_t begin_ = 0;
};

class ThreadCommunicator : public plate::Communicator {
public:
  ThreadCommunicator(Common& common, int rank) : common_(common), rank_(rank) {}

  int rank() const override { return rank_; }
  int size() const override { return int(common_.texts.size()); }
  void sum(std::span<std::int64_t> values) const override {
    together(common_.whole, values, [](std::int64_t a, std::int64_t b) { return a + b; });
  }
  void largest(std::span<double> values) const override {
    together(common_.real, values, [](double a, double b) { return std::max(a, b); });
  }
  std::vector<std::string> exchanged(std::vector<std::string> texts) const override {
    common_.texts[std::size_t(rank_)] = std::move(texts);
    common_.meeting.arrive_and_wait();
    std::vector<std::string> result;
    for (const auto& from : common_.texts) result.push_back(from[std::size_t(rank_)]);
    common_.meeting.arrive_and_wait();
    return result;
  }
  std::unique_ptr<plate::HaloExchange> halo_exchange(std::size_t points,
                                                     const std::vector<plate::Copy>& copies) const override {
    common_.meeting.arrive_and_wait();
    if (rank_ == 0) common_.mail = std::make_shared<Mail>(common_.post, std::size_t(size()));
    common_.meeting.arrive_and_wait();
    if (!common_.mail) throw std::runtime_error("the first process is gone");
    return std::make_unique<ThreadHaloExchange>(common_.mail, rank_, points, copies);
  }
  std::unique_ptr<plate::DistributedInverse> inverse(const plate::DistributedRows& rows) const override {
    return std::make_unique<ThreadInverse>(*this, rows);
  }
  plate::DistributedEigenpairs largest_pairs(const plate::DistributedProduct& product, std::span<const double> start,
                                             const plate::EigenpairRequest& wanted) const override {
    return ThreadPairs(*this, product, start.size()).find(start, wanted);
  }

private:
  template <typename T, typename Op>
  void together(std::vector<std::span<T>>& all, std::span<T> values, const Op& op) const {
    all[std::size_t(rank_)] = values;
    common_.meeting.arrive_and_wait();
    std::vector<T> result(all.front().begin(), all.front().end());
    for (std::size_t from = 1; from < all.size(); ++from)
      for (std::size_t i = 0; i < result.size(); ++i) result[i] = op(result[i], all[from][i]);
    common_.meeting.arrive_and_wait();
    std::copy(result.begin(), result.end(), values.begin());
  }

  Common& common_;
  int rank_;
};

}  // namespace

void run(int count, const std::function<void(const plate::Communicator&)>& each) {
  Common common(count);
  std::vector<std::exception_ptr> thrown(std::size_t(count), nullptr);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank)
    threads.emplace_back([&, rank] {
      if (count > 2) omp_set_num_threads(1);  // many more threads than cores wait for each other at every loop
      const ThreadCommunicator own(common, rank);
      try {
        each(own);
      } catch (...) {
        thrown[std::size_t(rank)] = std::current_exception();
        common.post.leave();
        common.meeting.arrive_and_drop();
      }
    });
  for (auto& thread : threads) thread.join();
  for (const auto& one : thrown)
    if (one) std::rethrow_exception(one);
}

}  // namespace thread_ranks
