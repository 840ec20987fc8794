#pragma once
#include "post/files/shared/shared_state_file.hpp"
#include "post/files/sinks/sink.hpp"
#include "post/files/vtk/pieces.hpp"

namespace post {

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
