#pragma once

namespace post {
struct Table;
}

namespace cases {

struct CaseFile;

/// K from the energy of neighbouring crack lengths, G = dU/da at fixed loads, for every tip of a static case: two
/// solutions per tip, the crack lengthened and shortened by one spacing along the lattice, by six at other angles,
/// where the energy of a lattice changes in jumps. K is the size of all modes together: sqrt(G / g1), with the G of K1
/// = 1. Columns: tip, x, y, step, G, K. Throws CaseError where the case is not static or a shortened crack would
/// vanish.
post::Table energy_check(const CaseFile& file);

}  // namespace cases
