#!/usr/bin/env python3
"""Errors of the intensity factors on families of plates, and how well their estimates hold.

    tests/verification/families.py plates build/pdplate FROM TO [--set KEY=VALUE ...]
        random plates of the seeds FROM to TO - 1 against srif.accuracy = 0.002 of the same plates
    tests/verification/families.py places build/pdplate SPACING [--set KEY=VALUE ...]
        the thirty central cracks of Dai et al. 4.1 at nine spacings within 3 % of SPACING, so that tips and crack lie
        anywhere in a cell, against finite elements

Counts of `plates` leave out tips whose reference is not known to 1 %; an error counts less the reference's own.
Needs nothing but Python.
"""
import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

REFERENCES = pathlib.Path(__file__).resolve().parents[2] / "cases" / "references"


def chain(x, y, angle, pieces):
    """Polyline from (x, y): pieces of a length and a turn."""
    points = [(x, y)]
    for length, turn in pieces:
        angle += turn
        points.append((points[-1][0] + length * math.cos(angle), points[-1][1] + length * math.sin(angle)))
    return points


def cracks_of(kind, draw, spacing):
    """Cracks and holes of a square from -1 to 1."""
    angle = draw.uniform(-math.pi, math.pi)
    u = draw.uniform
    if kind == "kink":
        return [chain(u(-0.3, 0), u(-0.3, 0.2), angle, [(u(0.2, 0.4), 0), (u(0.15, 0.35), u(-1.2, 1.2))])], []
    if kind == "short kink":
        return [chain(u(-0.3, 0), u(-0.3, 0.2), angle, [(u(0.3, 0.5), 0), (u(2.5, 8) * spacing, u(-1.2, 1.2))])], []
    if kind == "bends":
        return [chain(u(-0.3, 0), u(-0.2, 0.2), angle, [(u(0.12, 0.2), u(-0.6, 0.6)) for _ in range(4)])], []
    if kind == "edge":
        return [chain(-1.0, u(-0.4, 0.4), u(-0.6, 0.6), [(u(0.3, 0.8), 0)])], []
    if kind == "hole":
        radius = u(0.12, 0.25)
        return [chain(radius * math.cos(angle), radius * math.sin(angle), angle, [(u(0.15, 0.4), 0)])], [(0, 0, radius)]
    if kind == "three":
        return [chain(x, u(-0.3, 0.3), u(-0.8, 0.8), [(0.35, 0)]) for x in (-0.62, -0.15, 0.32)], []
    return [chain(u(-0.3, 0), u(-0.3, 0.3), angle, [(u(0.25, 0.6), 0)])], []


def load_of(kind, cracks, thickness, draw):
    """Text of the load, and its name."""
    u = draw.uniform
    (x0, y0), (x1, y1) = cracks[0][0], cracks[0][1]
    if kind == "line":
        x, y, turn = (x0 + x1) / 2 + u(-0.2, 0.2), (y0 + y1) / 2 + u(-0.2, 0.2), u(-3, 3)
        along = [[x - 0.4 * math.cos(turn), y - 0.4 * math.sin(turn)], [x + 0.3 * math.cos(turn), y + 0.3 * math.sin(turn)]]
        return f'kind = "line_load"\nvalue = 1.0\nalong = {along}', "line"
    if kind == "force":
        away = u(0.3, 2) * min(thickness, 0.12) + 0.01
        turn = math.atan2(y1 - y0, x1 - x0) + u(-2.5, 2.5)
        place = [x1 + away * math.cos(turn), y1 + away * math.sin(turn)]
        return f'kind = "point_force"\nvalue = 1.0\nposition = {place}', "force"
    name = draw.choice(["pressure", "bending", "moments"])
    if name == "pressure":
        return 'kind = "pressure"\nvalue = 1.0', name
    if name == "bending":
        return 'kind = "edge_moment"\nedges = ["bottom", "top"]\nvalue = 1.0', name
    tensor = [u(-1, 1), u(-1, 1), u(-1, 1)]
    return f'kind = "edge_moment"\nedges = ["left", "right", "bottom", "top"]\ntensor = {tensor}', name


def support_of(kind, load, draw):
    if load == "moments":
        return 'kind = "pinned"\npoints = [[-0.93, -0.91], [0.92, -0.94], [-0.9, 0.93]]'
    how = "simply_supported" if load == "bending" else draw.choice(["clamped", "simply_supported"])
    edges = ["bottom", "top"]
    if load != "bending" and draw.random() < 0.5:
        edges = ["right", "bottom", "top"] if kind == "edge" else ["left", "right", "bottom", "top"]
    return f'kind = "{how}"\nedges = {json.dumps(edges)}'


def plate(seed):
    """A random plate: its kind, thickness, spacing, Poisson's ratio and case file."""
    draw = random.Random(seed)
    kind = draw.choice(["kink", "short kink", "bends", "edge", "hole", "three", "line", "force", "straight", "straight"])
    spacing = draw.choice([0.0125, 0.016, 0.02])
    thickness = math.exp(draw.uniform(math.log(0.012), math.log(0.5)))
    poisson = draw.choice([0.3] * 5 + [0.0, 0.45, -0.2, -0.5])
    cracks, holes = cracks_of(kind, draw, spacing)
    load, name = load_of(kind, cracks, thickness, draw)
    text = case(thickness, poisson, holes, cracks, spacing, support_of(kind, name, draw), load)
    return kind, thickness, spacing, poisson, text


def case(thickness, poisson, holes, cracks, spacing, support, load):
    """A case file of a square plate from -1 to 1."""
    circles = ", ".join(f"{{ circle = {list(hole)} }}" for hole in holes)
    return f"""title = "square"
[section]
young = 1000.0
poisson = {poisson}
thickness = {thickness:.5g}
[geometry]
outline = {{ rectangle = [-1.0, -1.0, 1.0, 1.0] }}
holes = [{circles}]
cracks = {json.dumps(cracks)}
[discretization]
spacing = {spacing}
[[support]]
{support}
[[load]]
{load}
[analysis]
kind = "static"
[srif]
[output]
fields = []
report = false
"""


def run(program, text, settings):
    """summary.json of a case, or nothing where it is refused."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder) / "case.toml"
        case.write_text(text)
        command = [program, "run", str(case), "--out", folder + "/out", "--quiet"]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
        if done.returncode != 0:
            print("exit code", done.returncode, done.stderr.strip().splitlines()[-1:], file=sys.stderr)
            return None
        return json.loads((pathlib.Path(folder) / "out" / "summary.json").read_text())


def recommended(summary):
    first = {}
    for entry in summary["srif"]:
        first.setdefault(entry["tip"], entry)
    return first


def compare_plate(seed, program, settings):
    """Rows of factor, error, estimate and the reference's error, in percent of the largest factor."""
    kind, thickness, spacing, poisson, text = plate(seed)
    reference = run(program, text, ["srif.accuracy=0.002", "srif.accuracy_seconds=40"])
    found = run(program, text, settings)
    if reference is None or found is None:
        return []
    rows = []
    tips = recommended(reference)
    for tip, own in recommended(found).items():
        right = tips.get(tip)
        scale = [1, 1, thickness]
        names = ["K1", "K2", "K3"]
        if right is None or right["method"] != "refinement" or None in [right[name] for name in names]:
            continue
        largest = max(abs(right[name]) * s for name, s in zip(names, scale))
        doubt = [right["estimated_error_" + name] * s / largest for name, s in zip(names, scale)]
        if max(doubt) > 0.01:
            continue
        for name, s, unsure in zip(names, scale, doubt):
            error = None if own[name] is None else (own[name] - right[name]) * s / largest
            estimate = (own["estimated_error_" + name] or 0) * s / largest
            rows.append((f"{seed} {kind}, h = {thickness / spacing:.1f} spacings, nu = {poisson}, tip {tip}", name,
                         error, estimate, unsure))
    return rows


def plates(program, first, last, settings):
    counts = {name: [0, 0, 0, 0] for name in ("K1", "K2", "K3")}
    ratios, errors = [], []
    for seed in range(first, last):
        for label, name, error, estimate, unsure in compare_plate(seed, program, settings):
            if error is None:
                counts[name][3] += 1
                continue
            beyond = max(0, abs(error) - unsure) / estimate
            counts[name][0 if beyond <= 1 else 1 if beyond <= 2 else 2] += 1
            ratios.append(estimate / max(abs(error), 1e-9))
            errors.append(abs(error))
            if beyond > 1:
                print(f"{label}: {name} {100 * error:.2f} %, estimate {100 * estimate:.2f} %, reference +-{100 * unsure:.2f} %")
    for name, (inside, outside, beyond, none) in counts.items():
        print(f"{name}: inside {inside}, outside {outside}, beyond twice {beyond}, not resolved {none}")
    ratios.sort()
    errors.sort()
    print(f"estimate over error, median {ratios[len(ratios) // 2]:.2f}; "
          f"error: median {100 * errors[len(errors) // 2]:.2f} %, nine tenths below {100 * errors[len(errors) * 9 // 10]:.2f} %, "
          f"largest {100 * errors[-1]:.2f} %")


HELD = 'kind = "simply_supported"\nedges = ["bottom", "top"]'
LOADS = {"pressure": 'kind = "pressure"\nvalue = 1.0',
         "bending": 'kind = "edge_moment"\nedges = ["bottom", "top"]\nvalue = 1.0'}


def references():
    with open(REFERENCES / "static_summary.csv", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [row for row in rows if row["W_2h"] in ("2", "6", "10") and row["support"] == "soft" and row["nu"] == "0.3"]


def places(program, spacing, settings):
    largest, outside = 0, 0
    for row in references():
        a, errors = float(row["two_a_over_W"]), []
        for step in range(-4, 5):
            text = case(float(row["h"]), 0.3, [], [[(-a, 0.0), (a, 0.0)]], spacing * (1 + 0.0075 * step), HELD,
                        LOADS[row["load"]])
            summary = run(program, text, settings)
            if summary is None:
                continue
            for entry in recommended(summary).values():
                error = entry["K1"] / float(row["K1"]) - 1
                errors.append(abs(error))
                outside += abs(error) > entry["estimated_error"] + float(row["est_rel_error"])
        print(f"W/2h = {row['W_2h']}, 2a/W = {a}, {row['load']}: {100 * min(errors):.2f} to {100 * max(errors):.2f} %", flush=True)
        largest = max(largest, *errors)
    print(f"largest of all {100 * largest:.2f} %, outside the estimate {outside}")


if __name__ == "__main__":
    arguments = [argument for argument in sys.argv[1:] if argument != "--set" and "=" not in argument]
    given = [argument for argument in sys.argv[1:] if "=" in argument]
    if len(arguments) == 4 and arguments[0] == "plates":
        plates(arguments[1], int(arguments[2]), int(arguments[3]), given)
    elif len(arguments) == 3 and arguments[0] == "places":
        places(arguments[1], float(arguments[2]), given)
    else:
        sys.exit(__doc__)
