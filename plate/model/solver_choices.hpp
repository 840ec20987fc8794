#pragma once

namespace plate {

/// How the equilibrium of a plate is found.
enum class StaticMethod { adr, cg, direct };

/// How the inverse of the stiffness is approached in conjugate gradients.
enum class Preconditioning { automatic, diagonal, local, two_level, levels };

}  // namespace plate
