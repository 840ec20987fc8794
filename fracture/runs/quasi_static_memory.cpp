#include "fracture/runs/keeper.hpp"
#include "fracture/runs/quasi_static_run.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "fracture/runs/shared/own_values.hpp"
#include "plate/solve/archive.hpp"
#include "post/files/archive.hpp"

namespace fracture {

template <typename Archive>
void QuasiStaticRun::memory(Archive& archive) {
  auto& [work, strain, fracture] = grown_.ledger;
  archive(reactions_, pictures_, srifs_, latest_, work, strain, fracture, advance_, factor_, largest_factor_, doubt_,
          doubtful_, first_factor_, first_error_, framed_);
}

/// `load`: to go on from.
Continuation QuasiStaticRun::continuation(Keeper& keeper, QuasiStaticLoad& load) {
  auto* const points = model_->of_points();
  const bool goes_on = keeper.recall([&](plate::InArchive& archive) {
    archive(load);
    recorder_->recall(archive);
    memory(archive);
    model_->recall(archive);
    if (points && !shared()) archive(*points);
  });
  if (goes_on && points && shared())
    put_values(model_->plate().boundary(), keeper.parts(), {points}), model_->recalled_points();
  if (goes_on) state_ = factor_ * model_->state();
  const auto hold = [this, &keeper, points](const QuasiStaticLoad& now) {
    const auto remember = [&](plate::OutArchive& archive) {
      archive(now);
      recorder_->remember(archive);
      memory(archive);
      model_->remember(archive);
      if (points && !shared()) archive(*points);
    };
    std::function<post::CellValues()> own;
    if (points && shared()) own = [this, points] { return own_values(model_->plate().boundary(), {points}); };
    keeper.hold(remember, own);
  };
  return {goes_on ? &load : nullptr, hold};
}

void QuasiStaticRun::write_held(Keeper* keeper) {
  if (keeper) keeper->write();
}

}  // namespace fracture
