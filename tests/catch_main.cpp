#define CATCH_CONFIG_MAIN  // Catch2 2 defines its main program here
#include "tests/catch.hpp"
