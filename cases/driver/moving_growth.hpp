#pragma once
#include "cases/driver/assembly.hpp"
#include "fracture/severing/fallen_pieces.hpp"
#include "post/files/frame.hpp"
#include "post/factors/tip_methods.hpp"
#include "post/files/summary.hpp"

namespace cases {

/// Cracks that grow in a dynamic run: the plate whose bonds they sever, and what is written of them. Of bonds over a horizon.
class MovingGrowth {
public:
  /// Both must outlive this.
  MovingGrowth(const CaseFile& file, const Assembly& assembly);
  virtual ~MovingGrowth() = default;

  const plate::Operator& plate() const { return plate_; }
  plate::Changes& changes();
  virtual double fracture_energy() const = 0;
  /// Kinetic energy of pieces that were frozen.
  double frozen_energy() const { return fallen_ ? fallen_->energy() : 0; }

  /// A row of the history: factors of the tips where they are now, by the methods of the case; none of tips beside edges and
  /// other cracks.
  std::vector<post::Srif> sample(double time, const plate::State& state);
  /// The cells between points that still see each other; sets the frame's resultants and damage.
  post::Mesh draw(post::Frame& frame, const plate::State& state) const;
  /// growth.csv and cracks.csv; with `lines` cracks.vtp.
  virtual void write(const std::filesystem::path& folder, bool lines) const = 0;
  virtual post::GrowthSummary summary() const = 0;

protected:
  /// Tips by their number.
  using Tips = std::vector<std::pair<std::size_t, geometry::Tip>>;
  virtual plate::Changes& severing() = 0;
  virtual void look(double time) = 0;
  virtual Tips tips() const = 0;
  virtual std::vector<geometry::CrackPath> paths() const = 0;
  /// What became of the plate: ", edge 'left' reached; the plate split in 2 parts, which move on".
  std::string parts() const;

  const Case& case_;
  const Assembly& assembly_;
  fracture::SeveredPlate plate_;

private:
  std::optional<fracture::FallenPieces> fallen_;
};

/// By the criterion of the case.
std::unique_ptr<MovingGrowth> moving_growth(const CaseFile& file, const Assembly& assembly);

}  // namespace cases
