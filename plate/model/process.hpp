#pragma once
#include <string>

namespace plate {

/// Sets how the process of a program waits and keeps memory; called first in main. Threads that wait sleep: with one of
/// two cores busy a static run took 5.1 s spinning and 3.7 s sleeping; one force evaluation alone took the same. Memory
/// that is given back is kept for the next array: the system clears every page that it hands out. A reader that has
/// gone, or a file larger than is allowed, fails what is written to it and does not end the process.
void set_up_process(char** argv);

/// Limits a wanted number of threads to what this machine can use: no more than eight for each of its processors, nor
/// than half of the address space that is allowed holds with their stacks and heaps; one at least.
int sensible_threads(int wanted);

/// Time at which the file of this program was written: what runs of the very same build have in common.
std::string build();

/// Memory that this program could have beside what it has: of the machine, and within the limit of its control group
/// [bytes]; 0 where the system does not tell.
double free_memory();

}  // namespace plate
