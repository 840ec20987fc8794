# The newest clang that is installed, for the presets `sanitize` and `threads`.
find_program(PDPLATE_CLANG REQUIRED NAMES clang++-21 clang++-20 clang++-19 clang++-18 clang++-17 clang++-16 clang++)
string(REPLACE "clang++" "clang" PDPLATE_CLANG_C ${PDPLATE_CLANG})
set(CMAKE_CXX_COMPILER ${PDPLATE_CLANG})
set(CMAKE_C_COMPILER ${PDPLATE_CLANG_C})
