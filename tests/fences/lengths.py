"""Lengths of functions, files and folders; units with a test of their own."""
import collections

import functions
import tree

FUNCTION, HEADER, SOURCE, FOLDER = 60, 150, 300, 25  # lines, lines, lines, files; a TEST_CASE is a function: the longest had 39
LINES = {"cases": 5600}  # a third of it is the table of keys, which grows with what plates can carry
TESTED = 0.84  # of the units, asked for: 0.75; cases/main.cpp is none
LONG_HEADERS = {"plate/formulation/formulation.hpp": 154, "plate/bonds/rows/folded_row.hpp": 188, "cases/input/keys/forms.hpp": 170}


def of_file(root, path):
    text = (root / path).read_text(encoding="utf-8")
    limit = LONG_HEADERS.get(str(path), HEADER) if path.suffix == ".hpp" else SOURCE
    if (count := text.count("\n")) > limit:
        yield f"{path}:{limit + 1}: the file has {count} lines, {limit} are allowed"
    for function in functions.Reader(text).functions:
        if function.lines > FUNCTION:
            yield f"{path}:{function.first}: {function.name} has {function.lines} lines, {FUNCTION} are allowed"


def of_folders(paths):
    counts = collections.Counter(path.parent for path in paths)
    for folder, count in sorted(counts.items()):
        if count > FOLDER:
            yield f"{folder}:1: the folder has {count} sources and headers, {FOLDER} are allowed"


def lines_of_code(root, paths):
    sums = collections.Counter()
    for path in paths:
        sums[path.parts[0]] += (root / path).read_text(encoding="utf-8").count("\n")
    print("lines of C++   " + ", ".join(f"{folder} {count:,}" for folder, count in sums.items()))
    for folder, limit in LINES.items():
        if sums[folder] > limit:
            yield f"{folder}:1: the folder has {sums[folder]:,} lines of C++, {limit:,} are allowed"


def own_test(path):
    return "tests/unit" / path.with_name(f"test_{path.stem}.cpp")


def tests(root, paths):
    units = [path for path in paths if path.suffix == ".cpp" and str(path) != "cases/main.cpp"]
    without = [path for path in units if not (root / own_test(path)).is_file()]
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
    problems += of_folders(everything)
    problems += lines_of_code(root, own)
    problems += tests(root, own)
    problems += [f"{path}:1: C++ ends in .cpp or .hpp here" for path in tree.oddly_named(root)]
    return problems, f"{count} functions in {len(everything)} files within the limits of length"
