#include "fracture/runs/keeper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "plate/solve/archive.hpp"
#include "plate/solve/reduction.hpp"
#include "post/files/shared/shared_checkpoints.hpp"
#include "post/report/say.hpp"

namespace fracture {

Keeper::Keeper(post::Checkpoints checkpoints, double every) : checkpoints_(std::move(checkpoints)), every_(every) {}

Keeper::Keeper(std::shared_ptr<post::SharedCheckpoints> checkpoints, double every)
    : together_(std::move(checkpoints)), every_(every) {}

bool Keeper::find(std::vector<std::string>& refused) {
  if (together_) {
    if (auto found = together_->read(refused)) found_ = std::move(found->memory), parts_ = std::move(found->parts);
  } else if (auto found = checkpoints_->read(refused)) {
    found_ = std::move(*found);
  }
  return goes_on();
}

void Keeper::done() const {
  together_ ? together_->remove() : checkpoints_->remove();
}

bool Keeper::recall(const std::function<void(plate::InArchive&)>& recall) {
  if (!goes_on()) return false;
  std::istringstream stream(std::exchange(found_, {}));
  plate::InArchive archive(stream);
  recall(archive);
  return true;
}

Keeper::Seconds Keeper::stretched(Seconds wanted, Seconds cost) const {
  constexpr double share = 0.01;
  return every_ < Seconds(1) ? wanted : std::max(wanted, cost / share);
}

bool Keeper::due() const {
  return Clock::now() - written_ >= stretched(every_, to_take_ + to_write_);
}

void Keeper::take(const Remember& remember) {
  const auto begin = Clock::now();
  std::ostringstream stream;
  plate::OutArchive archive(stream);
  remember(archive);
  held_ = std::move(stream).str();
  taken_ = Clock::now();
  to_take_ = taken_ - begin;
}

void Keeper::keep(const Remember& remember, const post::CellValues* own) {
  take(remember);
  write(own);
}

bool Keeper::agreed(bool here) const {
  return together_ ? plate::largest_of_all(here) > 0 : here;
}

void Keeper::hold(const Remember& remember, const std::function<post::CellValues()>& own) {
  if (agreed(Clock::now() - taken_ >= stretched(std::min(every_, Seconds(1)), to_take_))) {
    take(remember);
    if (own) held_points_ = std::make_shared<const post::CellValues>(own());
  }
  if (agreed(due())) write();
}

void Keeper::write() {
  write(held_points_.get());
  held_points_.reset();
}

void Keeper::write(const post::CellValues* own) {
  if (held_.empty()) return;
  const auto begin = Clock::now();
  try {
    if (together_)
      together_->write(held_, own ? *own : post::CellValues{});
    else
      checkpoints_->write(held_);
  } catch (const std::filesystem::filesystem_error& error) {
    if (!std::exchange(failed_, true)) post::say(fmt::format("no checkpoint: {}\n", error.what()));
  }
  held_.clear();
  held_.shrink_to_fit();
  written_ = Clock::now();
  to_write_ = written_ - begin;
}

}  // namespace fracture
