"""All C++ as clang-format writes it with the tree's .clang-format."""
import concurrent.futures
import os
import re
import subprocess

import tree

VIOLATION = re.compile(r"^(.+?):(\d+):\d+: error: ", re.MULTILINE)


def of_files(root, paths):
    ran = subprocess.run(["clang-format", "--dry-run", "-Werror", *map(str, paths)], cwd=root, capture_output=True, text=True)
    places = {}
    for path, line in VIOLATION.findall(ran.stderr):
        places.setdefault(path, []).append(int(line))
    if ran.returncode != 0 and not places:
        raise tree.Empty(f"clang-format failed: {ran.stderr.strip()[:400]}")
    return [f"{path}:{min(lines)}: not formatted here and at {len(lines) - 1} more places; put right by: clang-format -i {path}"
            for path, lines in places.items()]


def check(root):
    paths = tree.cpp(root, tests=True)
    if not (root / ".clang-format").is_file():
        raise tree.Empty("no .clang-format")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        problems = [problem for some in pool.map(lambda at: of_files(root, paths[at:at + 20]), range(0, len(paths), 20))
                    for problem in some]
    return problems, f"{len(paths)} files are formatted"
