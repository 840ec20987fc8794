#pragma once

namespace plate {

/// Memory that a further program could have [bytes]; 0 where the system does not tell.
double free_memory();

}  // namespace plate
