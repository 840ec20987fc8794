"""Lengths of functions; units with a test of their own."""
import collections
import re

import functions
import tree

FUNCTION = 60  # lines; a TEST_CASE is a function: the longest had 39
TESTED = 0.82  # of the units, by the header that a unit test begins with; asked for: 0.75


def of_file(root, path):
    text = (root / path).read_text(encoding="utf-8")
    for function in functions.Reader(text).functions:
        if function.lines > FUNCTION:
            yield f"{path}:{function.first}: {function.name} has {function.lines} lines, {FUNCTION} are allowed"


def print_lines_of_code(root, paths):
    sums = collections.Counter()
    for path in paths:
        sums[path.parts[0]] += (root / path).read_text(encoding="utf-8").count("\n")
    print("lines of C++   " + ", ".join(f"{folder} {count:,}" for folder, count in sums.items()))


def headers_under_test(root):
    """Headers that a unit test begins with."""
    found = set()
    for test in (root / "tests" / "unit").rglob("test_*.cpp"):
        found.update(re.findall(r'^#include "([^"]+)"', test.read_text(encoding="utf-8"), re.MULTILINE)[:1])
    return found


def tests(root, paths):
    units = [path for path in paths if path.suffix == ".cpp" and not str(path).startswith("cases/programs/")]
    headers = headers_under_test(root)
    without = [path for path in units if str(path.with_suffix(".hpp")) not in headers]
    share = 1 - len(without) / len(units)
    per_folder = []
    for folder in tree.FOLDERS:
        inside = [path for path in units if path.parts[0] == folder]
        per_folder.append(f"{folder} {len(inside) - sum(path in without for path in inside)} of {len(inside)}")
    print(f"units tested   {share:.0%}: " + ", ".join(per_folder))
    if share < TESTED:
        yield (f"tests/unit:1: {len(units) - len(without)} of {len(units)} units ({share:.0%}) have a test of their own, "
               f"{TESTED:.0%} are asked for; without: " + " ".join(map(str, without)))


def check(root):
    everything = tree.cpp(root, tests=True)
    own = [path for path in everything if path.parts[0] != "tests"]
    problems = [problem for path in everything for problem in of_file(root, path)]
    count = sum(len(functions.read(root / path).functions) for path in everything)
    if count < len(own):
        raise tree.Empty(f"only {count} functions were found in {len(everything)} files: the reader of C++ is broken")
    print_lines_of_code(root, own)
    problems += tests(root, own)
    problems += [f"{path}:1: C++ ends in .cpp or .hpp here" for path in tree.oddly_named(root)]
    return problems, f"{count} functions in {len(everything)} files within the limits of length"
