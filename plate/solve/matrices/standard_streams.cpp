#include <cstdio>

/// Replacements of stdout and stderr for the archives of SuiteSparse where they become part of a shared library: they
/// are compiled for programs, and the linker refuses their access to a variable of another library (option --wrap).
extern "C" {
extern FILE *__real_stdout, *__real_stderr;
[[gnu::visibility("hidden")]] FILE *__wrap_stdout, *__wrap_stderr;
[[gnu::constructor(101)]] static void know_standard_streams() {
  __wrap_stdout = __real_stdout;
  __wrap_stderr = __real_stderr;
}
}
