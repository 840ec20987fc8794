#define CATCH_CONFIG_RUNNER  // Catch2 2 defines its runner here
#include "tests/catch.hpp"

int main(int argc, char* argv[]) {
  return Catch::Session().run(argc, argv);
}
