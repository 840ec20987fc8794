#pragma once
#include "plate/model/numerical_method.hpp"

namespace geometry {
struct Grading;
}

namespace plate {

/// Families of cells (theory.md, "The Galerkin plate").
extern const FormulationKind galerkin;

/// Preconditioner that "auto" selects for a plate with this number of points: multigrid on coarser plates or, as
/// "automatic", the factor of the plate itself.
Preconditioning usual_preconditioner_of_cells(const Problem& problem, double points);

/// Grading of points with all spacings `factor` times as wide: at tips and holes as the case says, about forces next to
/// tips, about parts that are held, and, where tips are graded, at free and softly supported edges whose layer is
/// narrower than the spacing (theory.md, "The Galerkin plate").
geometry::Grading grading_of(const Problem& problem, double factor);

}  // namespace plate
