#pragma once
#include <vector>

#include "plate/formulation/elastic_supports.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct FacePair;
struct Problem;
struct Stiffener;
enum class PlateLaw;

/// The stiffness of a beam on points on the edges and between them: elements of the beam of Bernoulli (Hermite's cubic
/// lines), or of Timoshenko, between places a spacing apart; of laws other than bending that of EA alone (theory.md,
/// "Stiffeners").
void add_stiffener(const Stiffener& stiffener, PlateLaw law, const geometry::Tessellation& cells,
                   ElasticSupportSum& sum);

/// An element of the axis of a stiffener between two places, for slopes that stretch it.
struct AxialElement {
  double stiffness = 0;        // EA / length [force/length]
  double eccentricity = 0;     // z of the axis [length]
  double length = 0;           // [length]
  std::vector<FormTerm> pull;  // elongation by a plane, or by rotations of the plate at z = 1
  std::vector<FormTerm> rise;  // difference of the deflections of the ends
};
/// Elements of all stiffeners that act in the plane, as far as points that the rank owns carry them.
std::vector<AxialElement> axial_elements(const Problem& problem, const geometry::Tessellation& cells,
                                         const PointMap& map = {});

/// Mass of all stiffeners at every point times a power of the z of their axes [mass length^power]; empty where none has
/// any.
std::vector<double> stiffener_masses(const Problem& problem, const geometry::Tessellation& cells, int power = 0);

/// Resistance of the axial forces of stiffeners to deflections, N (w')^2 / 2 along them, by a plate and its plane in a
/// state. Negative in compression.
ElasticSupports axial_forces_of(const Problem& problem, const geometry::Tessellation& cells, const PointMap& map,
                                const State& bending, const State& in_plane);

/// Constructs all foundations and springs of a problem on points in the middles of cells. `faces`: of the cracks, where
/// springs tie them.
ElasticSupports elastic_supports_of(const Problem& problem, const geometry::Cloud& cloud,
                                    const std::vector<FacePair>& faces);

/// Foundations and springs of a problem on points that are corners of cells.
ElasticSupports elastic_supports_of(const Problem& problem, const geometry::Tessellation& cells);

}  // namespace plate
