#pragma once
#include "post/files/hdf5/state_file.hpp"
#include "post/files/shared/point_order.hpp"

namespace post {

/// state.h5 of a plate that processes share, as one process writes it: the first writes, and the others send it their
/// points, points_at_once of all, so that none holds more than that of others' points. All call everything at once,
/// unless it says otherwise.
class SharedStateFile {
public:
  /// `mesh`: with the own points of the process first. `all` must outlive this.
  SharedStateFile(const plate::Ranks& all, StateFile::Options options, const Mesh& mesh);

  /// `frame`, `velocity`: with the own points first; velocity without columns where none are stored.
  void write(const Frame& frame, const plate::State& velocity);

  // as StateFile: may be called by each process, does something in the first
  void go_on(std::size_t frames);
  void part();
  void write(const std::string& name, const Table& table);
  void close();

private:
  using Numbers = std::function<void(std::size_t k, double* to)>;
  InParts parts(std::size_t width, Numbers numbers);
  template <typename Rows>
  InParts parts(const Rows& rows);

  PointOrder order_;
  std::vector<double> room_;       // the part in hand
  std::optional<StateFile> file_;  // of the first
};

}  // namespace post
