#pragma once
#include <vector>
#include "plate/boundary/lattice_body.hpp"

namespace plate {

/// To which faces the force of a bond that leaves the body belongs.
/// crossing_point: to the face that it crosses, half or a quarter of it where it crosses an edge or a vertex of faces
/// (Sca23 35, alpha). lever: along the bond cut at t of its length, t to the face in whose column its outer node lies
/// and 1 - t to that of its inner node, wherever these are faces: also exact for constant forces, and what it makes of
/// free edges in two dimensions has no negative eigenvalues, which the crossing point's has.
enum class FluxRule { crossing_point, lever };

/// A share of a bond's force in the flux through a face.
struct Crossing {
  int surface;   // the surface node
  double share;  // of the force
  double cut;    // where the face cuts the bond, from its inner node, over its length
};

/// Shares of the bond from node `inner` to node `outer` in the fluxes of the faces that it leaves the body through. A
/// bond that enters the body leaves it the other way round. Bonds between fictitious nodes count as well.
std::vector<Crossing> crossings(const LatticeBody& body, int inner, int outer, FluxRule rule);

}  // namespace plate
