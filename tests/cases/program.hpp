#pragma once
#include <sys/wait.h>

#include <cstdlib>

#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

/// The program as its user runs it.
namespace program_run {

inline std::string quoted(const std::string& text) {
  REQUIRE(text.find('\'') == std::string::npos);
  return "'" + text + "'";
}

/// Its line in a shell.
inline std::string command(const std::vector<std::string>& arguments) {
  std::string line = quoted(PDPLATE_PROGRAM);
  for (const auto& argument : arguments) line += " " + quoted(argument);
  return line;
}

struct Ended {
  int exit_code;
  std::string output;  // standard output and errors
};

/// Lines of a shell.
inline Ended shell(const std::string& lines) {
  const small_run::TemporaryFolder scratch;
  const int status = std::system(("{ " + lines + "\n} > " + quoted((scratch / "output").string()) + " 2>&1").c_str());
  REQUIRE(WIFEXITED(status));
  return {WEXITSTATUS(status), small_run::text_of(scratch / "output")};
}

inline Ended program(const std::vector<std::string>& arguments) {
  return shell(command(arguments));
}

}  // namespace program_run
