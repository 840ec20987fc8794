#include "fracture/runs/keeper.hpp"

#include <istream>
#include <sstream>

#include "plate/solve/archive.hpp"

namespace fracture {

Keeper::Keeper(post::Checkpoints checkpoints, double every) : checkpoints_(std::move(checkpoints)), every_(every) {}

bool Keeper::find(std::vector<std::string>& refused) {
  if (auto found = checkpoints_.read(refused)) memory_ = std::move(*found);
  return goes_on();
}

bool Keeper::due() const {
  return Clock::now() - last_ >= every_;
}

void Keeper::keep(const std::function<void(plate::OutArchive&)>& remember) {
  checkpoints_.write([&](std::ostream& stream) {
    plate::OutArchive archive(stream);
    remember(archive);
  });
  last_ = Clock::now();
}

bool Keeper::recall(const std::function<void(plate::InArchive&)>& recall) {
  if (!goes_on()) return false;
  std::istringstream stream(std::exchange(memory_, {}));
  plate::InArchive archive(stream);
  recall(archive);
  return true;
}

}  // namespace fracture
