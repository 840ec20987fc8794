#pragma once

namespace plate {

/// Memory that this program could have beside what it has: of the machine, and within the limit of its control group
/// [bytes]; 0 where the system does not tell.
double free_memory();

}  // namespace plate
