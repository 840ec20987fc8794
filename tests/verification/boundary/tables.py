"""Tables of README.md by the program: python3 tests/verification/boundary/tables.py build/pdplate factors|times|faces"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.abspath(__file__)) + "/../../.."
PRESSED = """[section]
young = 1000.0
poisson = 0.3
thickness = 0.1
[geometry]
outline = { rectangle = [-1.0, -1.0, 1.0, 1.0] }
[[support]]
kind = "%s"
edges = ["left", "right", "bottom", "top"]
[[load]]
kind = "pressure"
value = 1.0
[analysis]
kind = "static"
[output]
fields = []
probes = { centre = [0.0, 0.0] }
"""


def run(program, case, settings, folder):
    """Seconds of one core that a run takes; None where it fails, with its reason on stderr."""
    command = [program, "run", case, "--quiet", "--threads", "1", "--out", folder]
    for one in settings:
        command += ["--set", one]
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_utime + usage.ru_stime if child.returncode == 0 else None


def rows(path):
    with open(path) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def factors(program, spacing):
    """Errors of K1 of the thirty cases of Dai et al., 4.1, in percent: images and surface nodes."""
    lengths = ["0.1", "0.3", "0.5", "0.7", "0.9"]
    wanted = {(r["load"], r["W_2h"], r["two_a_over_W"]): float(r["K1"])
              for r in rows(f"{ROOT}/cases/references/static_summary.csv") if r["support"] == "soft"}
    methods = ["virtual_crack_extension", "domain_integral"]
    print(f"| load, W/2h, edges; 2a/W = | {' | '.join(lengths)} |\n|---|{'---|' * len(lengths)}", flush=True)
    every = {}
    for load in ["pressure", "bending"]:
        for ratio in ["2", "6", "10"]:
            for edges in ["images", "surface_nodes"]:
                cells = []
                for length in lengths:
                    a = float(length)
                    with tempfile.TemporaryDirectory() as folder:
                        run(program, f"{ROOT}/cases/static/central_crack_{load}.toml",
                            [f"section.thickness={1 / float(ratio)!r}", f"geometry.cracks=[[[{-a},0.0],[{a},0.0]]]",
                             f"srif.half_length={a}", f"discretization.spacing={spacing}",
                             f"discretization.boundary={edges}", "analysis.method=direct", "output.fields=[]"],
                            folder + "/run")
                        found = {r["method"]: float(r["K1"]) for r in rows(folder + "/run/srif.csv") if r["tip"] == "0"}
                    off = [100 * (found[m] / wanted[load, ratio, length] - 1) for m in methods]
                    for method, value in zip(methods, off):
                        every.setdefault((edges, method), []).append(abs(value))
                    cells.append(", ".join(f"{value:+.2f}" for value in off))
                print(f"| {load}, {ratio}, {edges} | {' | '.join(cells)} |", flush=True)
    for (edges, method), values in every.items():
        print(f"{edges}, {method}: largest {max(values):.2f}, mean {sum(values) / len(values):.2f} %")


def times(program):
    """Error of the deflection in the middle of a square under pressure, in percent, and seconds of one core."""
    ways = {"images": ("%s", []), "layers": ("%s_layer", []),
            "surface nodes": ("%s", ["discretization.boundary=surface_nodes", "analysis.method=direct"]),
            "fictitious nodes": ("%s", ["discretization.boundary=fictitious_nodes", "analysis.method=direct"]),
            "Galerkin": ("%s", ["discretization.formulation=galerkin"])}
    exact = {"clamped": 1.32726, "simply_supported_hard": 4.11497}  # 1000 w D / (p L^4): Ritz, Navier
    scale = 1e3 * 1000 * 0.1**3 / (12 * (1 - 0.3**2)) / 2**4
    counts = [21, 41, 81, 121]  # a point lies in the middle
    print(f"| edges, by; points along a side | {' | '.join(map(str, counts))} |\n|---|{'---|' * len(counts)}", flush=True)
    for kind, value in exact.items():
        for name, (support, more) in ways.items():
            cells = []
            for count in counts:
                cells_along = count - 1 if name == "Galerkin" else count  # its points lie on the edges
                with tempfile.TemporaryDirectory() as folder:
                    case = folder + "/case.toml"
                    with open(case, "w") as file:
                        file.write(PRESSED % (support % kind))
                    settings = [f"discretization.spacing={2 / cells_along!r}"]
                    if name != "Galerkin":
                        settings.append("discretization.formulation=ordinary")
                    seconds = run(program, case, settings + more, folder + "/run")
                    if seconds is None:
                        cells.append("-")
                        continue
                    w = float(rows(folder + "/run/probes.csv")[-1]["w"])
                cells.append(f"{100 * (scale * w / value - 1):+.3f} % in {seconds:.2f} s")
            print(f"| {kind}, {name} | {' | '.join(cells)} |", flush=True)


HALF = """[section]
young = 1000.0
poisson = 0.3
thickness = %r
[geometry]
outline = { polygon = [[-1, 0], [%r, 0], [%r, 0], [1, 0], [1, 1], [-1, 1]], edges = ["beside", "face", "beside", "right", "top", "left"] }
[discretization]
formulation = "ordinary"
[[support]]
kind = "symmetry"
edges = ["beside"]
[[support]]
kind = "simply_supported"
edges = ["top"]
[[load]]
%s
[analysis]
kind = "static"
method = "direct"
[output]
fields = []
"""


def energy(folder):
    with open(folder + "/summary.json") as file:
        return json.load(file)["energy"]["strain"]


def faces(program, spacing):
    """Errors of K1 from the energies of two lengths, a spacing longer and shorter on either side, in percent: cracks that sever bonds,
    in the whole plate, and half of it, whose lower edge is the crack's face and a line of symmetry, by images and by surface nodes."""
    lengths = ["0.1", "0.3", "0.5", "0.7"]
    wanted = {(r["load"], r["W_2h"], r["two_a_over_W"]): float(r["K1"])
              for r in rows(f"{ROOT}/cases/references/static_summary.csv") if r["support"] == "soft"}
    loads = {"pressure": 'kind = "pressure"\nvalue = 1.0', "bending": 'kind = "edge_moment"\nedges = ["top"]\nvalue = 1.0'}
    print(f"| load, W/2h, face; 2a/W = | {' | '.join(lengths)} |\n|---|{'---|' * len(lengths)}", flush=True)
    for load in loads:
        for ratio in ["2", "6", "10"]:
            h = 1 / float(ratio)
            for way in ["severed bonds", "images", "surface nodes"]:
                cells = []
                for length in lengths:
                    found = []
                    for a in (float(length) - spacing, float(length) + spacing):
                        with tempfile.TemporaryDirectory() as folder:
                            if way == "severed bonds":
                                case = f"{ROOT}/cases/static/central_crack_{load}.toml"
                                settings = [f"section.thickness={h!r}", f"geometry.cracks=[[[{-a!r},0.0],[{a!r},0.0]]]",
                                            f"srif.half_length={a!r}", "analysis.method=direct", "output.fields=[]"]
                            else:
                                case = folder + "/case.toml"
                                with open(case, "w") as file:
                                    file.write(HALF % (h, -a, a, loads[load]))
                                settings = [f"discretization.boundary={way.replace(' ', '_')}"]
                            run(program, case, settings + [f"discretization.spacing={spacing}"], folder + "/run")
                            found.append(energy(folder + "/run") / (2 if way == "severed bonds" else 1))
                    k1 = (max(found[1] - found[0], 0) / (2 * spacing) * 1000 * h**3 / (12 * math.pi)) ** 0.5
                    cells.append(f"{100 * (k1 / wanted[load, ratio, length] - 1):+.2f}")
                print(f"| {load}, {ratio}, {way} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[2] not in ("factors", "times", "faces"):
        sys.exit(__doc__)
    if sys.argv[2] in ("factors", "faces"):
        (factors if sys.argv[2] == "factors" else faces)(sys.argv[1], float(sys.argv[3]) if len(sys.argv) > 3 else 0.02)
    else:
        times(sys.argv[1])
