"""Functions and file-local names of C++ text, found by matching braces: exact enough for formatted code."""
import dataclasses
import re

import tree

TEMPLATE_HEAD = re.compile(r"\s*(template\s*<|requires\b|\[\[)")
ACCESS = re.compile(r"^(\s*(public|private|protected)\s*:(?!:))+")
SCOPE = re.compile(r"\s*(?:inline\s+)?(namespace\b|extern\s*\"\"\s*$)")
TYPE = re.compile(r"\s*(?:typedef\s+)?(?:class|struct|union|enum(?:\s+(?:class|struct))?)\b(?:\s*alignas\s*\([^)]*\))?\s*([A-Za-z_]\w*)?")
LAMBDA = re.compile(r"=\s*\[[^\]]*\]\s*(?:<|\(|mutable\b|noexcept\b|->|$)")
MEMBER_INITIALISER = re.compile(r"\)\s*(?:noexcept(?:\s*\([^)]*\))?\s*)?:(?!:)")
NAME = re.compile(r"((?:[A-Za-z_]\w*\s*(?:<[^()]*>)?\s*::\s*)*(?:~\s*)?[A-Za-z_]\w*|operator\s*(?:\(\s*\)|[^\s\w(]+|[\w:\s<>*&]+?))\s*$")


@dataclasses.dataclass
class Function:
    name: str
    first: int  # line of the signature
    last: int   # line of the closing brace

    @property
    def lines(self):
        return self.last - self.first + 1


def closing(text, start, opens, closes):
    """Position of what closes text[start]."""
    depth = 0
    for i in range(start, len(text)):
        if text[i] == opens:
            depth += 1
        elif text[i] == closes:
            depth -= 1
            if depth == 0:
                return i
    return len(text) - 1


def bare(head):
    """A declaration's head without access specifiers, template lists and attributes before it."""
    head = ACCESS.sub("", head)
    while match := TEMPLATE_HEAD.match(head):
        if match[1].startswith("requires"):
            return re.sub(r"^\s*requires\s*(\([^)]*\)|[\w:]+\s*<[^>]*>)?", "", head)
        opens, closes = ("<", ">") if match[1].startswith("template") else ("[", "]")
        head = head[closing(head, head.index(opens), opens, closes) + 1:]
    return head


def parameters(head):
    """Position of the parenthesis that opens the parameters of a function, or None."""
    depth = 0
    for i, c in enumerate(head):
        if c == "<" and not re.search(r"\boperator\s*<*$", head[:i]):
            depth += 1
        elif c == ">" and depth > 0 and head[i - 1] != "-":
            depth -= 1
        elif c == "(" and depth == 0 and not re.search(r"\b(operator\s*|alignas\s*|decltype\s*|__attribute__\s*)$", head[:i]):
            return i
    return None


def kind(head):
    """What a brace after this head opens: 'namespace', 'type', 'function' or 'values'; and its name."""
    text = bare(head)
    if SCOPE.match(text):
        return "namespace", text.split("namespace")[-1].strip()
    if text.count("(") > text.count(")"):
        return "values", ""  # of a default argument
    match = TYPE.match(text)
    if match and not re.match(r"\s*(?:class|struct|union|enum)\s+[\w:]+\s*[&*]*\s+[&*]*[\w:]+\s*\(", text):
        return "type", match[1] or ""
    if LAMBDA.search(text):
        return "function", NAME.search(text[:text.index("=")])[1] if NAME.search(text[:text.index("=")]) else "lambda"
    at = parameters(text)
    if at is None or "=" in re.sub(r"operator\s*[=!<>+\-*/|&^%]+", "", text[:at]):
        return "values", ""
    if MEMBER_INITIALISER.search(text) and re.search(r"[\w>]\s*$", text):
        return "values", ""  # of a member: the body comes later
    name = NAME.search(text[:at])
    return "function", re.sub(r"\s+", " ", name[1]).strip() if name else "?"


def variable(head):
    """The name of a variable, alias or constant declared at the scope of a namespace, or None."""
    text = bare(head).strip()
    if re.match(r"(friend|static_assert|extern|template|namespace)\b", text):
        return None
    if text.startswith("using"):
        match = re.match(r"using\s+(\w+)\s*=", text)
        return match[1] if match else None
    if parameters(text.split("=")[0]) is not None:
        return None  # declares a function
    match = re.search(r"([A-Za-z_]\w*)\s*(?:\[[^\]]*\]\s*)*$", re.split(r"[={]", text)[0])
    return match[1] if match and " " in text else None


class Reader:
    """Walks over the scopes of one file once."""

    def __init__(self, text):
        self.text = tree.code(text)
        self.functions = []
        self.names = set()  # defined at namespace scope
        self.members = set()
        self.line_of = [0]
        for c in self.text:
            self.line_of.append(self.line_of[-1] + (c == "\n"))
        self.scope(0, "file")

    def line(self, position):
        return self.line_of[position] + 1

    def declared(self, name, at_namespace):
        if name:
            (self.names if at_namespace else self.members).add(name)

    def scope(self, i, within):
        """Reads from i to the brace that closes this scope; the position after it."""
        text, begin = self.text, i
        at_namespace = within != "type"
        while i < len(text):
            c = text[i]
            if c == ";":
                self.declared(variable(text[begin:i]), at_namespace)
                begin = i + 1
            elif c == "}":
                return i + 1
            elif c == "{":
                what, name = kind(text[begin:i])
                if what == "values":
                    i = closing(text, i, "{", "}") + 1
                    continue
                if what == "function":
                    end = closing(text, i, "{", "}")
                    self.function(name, begin, end, at_namespace)
                    i = end + 1
                elif what == "namespace":
                    i = self.scope(i + 1, what)
                else:
                    self.declared(name, at_namespace)
                    i = self.scope(i + 1, "type")
                begin = i
                continue
            i += 1
        return i

    def function(self, name, begin, end, at_namespace):
        head = ACCESS.match(self.text[begin:end])
        begin += head.end() if head else 0
        first = begin + len(self.text[begin:]) - len(self.text[begin:].lstrip())
        self.functions.append(Function(name, self.line(first), self.line(end)))
        if "::" not in name and not name.startswith("operator"):
            self.declared(name, at_namespace)


def read(path):
    return Reader(path.read_text(encoding="utf-8"))
