#pragma once
namespace plate {
struct Analysis;
struct Problem;
}  // namespace plate

namespace post {
struct Table;
}

namespace cases {

/// K from the energy of neighbouring crack lengths, G = dU/da at fixed loads, for every tip of a static problem: two
/// solutions per tip, the crack lengthened and shortened by one spacing along the lattice, by six at other angles,
/// where the energy of a lattice changes in jumps. K is the size of all modes together: sqrt(G / g1), with the G of K1
/// = 1. Columns: tip, x, y, step, G, K, and where loads act in the plane G_in_plane and N, the size of N1 and N2.
/// Throws plate::Refused where a crack is too short to be shortened, or a plate cannot be had, and
/// plate::NumericalError.
post::Table energy_check(const plate::Problem& problem, const plate::Analysis& analysis);

}  // namespace cases
