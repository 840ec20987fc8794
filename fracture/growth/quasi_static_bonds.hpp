#pragma once
#include "fracture/growth/bond_cracks.hpp"
#include "fracture/growth/bond_failure.hpp"
#include "fracture/growth/quasi_static_growth.hpp"

namespace fracture {

/// Bonds that break quasi-statically: the plate is linear between two of them, so the load factor at which the next
/// ones break is known exactly, and no step can be too long. One bond breaks at a time, and those that are loaded alike
/// (mirror images). The plate is solved anew after each loss with the factor of the plate at the start.
class QuasiStaticBonds : public QuasiStaticModel {
public:
  /// `start`: the plate before any bond has broken, of a formulation with bonds that break; both must outlive this.
  /// `factors`: where intensity factors are wanted.
  QuasiStaticBonds(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
                   const plate::StaticOptions& options);

  ~QuasiStaticBonds() override;
  Loaded solve() override;
  void choose(const Equilibrium& state) override;
  void advance(double factor) override;

  std::size_t advances() const override { return advances_; }
  double fracture_energy() const override { return spent_; }
  bool longest() const override { return growth_.reached(cracks_.length()); }

  const plate::Formulation& plate() const override { return start_; }
  const plate::State& state() const override { return state_; }
  const plate::Operator& forces() const override { return plate_; }
  const plate::StaticSolution& solution() const override { return solution_; }
  std::optional<std::vector<post::Srif>> factors(double factor) override;
  plate::Mesh draw(post::Frame& frame, const plate::State& state) const override;
  std::vector<double> lengths() const override;
  std::optional<std::size_t> broken_bonds() const override { return cracks_.broken(); }
  /// Growth of the cracks beyond their length at the start [length].
  double grown_length() const { return cracks_.growth(); }

  void save(plate::OutArchive& archive) const override;
  void restore(plate::InArchive& archive) override;
  plate::State* of_points() override { return &state_; }
  void restored_points() override { plate_.constraints().impose(state_); }

private:
  template <typename Archive, typename Self>
  static void memory(Archive& archive, Self& self);
  std::string free_pieces() const;
  void find_state();
  /// Norm of a force as StaticOptions defines it for residuals.
  double norm(const plate::Forces& force) const { return plate_.norm(force, diagonal_); }

  const Growth& growth_;
  const plate::Formulation& start_;
  std::optional<post::SrifOptions> options_of_factors_;
  plate::StaticOptions options_;
  DamagedPlate plate_;
  BondLimits limits_;
  BondCheck check_;
  BondCracks cracks_;
  plate::Forces load_, diagonal_;
  plate::State state_;
  std::unique_ptr<plate::Preconditioner> factor_;
  double norm_ = 0, most_ = 0;  // largest demand of a bond
  plate::StaticSolution solution_;
  std::vector<LoadedBond> breaks_;
  bool new_lines_ = true;  // since the factors were found
  std::size_t advances_ = 0;
  double spent_ = 0;
};

}  // namespace fracture
