#include <dlfcn.h>
#include <cstdio>
#include <cstdlib>

/// The installed program. All that computes is in libpdplate.so, of which there is one for each instruction set: the
/// system's loader takes the one that the processor can run (folders glibc-hwcaps, see ld.so(8)).
int main(int argc, char** argv) {
  if (!std::getenv("GOMP_SPINCOUNT")) setenv("OMP_WAIT_POLICY", "passive", 0);  // why: plate/model/process.hpp
  void* const library = dlopen("libpdplate.so", RTLD_LAZY);
  void* const program = library ? dlsym(library, "pdplate_main") : nullptr;
  if (!program) {
    std::fprintf(stderr, "failed: %s\n", dlerror());
    return 4;
  }
  return reinterpret_cast<int (*)(int, char**)>(program)(argc, argv);
}
