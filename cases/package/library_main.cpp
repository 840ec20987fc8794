#include "cases/programs/command_line.hpp"
#include "plate/model/process.hpp"

/// The program pdplate, as libpdplate.so gives it to the launcher.
extern "C" [[gnu::visibility("default")]] int pdplate_main(int argc, char** argv) {
  plate::set_up_process(argv);
  return cases::command_line(argc, argv, plate::single_process());
}
