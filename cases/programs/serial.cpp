#include "cases/programs/command_line.hpp"
#include "plate/model/process.hpp"

/// The program pdplate: one process.
int main(int argc, char** argv) {
  plate::set_up_process(argv);
  return cases::command_line(argc, argv, plate::single_process());
}
