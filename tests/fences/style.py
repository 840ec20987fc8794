"""Rules of the text of sources: no `catch` without a body, docstrings that name their subject, one place that numbers
degrees of freedom and that knows how many a point has, keys of case files in `cases` alone."""
import re

import tree

EMPTY = re.compile(r"\bcatch\s*\([^)]*\)\s*\{\s*\}")
UNNAMED = ("Of", "Those", "What", "The same", "How")  # begin a docstring that names no subject
DOCSTRINGS = 0                                        # of these are allowed

DOF_ARITHMETIC = 0  # lines that number degrees of freedom by themselves
NUMBERING = ("plate/model/space.hpp",  # and the kernels, which keep their fixed component count
             "plate/bonds/rows/", "plate/formulation/bond_law.hpp", "plate/solve/lanes.hpp",
             "plate/galerkin/force_kernels.", "plate/galerkin/stiffness.")
POINT = r"\(?\*?(?!horizon|spacing)[a-z_][\w.>\-]*(?:\(\)|\(s\)|\[\w+\])?(?: \+ [\w()]+\))?"  # k, *j, last(), (real + s)
DOF = re.compile("|".join((
    rf"\b3 \* {POINT} \+ (?:[12a-z]\b|std::\w+\(|component|unknown|main|other)(?! \*)",  # 3 * k + c
    rf"(?:[\[{{]|\b(?:fix|tie|held|add|add_force)\(|segment<\d>\(|\b(?:dof|row|to|first) = )3 \* {POINT}[\]),;]",  # 3 * k
    rf"\b(?:\w*dof|follower|leader|unknown|row|column|one|held\[\w+\])\)? [/%] 3\b",  # dof / 3, dof % 3
    r"\b[69] \* \w+(?:\]| \+ 3 -)")))  # 9 * block], 6 * k + 3 - other

LITERAL_SIZES = 0  # lines that write the number of unknowns of a point as 3
SIZING = (*NUMBERING, "plate/model/state.hpp",
          "geometry/")  # knows no unknowns
VALUES = r"\b(?:State|Forces|Values<\w+>)"
SIZE = re.compile("|".join((
    rf"{VALUES}(?:::\w+| \w+)?[({{]3, ", rf"{VALUES} .*\), \w+\(3, ",  # State::Zero(3, n), State a(3, n), b(3, n)
    r"(?<!moments)(?<!factors_)(?:\.|->)(?:resize|setZero)\(3, ",  # of resultants and of a fit: three moments, three factors
    r"\bMatrix<\w+, 3, (?:Eigen::)?Dynamic\b",
    r"\bconstexpr [\w:]+ \w*(?:unknowns|components|dofs)\w*(?: = |\{)3\b",
    r"\b(?:c|component|unknown) < 3\b")))

SPELLED_KEYS = 0  # of case files, in strings below `cases`
TABLE_OF_KEYS = "cases/keys.md"


def catches(root, path):
    code = tree.code((root / path).read_text(encoding="utf-8"))
    for match in EMPTY.finditer(code):
        yield f"{path}:{code.count(chr(10), 0, match.start()) + 1}: a catch without a body; say what is done about it"


def docstrings(root, path):
    """Lines of the docstrings that name no subject."""
    begins = re.compile(rf"\s*/// ({'|'.join(UNNAMED)})\b")
    before = ""
    for count, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1):
        if begins.match(line) and not before.lstrip().startswith("///"):
            yield count
        before = line


def dof_arithmetic(root, path):
    """Lines that compute degrees of freedom, their points or their components."""
    if not path.as_posix().startswith(NUMBERING):
        for count, line in enumerate(tree.code((root / path).read_text(encoding="utf-8")).splitlines(), 1):
            if DOF.search(line):
                yield count


def literal_sizes(root, path):
    """Lines that size values of points by a literal."""
    if not path.as_posix().startswith(SIZING):
        for count, line in enumerate(tree.code((root / path).read_text(encoding="utf-8")).splitlines(), 1):
            if SIZE.search(line):
                yield count


def key_pattern(root):
    """A key of the table in a text, or the place of one: section.name, section.{}, list[0].name, list[{}]."""
    keys = re.findall(r"^\| `(\w+)(\[\])?\.(\w+)", (root / TABLE_OF_KEYS).read_text(encoding="utf-8"), re.MULTILINE)
    if not keys:
        raise tree.Empty(f"no key in {TABLE_OF_KEYS}")
    names = {rf"{section}(?:\[[^\]]*\])?\.(?:{name}\b|\{{)" for section, _, name in keys}
    entries = {rf"{section}\[(?:\{{|\d)" for section, entry, _ in keys if entry}
    return re.compile(rf"\b(?:{'|'.join(sorted(names | entries))})")


def spelled_keys(root, path, pattern):
    """Lines of the strings that spell a key of case files."""
    if path.parts[0] == "cases":
        return
    text = tree.DIRECTIVE.sub(lambda m: tree.blank(m[0]), (root / path).read_text(encoding="utf-8"))
    for literal in tree.TOKENS.finditer(text):
        if not literal[0].startswith("/"):
            for key in pattern.finditer(literal[0]):
                yield text.count("\n", 0, literal.start() + key.start()) + 1


def check(root):
    paths = tree.cpp(root)
    problems = [problem for path in paths for problem in catches(root, path)]
    unnamed = [f"{path}:{line}" for path in paths for line in docstrings(root, path)]
    if len(unnamed) > DOCSTRINGS:
        words = ", ".join(f'"{word}"' for word in UNNAMED)
        problems.append(f"{unnamed[-1]}: {len(unnamed)} docstrings begin with one of {words}, {DOCSTRINGS} are allowed: "
                        "begin with a verb or a noun that names the subject")
    numbered = [f"{path}:{line}" for path in paths for line in dof_arithmetic(root, path)]
    if len(numbered) > DOF_ARITHMETIC:
        problems.append(f"{numbered[-1]}: {len(numbered)} lines compute degrees of freedom, {DOF_ARITHMETIC} are allowed: "
                        f"use the functions of {NUMBERING[0]}")
    sized = [f"{path}:{line}" for path in paths for line in literal_sizes(root, path)]
    if len(sized) > LITERAL_SIZES:
        problems.append(f"{sized[-1]}: {len(sized)} lines write the unknowns of a point as 3, {LITERAL_SIZES} are allowed: "
                        "use unknowns_per_point, zero_state(), zero_forces() or no_state()")
    pattern = key_pattern(root)
    spelled = [f"{path}:{line}" for path in paths for line in spelled_keys(root, path, pattern)]
    if len(spelled) > SPELLED_KEYS:
        problems.append(f"{spelled[-1]}: {len(spelled)} strings below cases spell a key, {SPELLED_KEYS} are allowed: "
                        "name the setting in backticks, which with_keys() of cases/input/problems.hpp replaces")
    return problems, (f"{len(paths)} files catch nothing in silence; {len(unnamed)} of {DOCSTRINGS} docstrings that name no subject; "
                      f"{len(numbered)} of {DOF_ARITHMETIC} lines of dof arithmetic; "
                      f"{len(sized)} of {LITERAL_SIZES} lines with a literal size; "
                      f"{len(spelled)} of {SPELLED_KEYS} keys spelled below cases")
