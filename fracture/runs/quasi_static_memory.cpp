#include "fracture/runs/keeper.hpp"
#include "fracture/runs/quasi_static_run.hpp"
#include "plate/solve/archive.hpp"
#include "post/files/archive.hpp"

namespace fracture {

template <typename Archive>
void QuasiStaticRun::memory(Archive& archive) {
  auto& [work, strain, fracture] = grown_.ledger;
  archive(reactions_, pictures_, srifs_, latest_, work, strain, fracture, advance_, factor_, largest_factor_, doubt_,
          first_factor_, framed_);
}

/// `load`: to go on from.
Continuation QuasiStaticRun::continuation(Keeper& keeper, QuasiStaticLoad& load) {
  const bool goes_on = keeper.recall([&](plate::InArchive& archive) {
    archive(load);
    recorder_->recall(archive);
    memory(archive);
    model_->recall(archive);
    state_ = factor_ * model_->state();
  });
  const auto hold = [&](const QuasiStaticLoad& now) {
    keeper.hold([&](plate::OutArchive& archive) {
      archive(now);
      recorder_->remember(archive);
      memory(archive);
      model_->remember(archive);
    });
  };
  return {goes_on ? &load : nullptr, hold};
}

void QuasiStaticRun::write_held(Keeper* keeper) {
  if (keeper) keeper->write();
}

}  // namespace fracture
