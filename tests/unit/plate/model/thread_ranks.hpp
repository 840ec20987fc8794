#pragma once
#include <functional>

#include "plate/model/communicator.hpp"

/// Processes that share a plate, as threads of one.
namespace thread_ranks {

/// Calls `each` in so many threads, each with a communicator of its own, and waits for all. What the first of them
/// throws is thrown.
void run(int count, const std::function<void(const plate::Communicator&)>& each);

}  // namespace thread_ranks
