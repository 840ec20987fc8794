"""clang-tidy with the checks of .clang-tidy over all sources outside tests/, several at a time in one text (units.py).

What was clean stays so until it, a header that it reaches, the checks or clang-tidy change: BUILD/fences/clean.json."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess

import functions
import includes
import tree
import units

AT_ONCE = 2  # up to 2.2 GB each
KEPT = ("-D", "-I", "-isystem", "-std=")
DIAGNOSTIC = re.compile(r"^(?P<path>[^\s:][^:\n]*):(?P<line>\d+):\d+: (?P<kind>warning|error): (?P<text>.*?)(?: \[(?P<check>[^\]\s]+)\])?$",
                        re.MULTILINE)
RENAMED = re.compile(r"_of_source_\d+")


def flags(root, build):
    """Per source the arguments that say what the text means; not the compiler's precompiled headers and optimisations."""
    path = build / "compile_commands.json"
    if not path.is_file():
        raise tree.Empty(f"no {path}: configure first (cases/build)")
    result = {}
    for entry in json.loads(path.read_text(encoding="utf-8")):
        words, kept = shlex.split(entry.get("command") or shlex.join(entry["arguments"])), []
        for word, following in zip(words, words[1:] + [""]):
            if word in ("-D", "-I", "-isystem"):
                kept.append(word + following if word != "-isystem" else f"{word} {following}")
            elif word.startswith(KEPT) and word != "-isystem":
                kept.append(word)
        for source in sources_of((pathlib.Path(entry["directory"]) / entry["file"]).resolve()):
            if source.is_relative_to(root):
                result[source.relative_to(root)] = kept
    return result


def sources_of(path):
    """A source alone, or the sources that a unit of CMake includes."""
    if path.parent.name != "Unity" or not path.is_file():
        return [path]
    return [pathlib.Path(name) for name in re.findall(r'^#include "(.+)"$', path.read_text(encoding="utf-8"), re.MULTILINE)]


def of_compiler():
    """Where gcc has the headers that clang lacks (omp.h)."""
    found = subprocess.run(["g++", "-print-file-name=include"], capture_output=True, text=True, check=True).stdout.strip()
    return ["-idirafter", found, "-fopenmp", "-w", "-ferror-limit=0", "-Wno-unknown-warning-option"]


class Tidy:
    def __init__(self, root, build, checks=None):
        self.root, self.folder, self.checks = root, build / "fences", checks
        self.folder.mkdir(parents=True, exist_ok=True)
        self.flags = flags(root, build)
        self.reach = includes.Reach(root)
        self.not_read = {}  # source or group: first thing that clang does not understand there although gcc does
        version = subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True, check=True).stdout
        self.common = version.split("Host CPU")[0] + (root / ".clang-tidy").read_text(encoding="utf-8") + "".join(
            path.read_text(encoding="utf-8") for path in sorted(pathlib.Path(__file__).parent.glob("*.py")))

    def source(self, path):
        return units.Source(self.root, path, self.reach.of(path))

    def digest(self, source):
        """Of all that the answer for this source depends on."""
        text = self.common + source.text + " ".join(self.flags[source.path])
        text += "".join((self.root / header).read_text(encoding="utf-8") for header in sorted(source.headers))
        return hashlib.sha256(text.encode()).hexdigest()

    def run(self, name, sources, clashing):
        """clang-tidy over one text: {(file, line, what)} and the sources with errors."""
        text, origin = units.joined(sources, clashing)
        joined = self.folder / f"{name}.cpp"
        joined.write_text(text, encoding="utf-8")
        arguments = dict.fromkeys(word for source in sources for flag in self.flags[source.path] for word in [flag])
        words = [part for flag in arguments for part in flag.split(" ", 1)] + of_compiler()
        command = ["clang-tidy", "--quiet", f"--config-file={self.root / '.clang-tidy'}"]
        if self.checks:
            command.append(f"--checks={self.checks}")
        ran = subprocess.run([*command, str(joined), "--", *words], cwd=self.root, capture_output=True, text=True)
        found, errors = set(), {}
        for match in DIAGNOSTIC.finditer(ran.stdout):
            file, line = pathlib.Path(match["path"]), int(match["line"])
            if file == joined:
                file, line = origin[line - 1]
            elif file.is_absolute() and file.resolve().is_relative_to(self.root):
                file = file.resolve().relative_to(self.root)
            what = RENAMED.sub("", match["text"])
            if match["kind"] == "error" and (match["check"] or "").startswith("clang-diagnostic"):
                errors.setdefault(file, f"{file}:{line}: {what}")
            else:
                found.add((str(file), line, f"{what} [{match['check']}]"))
        if ran.returncode != 0 and not found and not errors:
            raise tree.Empty(f"clang-tidy failed: {(ran.stderr or ran.stdout).strip()[-600:]}")
        return found, errors

    def group(self, name, sources, clashing):
        """As run; what does not stand together, although each source is right, is read alone."""
        found, errors = self.run(name, sources, clashing)
        alone = [source for source in sources if errors.keys() & {source.path, *source.headers}]
        if len(sources) == 1 or not alone:  # errors in headers of libraries: of this clang, whose gcc takes them
            if errors:
                self.not_read[str(sources[0].path) if len(sources) == 1 else name] = next(iter(errors.values()))
            return found
        found = {one for one in found if one[0] not in {str(source.path) for source in alone}}
        for source in alone:
            found |= self.group(f"{name}_{source.path.stem}", [source], set())
        return found


def grouped(tidy, sources):
    """(name, sources, clashing names), the largest first."""
    headers = set().union(*(source.headers for source in sources))
    names_of_headers = {header: functions.read(tidy.root / header).names for header in headers}
    result = []
    for folder in tree.FOLDERS:
        inside = [source for source in sources if source.path.parts[0] == folder]
        for i, group in enumerate(units.groups(inside, names_of_headers)):
            result.append((f"{folder}_{i}", group, units.clashes(group, names_of_headers)))
    return sorted(result, key=lambda group: -sum(len(source.text) for source in group[1]))


def check(root, build, checks=None):
    tidy = Tidy(root, build, checks)
    paths = [path for path in tree.cpp(root) if path.suffix == ".cpp"]
    problems = [f"{path}:1: not in the compile database; configure again (cases/build)" for path in paths if path not in tidy.flags]
    sources = [tidy.source(path) for path in paths if path in tidy.flags]
    memory = tidy.folder / "clean.json"
    clean = json.loads(memory.read_text(encoding="utf-8")) if memory.is_file() and not checks else {}
    digests = {source.path: tidy.digest(source) for source in sources}
    changed = [source for source in sources if clean.get(str(source.path)) != digests[source.path]]
    found = set()
    with concurrent.futures.ThreadPoolExecutor(min(AT_ONCE, os.cpu_count())) as pool:
        for some in pool.map(lambda group: tidy.group(*group), grouped(tidy, changed)):
            found |= some
    for path, why in sorted(tidy.not_read.items()):
        print(f"not read whole by clang-tidy: {path} ({(why or '').split('/')[-1][:120]})")
    problems += [f"{file}:{line}: {what}" for file, line, what in sorted(found)]
    if not checks:
        faulty = {file for file, _, _ in found}
        memory.write_text(json.dumps({str(source.path): digests[source.path] for source in sources
                                      if not faulty & {str(source.path), *map(str, source.headers)}}), encoding="utf-8")
    return problems, f"{len(sources)} sources, {len(changed)} of them new or changed, without a fault"
