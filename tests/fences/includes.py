"""Every #include against the table of arrows and libraries (arrows.toml); own headers that a unit reaches."""
import pathlib
import re
import statistics
import tomllib

import tree

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r'("(?:\\.|[^"\\\n])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)
# Of the standard library, C and POSIX: no folder, no ending but .h. experimental/simd is the standard's too.
STANDARD = re.compile(r"^(?:[a-z_0-9]+|experimental/simd|(?:assert|dlfcn|errno|fcntl|malloc|omp|poll|unistd|immintrin|fenv|sched|sys/[a-z]+)\.h)$")


class Table:
    def __init__(self, path):
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        self.arrows, self.libraries, self.limits = table["arrows"], table["library"], table["limits"]

    def rule(self, path):
        """The name in the table that fits this file best."""
        fitting = [name for name in self.arrows if pathlib.PurePath(name) in (path, *path.parents)]
        return max(fitting, key=len) if fitting else None

    def allows(self, path, header):
        rule = self.rule(path)
        own = pathlib.PurePath(rule)
        return (own in header.parents and self.rule(header) == rule) or any(covers(name, header) for name in self.arrows[rule])

    def library(self, name):
        return next((key for key, library in self.libraries.items() if name.startswith(tuple(library["begins"]))), None)


def covers(name, header):
    """"plate": all below it; "plate/*": the headers of that folder itself."""
    if name.endswith("/*"):
        return header.parent == pathlib.PurePath(name[:-2])
    return pathlib.PurePath(name) in header.parents


def includes(root, path):
    """(line, name, quoted) of every #include of a file."""
    text = COMMENT.sub(lambda m: m[1] or tree.blank(m[0]), (root / path).read_text(encoding="utf-8"))
    return [(text.count("\n", 0, m.start()) + 1, m[2], m[1] == '"') for m in INCLUDE.finditer(text)]


def own(root, name):
    """The header of this tree that is meant, or None."""
    return pathlib.PurePath(name) if name.split("/")[0] in tree.FOLDERS and "/" in name else None


def of_library(table, path, line, name):
    key = table.library(name)
    if key is None:
        if not STANDARD.match(name):
            yield f"{path}:{line}: <{name}> is of no library in tests/fences/arrows.toml; allowed: {', '.join(table.libraries)}"
        return
    library = table.libraries[key]
    if not any(covers(folder, path) for folder in library["folders"]):
        yield f"{path}:{line}: {key} ({name}) is included outside its folders; allowed: {', '.join(library['folders'])}"
    if path.suffix == ".hpp" and not library["in_headers"]:
        yield f"{path}:{line}: {key} ({name}) is included in a header; allowed: .cpp files of {', '.join(library['folders'])}"


def of_file(root, table, path):
    if table.rule(path) is None:
        yield f"{path}:1: the folder {path.parent} is not in tests/fences/arrows.toml; allowed: {', '.join(table.arrows)}"
        return
    for line, name, quoted in includes(root, path):
        header = own(root, name)
        if header is None:
            if quoted:
                yield f'{path}:{line}: "{name}" is not a path from the root; allowed: "folder/subfolder/name.hpp"'
            else:
                yield from of_library(table, path, line, name)
        elif not (root / header).is_file():
            yield f"{path}:{line}: there is no {header}"
        elif header.suffix != ".hpp":
            yield f"{path}:{line}: {header} is not a header; allowed: .hpp"
        elif not table.allows(path, header):
            allowed = ", ".join(table.arrows[table.rule(path)]) or "nothing but itself"
            yield f"{path}:{line}: {table.rule(path)} includes {header}; allowed: {allowed}"


class Reach:
    """Own headers that a file reaches."""

    def __init__(self, root):
        self.root, self.direct = root, {}

    def of(self, path):
        seen, waiting = set(), [path]
        while waiting:
            at = waiting.pop()
            if at not in self.direct:
                self.direct[at] = [header for _, name, _ in includes(self.root, at)
                                   if (header := own(self.root, name)) and (self.root / header).is_file()]
            waiting += [header for header in self.direct[at] if header not in seen]
            seen.update(self.direct[at])
        return seen


def counts(root, table, paths):
    reach, limit = Reach(root), table.limits["reached"]
    reached = {path: len(reach.of(path)) for path in paths if path.suffix == ".cpp"}
    print(f"{'own headers that a unit reaches':<32}{'units':>6}{'median':>8}{'most':>6}{f'over {limit}':>9}")
    for folder in tree.FOLDERS:
        these = {path: count for path, count in reached.items() if path.parts[0] == folder}
        median, most = statistics.median(these.values()), max(these, key=these.get)
        over = sum(count > limit for count in these.values())
        print(f"  {folder:<30}{len(these):>6}{median:>8g}{these[most]:>6}{over:>9}   ({most})")
        if median > table.limits["median"].get(folder, limit):
            yield (f"{folder}:1: a unit reaches {median:g} of our own headers in the median; allowed: "
                   f"{table.limits['median'].get(folder, limit)}")
    for path, count in reached.items():
        if count > limit:
            yield f"{path}:1: reaches {count} of our own headers; allowed: {limit}"


def check(root):
    table = Table(pathlib.Path(__file__).with_name("arrows.toml"))
    paths = tree.cpp(root)
    number = sum(len(includes(root, path)) for path in paths)
    if number < len(paths):
        raise tree.Empty(f"only {number} includes were found in {len(paths)} files: the reader of includes is broken")
    problems = [problem for path in paths for problem in of_file(root, table, path)]
    problems += counts(root, table, paths)
    return problems, f"{number} includes of {len(paths)} files follow the arrows"
