"""Rules of the text of sources: no `catch` without a body, docstrings that name their subject."""
import re

import tree

EMPTY = re.compile(r"\bcatch\s*\([^)]*\)\s*\{\s*\}")
UNNAMED = ("Of", "Those", "What", "The same", "How")  # begin a docstring that names no subject
DOCSTRINGS = 0                                        # of these are allowed


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


def check(root):
    paths = tree.cpp(root)
    problems = [problem for path in paths for problem in catches(root, path)]
    unnamed = [f"{path}:{line}" for path in paths for line in docstrings(root, path)]
    if len(unnamed) > DOCSTRINGS:
        words = ", ".join(f'"{word}"' for word in UNNAMED)
        problems.append(f"{unnamed[-1]}: {len(unnamed)} docstrings begin with one of {words}, {DOCSTRINGS} are allowed: "
                        "begin with a verb or a noun that names the subject")
    return problems, f"{len(paths)} files catch nothing in silence; {len(unnamed)} of {DOCSTRINGS} docstrings that name no subject"
