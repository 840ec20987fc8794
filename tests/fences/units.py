"""Several sources put into one, so that a tool reads Eigen and CGAL once for all of them."""
import collections
import re

import functions
import tree

ACCESSED = re.compile(r"(?:\.|->)\s*([A-Za-z_]\w*)")


class Source:
    """A source, its file-local names, and which of these may be given another name: not those of members declared here."""

    def __init__(self, root, path, headers):
        self.path, self.headers = path, headers
        self.text = (root / path).read_text(encoding="utf-8")
        reader = functions.Reader(self.text)
        self.names = reader.names
        self.renamable = self.names - (set(ACCESSED.findall(tree.code(self.text))) & reader.members)

    def renamed(self, names, number):
        """The text with these names made this source's own, but for members of that name."""
        if not names:
            return self.text
        word = re.compile(r"(?<![\w.:])(?<!->)(" + "|".join(sorted(names)) + r")(?!\w)")
        return "\n".join(line if line.lstrip().startswith("#") else word.sub(rf"\1_of_source_{number}", line)
                         for line in self.text.splitlines())


def joined(sources, clashing):
    """One text of several sources, and for each of its lines (source, line). Clashing names get a name per source."""
    lines, origin = [], []
    for number, source in enumerate(sources):
        own = source.renamed(clashing & source.names, number).splitlines()
        lines += own
        origin += [(source.path, i + 1) for i in range(len(own))]
    return "\n".join(lines) + "\n", origin


def clashes(sources, names_of_headers):
    """Names that two of these sources define for themselves, or one of them and a header that only others read."""
    count = collections.Counter(name for source in sources for name in source.names)
    result = {name for name, times in count.items() if times > 1}
    read = collections.Counter(header for source in sources for header in source.headers)
    for header in read:
        for name in names_of_headers[header] & count.keys():
            if any(name in source.names and header not in source.headers for source in sources):
                result.add(name)
    return result


def groups(sources, names_of_headers):
    """Sources that can stand in one text, in as few as are found by putting each into the first that takes it."""
    result = []
    for source in sources:
        for group in result:
            together = group + [source]
            clashing = clashes(together, names_of_headers)
            if all(clashing & one.names <= one.renamable for one in together):
                group.append(source)
                break
        else:
            result.append([source])
    return result
