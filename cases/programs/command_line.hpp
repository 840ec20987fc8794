#pragma once
#include "plate/model/communicator.hpp"
#include "plate/model/point_map.hpp"

namespace cases {

/// Runs the command that the arguments of a program name, and returns its exit code. Collective.
int command_line(int argc, char** argv, const plate::Communicator& communicator);

}  // namespace cases
