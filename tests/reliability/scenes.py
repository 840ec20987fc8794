"""What the tests of reliability share: scenes, and how the files of two runs are compared. Needs h5py."""
import filecmp
import json
import os
import pathlib

import h5py

CASES = pathlib.Path(__file__).resolve().parent.parent.parent / "cases"
OF_TIME = {"seconds", "peak_memory_bytes", "scene"}

# name, case, whether checkpoints are kept, overrides; fields are written in both forms
SCENES = [
    ("motion, bonds", "dynamic/clamped_central_crack", True, ["discretization.spacing=0.04", "output.every=0.001"]),
    ("motion, galerkin", "dynamic/clamped_central_crack", True,
     ["discretization.spacing=0.04", "discretization.formulation=galerkin", "analysis.method=central_difference",
      "output.every=0.001"]),
    ("motion, lanczos", "dynamic/clamped_central_crack", False,
     ["discretization.spacing=0.04", "discretization.formulation=galerkin", "analysis.method=lanczos", "output.every=0.001"]),
    ("static", "static/central_crack_pressure", False, ["discretization.spacing=0.02"]),
    ("frequencies", "dynamic/frequencies_clamped_central_crack", False, ["discretization.spacing=0.05"]),
    ("bonds that break in motion", "growth/pressure_pulse", True, ["discretization.spacing=0.025"]),
    ("a tip that runs", "growth/running_crack", True, ["discretization.spacing=0.05"]),
    ("tips that run", "growth/hole_running_crack", True, ["discretization.spacing=0.025"]),
    ("tips that grow, galerkin", "growth/inclined_crack", True, ["discretization.spacing=0.04", "growth.max_advances=8"]),
    ("tips that grow, then run", "growth/edge_crack_moment", True,
     ["section.density=1", "discretization.spacing=0.03", "discretization.formulation=ordinary", 'growth.unstable="move"',
      "growth.duration=2", "growth.control=load", "load[0].value=10"]),
    ("motion in both formulations", "dynamic/clamped_central_crack", True,
     ["discretization.spacing=0.05", "srif.second_formulation=true", "analysis.duration=0.003"]),
    ("bonds that break quasi-statically", "growth/breaking_strip", True, ["discretization.spacing=0.05"]),
]

# What plates have beside: small inputs of the tests. The motions and the growth are killed, too, and take longer.
INPUTS = "../tests/reliability/inputs/case"
LONGER = ["discretization.spacing=0.03125"]
KEPT = ("moving_ground", "moving_loads", "moving_loads_galerkin", "soil_that_lifts_off_in_motion", "temperature_in_motion", "growth_on_soil")
FEATURES = [(name.replace("_", " "), f"{INPUTS}/{name}", name in KEPT, LONGER if name in KEPT else [])
            for name in (
                "orthotropic", "plies_stiffened", "regions_and_factors", "temperature", "settlements", "supports_inside",
                "soil_that_lifts_off", "supports_that_push", "table_and_level", "load_cases", "surface_nodes", "fictitious_nodes", "oblique_surface_nodes",
                "frequencies_on_springs", *KEPT)]


def command(program, case, overrides):
    settings = [*overrides, "output.checkpoint_every=0.05", 'output.fields=["vtk","hdf5"]']
    return [program, "run", str(CASES / f"{case}.toml"), "--quiet", *(part for one in settings for part in ("--set", one))]


def environment(threads):
    return os.environ | {"OMP_NUM_THREADS": str(threads), "OPENBLAS_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(one) for key, one in value.items() if key not in OF_TIME}
    return [without_times(one) for one in value] if isinstance(value, list) else value


def h5_content(path):
    content = {}
    with h5py.File(path, "r") as file:
        def take(name, node):
            content[name] = {key: str(node.attrs[key]) for key in node.attrs}
            if isinstance(node, h5py.Dataset):
                content[name, "data"] = (node.dtype, node.shape, node[()].tobytes() if node.dtype.kind != "O" else list(node[()]))
        file.visititems(take)
    return content


def differences(peaceful, other):
    """What differs between the files of two runs, but for seconds and memory in summary.json and report.html."""
    names = {path.relative_to(folder).as_posix() for folder in (peaceful, other) for path in folder.rglob("*") if path.is_file()}
    for name in sorted(one for one in names if not one.rpartition("/")[2].startswith("checkpoint")):  # of another turn
        a, b = peaceful / name, other / name
        if not a.exists() or not b.exists():
            yield f"{name}: only in {'the first' if a.exists() else 'the other'} run"
        elif name.endswith("summary.json"):
            before, after = (without_times(json.loads(path.read_text())) for path in (a, b))
            for key in sorted(set(before) | set(after)):
                if before.get(key) != after.get(key):
                    yield f"{name}: {key} is {before.get(key)}, then {after.get(key)}"
        elif name.endswith("state.h5"):
            before, after = h5_content(a), h5_content(b)
            for key in sorted(set(before) | set(after), key=str):
                if before.get(key) != after.get(key):
                    yield f"{name}: {key} differs"
        elif not name.endswith("report.html") and not filecmp.cmp(a, b, shallow=False):
            yield f"{name}: differs"
