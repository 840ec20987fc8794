#!/usr/bin/env python3
"""The fences of the house (HOUSE.md): tests/fences/fences.py includes | lengths | headers | style | format | tidy [BUILD]
One line per violation, 'file:line: what is wrong, what is allowed', and exit code 1; one line where there is none."""
import argparse
import importlib
import pathlib
import sys

FENCES = ("includes", "lengths", "headers", "style", "format", "tidy")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fence", choices=FENCES)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--build", type=pathlib.Path, help="tidy: folder of compile_commands.json, default ROOT/build")
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    fence = importlib.import_module(arguments.fence)
    tree = importlib.import_module("tree")
    try:
        extra = [(arguments.build or root / "build").resolve()] if arguments.fence == "tidy" else []
        problems, clean = fence.check(root, *extra)
    except tree.Empty as nothing:
        problems = [f"{root}:1: {nothing}"]
    except FileNotFoundError as missing:
        problems = [f"{root}:1: {missing.filename} is missing"]
    for problem in problems:
        print(problem)
    print(f"{arguments.fence}: {len(problems)} violations" if problems else f"{arguments.fence}: {clean}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
