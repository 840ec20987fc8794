#pragma once
#include "cases/input/case.hpp"

namespace cases {

/// The lengths of the discretisation of a path to srif.accuracy: those far from tips and holes and their growth `size`
/// times those of the first, those at tips by its square (theory.md, "To a stated accuracy"). In motion waves have to
/// cross the plate.
plate::Discretization discretization_of(const Case& c, double size);

}  // namespace cases
