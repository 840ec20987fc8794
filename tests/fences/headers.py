"""Every case file and study says at its top where it is from, what is expected, how exactly, and what it costs."""
import re

import tree

KEYS = ("source", "expected", "tolerance", "cost")


def header(text):
    """The comment at the top, without its hashes."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line[1:].strip())
    return lines


def of_file(root, path):
    lines = header((root / path).read_text(encoding="utf-8"))
    if not lines:
        yield f"{path}:1: no comment at the top; it must have '# {': ...', '# '.join(KEYS)}: ...'"
        return
    for key in KEYS:
        if not any(re.match(rf"{key}: *\S", line) for line in lines):
            yield f"{path}:{len(lines)}: the comment at the top lacks '# {key}: ...'; it must have {', '.join(KEYS)}"


def check(root):
    paths = [path for path in tree.files(root, ["cases"], {".toml"}) if path.parts[1] != "references"]
    problems = [problem for path in paths for problem in of_file(root, path)]
    return problems, f"{len(paths)} case files and studies have their comment at the top"
