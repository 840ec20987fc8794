#pragma once
#include "cases/input/manual.hpp"

/// A program of two commands, and keys of every form.
namespace small_program {

inline const std::vector<cases::ManualKey> keys{
    {"title", "-", "a string", "\"\"", "title"},
    {"section.young", "force/length^2", "a number > 0", "required", "modulus"},
    {"section.poisson", "-", "a number in (-1, 0.5)", "required", "ratio"},
    {"load[].kind", "-", "one of \"pressure\", \"point_force\"", "required", "what acts"},
    {"analysis.modes", "-", "an integer in [1, 1000]", "6", "how many"},
    {"analysis.time_step", "time", "\"auto\" or a number > 0", "\"auto\"", "step"},
    {"geometry.cracks", "length", "[ [[x, y], [x, y], ...], ... ]", "absent", "polylines"}};

inline const cases::Program program{
    "plates",
    "1.0",
    "bends - plates",
    {{{"--version"}, "", "version"}},
    {{"run", ".runs", {{"case", "which", true}}, {{{"--set"}, "TEXT", "override"}, {{"--quiet"}, "", "it's quiet"}}},
     {"keys", "keys", {{"key", "part", false}}, {}}}};

}  // namespace small_program
