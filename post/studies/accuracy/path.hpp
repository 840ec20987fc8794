#pragma once
#include "plate/model/discretization.hpp"

namespace plate {
struct Problem;
}

namespace post {

/// The lengths of the discretisation of a path to a stated accuracy: those far from tips and holes and their growth
/// `size` times those of the first, those at tips by its square (theory.md, "To a stated accuracy"). In motion waves
/// have to cross the plate.
plate::Discretization discretization_of(const plate::Problem& problem, bool moves, double size);

}  // namespace post
