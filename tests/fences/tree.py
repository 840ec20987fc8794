"""The files of the tree, and C++ text without what is not code."""
import pathlib
import re

FOLDERS = ("geometry", "plate", "post", "fracture", "cases")
OTHER_ENDINGS = {".h", ".hh", ".hxx", ".h++", ".cc", ".cxx", ".c++", ".c", ".inl", ".ipp", ".tpp", ".inc"}


class Empty(Exception):
    """A fence that found nothing to look at has not passed."""


def files(root, folders, endings):
    """Files below these folders, as paths relative to the root, in order."""
    found = [path.relative_to(root) for folder in folders for path in sorted((root / folder).rglob("*"))
             if path.suffix in endings and path.is_file()]
    if not found:
        raise Empty(f"no {' or '.join(endings)} files below {root} in {', '.join(folders)}")
    return found


def cpp(root, tests=False):
    """All sources and headers; every folder of the table must have some."""
    for folder in FOLDERS:
        files(root, [folder], {".cpp", ".hpp"})
    return files(root, FOLDERS + (("tests",) if tests else ()), {".cpp", ".hpp"})


def oddly_named(root):
    """C++ files that would escape the fences by their endings."""
    try:
        return files(root, FOLDERS + ("tests",), OTHER_ENDINGS)
    except Empty:
        return []


TOKENS = re.compile(
    r'//(?:\\\n|[^\n])*|/\*.*?\*/'  # comments
    r'|(?:u8|[uUL])?R"(?P<mark>[^()\\\s]*)\(.*?\)(?P=mark)"'  # raw strings
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*'",  # not 1'000
    re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.MULTILINE)


def blank(text, keep=""):
    """The same number of lines, nothing on them but `keep`."""
    return keep + "\n" * text.count("\n")


def code(text, directives=False):
    """Text without comments, strings and characters empty, line by line where it was; without directives unless asked."""
    text = TOKENS.sub(lambda m: blank(m[0]) or " " if m[0].startswith("/") else blank(m[0], '""' if '"' in m[0][:5] else "''"), text)
    return text if directives else DIRECTIVE.sub(lambda m: blank(m[0]), text)
