#include "plate/model/communicator.hpp"

namespace plate {
namespace {

thread_local const Ranks* current = nullptr;

}  // namespace

const Ranks* ranks() {
  return current;
}

AmongRanks::AmongRanks(const Ranks& ranks) : before_(current) {
  current = &ranks;
}

AmongRanks::~AmongRanks() {
  current = before_;
}

}  // namespace plate
