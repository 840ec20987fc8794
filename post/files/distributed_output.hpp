#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/communicator.hpp"
#include "post/files/frame.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/recorder.hpp"

namespace plate {
class Ranks;
}

namespace post {

/// Frames of a plate that processes share: each writes its piece, fields_NNNN_RANK.vtu as VtkSeries does, and when all
/// are there the first writes fields_NNNN.pvtu, which names the pieces, fields.pvd, and the cracks where they change.
class VtkPieces {
public:
  /// `mesh`: what this process draws. `all` must outlive this.
  VtkPieces(const plate::Ranks& all, std::filesystem::path folder, Mesh mesh);
  /// Sets the mesh of the frames from now on.
  void remesh(Mesh mesh) { mesh_ = std::move(mesh); }
  /// All processes call it at once.
  void write(const Frame& frame);
  /// Goes on after frames that a run has written which was ended, by whatever number of processes; what there is of
  /// later ones goes. All processes call it at once.
  void go_on(std::vector<double> times);

private:
  const plate::Ranks& all_;
  std::filesystem::path folder_;
  Mesh mesh_;
  std::vector<double> times_;
};

/// The points of a plate that processes share, in the order in which one process has them: row by row from the lower
/// left, or by their numbers. Each process knows where its own stand, by stretches of a row.
class PointOrder {
public:
  /// `own`: the points of the process in that order [length]; of a row of the lattice all processes have the same y.
  /// All call it at once. `all` must outlive this.
  PointOrder(const plate::Ranks& all, const std::vector<geometry::Point>& own);
  /// `numbers`: of the points of the process among all, ascending.
  PointOrder(const plate::Ranks& all, const std::vector<std::uint32_t>& numbers);

  /// Number of points of all ranks.
  std::size_t points() const { return points_; }

  /// Gathers the values of `count` points from `first` on, `width` of each, point by point: on the first rank; empty on
  /// the others. `numbers(k, to)` gives those of the rank's own point k. Collective: every rank must call it.
  std::vector<double> at_first(std::size_t first, std::size_t count, std::size_t width,
                               const std::function<void(std::size_t k, double* to)>& numbers) const;

private:
  /// Own points that follow each other among all.
  struct Stretch {
    std::size_t first, begin, points;  // first: among all; begin: among the own
  };

  const plate::Ranks& all_;
  std::size_t points_ = 0;
  std::vector<Stretch> own_;
};

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

/// The frames of a plate that processes share, in pieces and in one state.h5; of the first of them also what `rest`
/// takes: tables, summary, cracks.
class Pieces : public Sink {
public:
  /// `draws`: pieces are wanted. `stored`: of state.h5, where that is wanted. `rest`: nothing in all processes but the
  /// first.
  Pieces(const plate::Ranks& all, std::filesystem::path folder, bool draws, std::optional<StateFile::Options> stored,
         std::unique_ptr<Sink> rest);

  bool draws() const override { return draws_; }
  bool stores() const override { return stored_.has_value(); }
  bool plots() const override { return rest_ && rest_->plots(); }
  void open(const Mesh& mesh) override;
  void frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) override;
  void final_state(const Mesh& mesh, const Frame& frame) override;
  void cracks(const Cracks& cracks) override;
  void plot(const std::string& name, const std::string& svg) override;
  void tables(const Tables& tables) override;
  void summary(const std::string& json) override;
  std::vector<double> written() override;
  void go_on(const std::vector<double>& times) override;

private:
  const plate::Ranks& all_;
  std::filesystem::path folder_;
  bool draws_;
  std::optional<StateFile::Options> stored_;
  std::unique_ptr<Sink> rest_;
  std::optional<VtkPieces> vtk_;
  std::optional<SharedStateFile> hdf5_;
  std::vector<double> times_;  // of the frames
};

}  // namespace post
