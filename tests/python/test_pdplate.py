"""The Python module against the program: the same cases give the same numbers, to the last digit, and write nothing.

PDPLATE_PROGRAM: the program; PYTHONPATH: where the module is."""
import concurrent.futures
import copy
import csv
import importlib.util
import json
import multiprocessing
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zipfile

import numpy as np
import pdplate

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["PDPLATE_PROGRAM"]
THREADS = 2

PLATE = {
    "title": "Plate with an oblique crack",
    "section": {"young": 1000.0, "poisson": 0.3, "thickness": 0.1, "density": 1.0},
    "geometry": {"outline": {"rectangle": [-1, -1, 1, 1]}, "cracks": [[[-0.3, 0.05], [0.3, -0.05]]]},
    "discretization": {"spacing": 0.05},
    "support": [{"edges": ["bottom", "top"], "kind": "simply_supported"}],
    "load": [{"kind": "pressure", "value": 1.0}],
    "analysis": {"kind": "static"},
    "srif": {"normalize": {"pressure": 1.0, "width": 2.0}, "half_length": 0.3},
    "output": {"probes": {"middle": [0.0, 0.5]}},
}


def changed(**tables):
    case = copy.deepcopy(PLATE)
    for name, table in tables.items():
        if table is None:
            del case[name]
        else:
            case[name] = table
    return case


# the same, pulled along its edges in the plane
PULLED = changed(support=[{"edges": ["bottom"], "kind": "simply_supported", "in_plane": "fixed"},
                          {"edges": ["top"], "kind": "simply_supported"}],
                 load=[{"kind": "pressure", "value": 1.0}, {"kind": "edge_traction", "edges": ["top"], "value": 10.0}])

CASES = {
    "static": (PLATE, {}),
    "loads in the plane": (PULLED, {}),
    "static, bonds": (changed(discretization={"spacing": 0.05, "formulation": "ordinary"}), {}),
    "dynamic": (changed(analysis={"kind": "dynamic", "duration": 0.4}, output={"every": 0.1, "probes": {"tip": [0.3, -0.05]}}), {}),
    "dynamic, bonds": (changed(analysis={"kind": "dynamic", "duration": 0.1},
                               discretization={"spacing": 0.05, "formulation": "ordinary"}), {}),
    "frequencies": (changed(analysis={"kind": "frequencies", "modes": 4}, load=None, srif=None, output=None), {}),
    "growth": (ROOT / "cases/growth/double_torsion.toml", {"discretization.spacing": 0.05, "growth.max_advances": 3}),
    "load cases": (ROOT / "cases/static/glass_canopy.toml", {}),
    "two formulations": (changed(srif={"second_formulation": True}), {}),
}


def without_times(summary):
    """What a second run of the same program gives again."""
    summary = copy.deepcopy(summary)
    for key in ("seconds", "peak_memory_bytes"):
        summary.pop(key)
    for part in summary["scene"]:
        part.pop("time_share")
    for step in summary.get("accuracy", {}).get("path", []):
        step.pop("seconds")
    return summary


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [row[name] for row in rows] for name in rows[0]} if rows else {}


def by_program(case, overrides, folder):
    """The same by the command line: the folder of its results."""
    file = case
    if isinstance(case, dict):
        file = folder / "plate.toml"
        file.write_text("".join(f"{key} = {pdplate._toml(value)}\n" for key, value in case.items()))
    settings = [word for key, value in overrides.items() for word in ("--set", f"{key}={pdplate._toml(value)}")]
    subprocess.run([PROGRAM, "run", file, "--out", folder / "out", "--threads", str(THREADS), "--quiet", *settings], check=True)
    return folder / "out"


class EqualsTheProgram(unittest.TestCase):
    def same_table(self, table, path):
        expected = columns(path)
        self.assertEqual(list(table), list(expected), path.name)
        for name, cells in expected.items():
            for cell, value in zip(cells, table[name], strict=True):
                if isinstance(value, str):
                    self.assertEqual(value, cell)
                elif cell == "":
                    self.assertTrue(value is None or np.isnan(value))
                else:
                    self.assertEqual(value, float(cell), f"{path.name}: {name}")

    def test_same_numbers(self):
        for name, (case, overrides) in CASES.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                out = by_program(case, overrides, pathlib.Path(folder))
                result = pdplate.run(case, overrides, threads=THREADS)
                expected = json.loads((out / "summary.json").read_text())
                self.assertEqual(without_times(result.summary), without_times(expected))
                tables = [path for path in out.glob("*.csv")]
                self.assertTrue(tables)
                self.assertEqual({path.stem for path in tables}, set(result.tables))
                for path in tables:
                    self.same_table(result.tables[path.stem], path)
                self.assertEqual(len(result.frames), len(list(out.glob("fields_*.vtu"))))

    def test_writes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                pdplate.run(PLATE)
                pdplate.run(CASES["two formulations"][0])
            finally:
                os.chdir(before)
            self.assertEqual(os.listdir(folder), [])


class Arrays(unittest.TestCase):
    def test_fields_fit_each_other(self):
        result = pdplate.run(PLATE)
        n = result.summary["points"]
        all_of_them = len(result.area)  # the corners of cells on edges and cracks, without area, come after the points
        self.assertGreaterEqual(all_of_them, n)
        self.assertTrue((result.area[:n] > 0).all() and (result.area[n:] == 0).all())
        self.assertEqual(result.points.shape, (all_of_them, 2))
        self.assertEqual(result.theta.shape, (all_of_them, 2))
        self.assertEqual(result.moments.shape, (all_of_them, 3))
        self.assertEqual(np.abs(result.w[:n]).max(), result.history["max_abs_w"][-1])
        self.assertAlmostEqual(result.area.sum(), 4, delta=1e-9)
        x, y, t = 6 / 0.1**2 * result.moments[:n].T  # stresses of the top face
        np.testing.assert_allclose(result.von_mises[:n], np.sqrt(x * x - x * y + y * y + 3 * t * t), rtol=1e-12)
        self.assertLess(result.triangles.max(initial=0), all_of_them)

    def test_point_symmetry(self):  # the plate is its own image when it is turned by 180 degrees
        result = pdplate.run(PLATE, {"analysis.tolerance": 1e-12, "discretization.refine_tips": False}, fields=False)
        left, right = (next(f for f in result.factors if f["tip"] == tip) for tip in (0, 1))
        for name in ("K1", "K2", "K3"):
            self.assertAlmostEqual(left[name], right[name], delta=2e-6 * abs(left["K1"]))  # measured: 7e-7
        with self.assertRaises(AttributeError):
            result.w
        self.assertEqual(result.frames, [])

    def test_load_cases(self):
        result = pdplate.run(*CASES["load cases"])
        names = [entry["name"] for entry in result.summary["load_cases"]]
        self.assertEqual(list(result.cases), names)
        self.assertEqual(len(result.frames), len(names))
        for name in names:
            expected = result.cases[name]["srif"][0]
            self.assertEqual(result.K(case=name)["K1"].tolist(), [expected["K1"]])
            self.assertEqual(next(f for f in result.factors if f["case"] == name)["K1"], expected["K1"])
        for wrong in ({}, {"case": "none of them"}, {"case": names[0], "tip": 99}):
            with self.assertRaises(ValueError):
                result.K(**wrong)
        with self.assertRaises(ValueError):
            pdplate.run(CASES["frequencies"][0]).K()

    def test_loads_in_the_plane(self):
        result = pdplate.run(PULLED)
        first = result.factors[0]
        self.assertGreater(first["N1"], 0)
        self.assertGreater(first["estimated_error_N1"], 0)
        self.assertEqual(result.K()["N1"], first["N1"])
        self.assertIn("KI_bottom", first["faces"])
        self.assertEqual(result.displacement.shape, result.points.shape)
        self.assertEqual(result.membrane_forces.shape, result.moments.shape)
        self.assertGreater(result.probes["v"][0], 0)
        bent = pdplate.run(PLATE)
        self.assertIsNone(bent.displacement)
        self.assertNotIn("N1", bent.K())
        self.assertNotIn("u", bent.probes)

    def test_motion_and_growth(self):
        motion = pdplate.run(*CASES["dynamic"])
        curve = motion.K(tip=1)
        np.testing.assert_array_equal(curve["time"], motion.history["time"])
        peak = next(p for p in motion.summary["peaks"] if p["quantity"] == "K1" and p["tip"] == 1)
        self.assertEqual(peak["value"], curve["K1"][np.nanargmax(np.abs(curve["K1"]))])
        self.assertGreater(len(motion.frames), 3)
        growth = pdplate.run(*CASES["growth"])
        self.assertEqual(len(growth.growth["advance"]), len(growth.history["time"]))
        self.assertGreater(growth.cracks[0][-1, 0], 1.0)  # it began at 1
        self.assertEqual(pdplate.run(*CASES["frequencies"]).frequencies.shape, (4,))

    def test_linear_in_the_load(self):
        one, two = (pdplate.run(PLATE, {"load[0].value": value}) for value in (1.0, 2.0))
        np.testing.assert_allclose(two.w, 2 * one.w, rtol=1e-6, atol=1e-9 * np.abs(one.w).max())


class Errors(unittest.TestCase):
    def test_all_problems_together(self):
        wrong = changed(section={"young": 1000.0, "poisson": 0.7, "thickness": 0.1}, analysis={"kind": "sttic"})
        for function in (pdplate.run, pdplate.check):
            with self.assertRaises(pdplate.CaseError) as caught:
                function(wrong)
            keys = [key for _, key, _ in caught.exception.problems]
            self.assertIn("section.poisson", keys)
            self.assertIn("analysis.kind", keys)
            self.assertIn("did you mean 'static'", str(caught.exception))
            self.assertIsInstance(caught.exception, ValueError)

    def test_overrides(self):
        finer = pdplate.run(PLATE, {"discretization.spacing": 0.04, "srif.normalize": None, "srif.half_length": None}, fields=False)
        self.assertGreater(finer.summary["points"], pdplate.run(PLATE, fields=False).summary["points"])
        self.assertIsNone(finer.factors[0].get("F1"))
        with self.assertRaises(pdplate.CaseError):
            pdplate.run(PLATE, {"section.mass": 1.0})

    def test_no_such_file_and_no_such_value(self):
        with self.assertRaises(pdplate.CaseError):
            pdplate.run("no_such_case.toml")
        with self.assertRaises(TypeError):
            pdplate.run(changed(section={"young": object()}))

    def test_numbers_that_fail(self):
        with self.assertRaises(pdplate.NumericalError) as caught:
            pdplate.run(changed(analysis={"kind": "static", "method": "cg", "max_iterations": 1, "preconditioner": "diagonal"}))
        self.assertIn("failed", caught.exception.result.summary["outcome"])


def K1_of(poisson):
    return pdplate.run(PLATE, {"section.poisson": poisson}, fields=False).factors[0]["K1"]


class Processes(unittest.TestCase):
    """Children of multiprocessing by fork, the default of Linux, after a run in the parent: they waited for ever."""

    def test_forked_children_run(self):
        with multiprocessing.get_context("fork").Pool(2) as pool:
            fresh = pool.map_async(K1_of, [0.2, 0.3]).get(timeout=120)
        before = [K1_of(0.2), K1_of(0.3)]
        self.assertEqual(fresh, before)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.map_async(K1_of, [0.2, 0.3]).get(timeout=120), before)
            self.assertIn("memory", pool.apply_async(pdplate.check, [PLATE]).get(timeout=120))

    def test_errors_of_workers_arrive(self):
        with multiprocessing.get_context("fork").Pool(2) as pool:
            with self.assertRaises(pdplate.CaseError) as caught:
                pool.map_async(K1_of, [0.3, 0.7]).get(timeout=120)
            self.assertEqual([key for _, key, _ in caught.exception.problems], ["section.poisson"])
        with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as pool:
            wrong, right = pool.submit(K1_of, 0.7), pool.submit(K1_of, 0.3)
            with self.assertRaises(pdplate.CaseError):
                wrong.result(timeout=120)
            self.assertEqual(right.result(timeout=120), K1_of(0.3))

    def test_errors_go_through_pickle(self):
        result = pdplate.run(PLATE)
        for error in (pdplate.CaseError("two words", [("a", "b", "c")]), pdplate.NumericalError("three", result)):
            again = pickle.loads(pickle.dumps(error))
            self.assertEqual((type(again), str(again)), (type(error), str(error)))
        self.assertEqual(again.result.summary, result.summary)

    def test_interrupted_at_once(self):
        code = ("import pdplate, sys, test_pdplate as t; print('begins', flush=True); "
                "pdplate.run(t.PLATE, {'analysis.kind': 'frequencies', 'discretization.spacing': 0.006, 'load': None, 'srif': None, 'output': None})")
        child = subprocess.Popen([sys.executable, "-c", code], cwd=pathlib.Path(__file__).parent, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True)
        child.stdout.readline()
        time.sleep(1)
        child.send_signal(signal.SIGINT)
        start = time.monotonic()
        said = child.communicate(timeout=120)[1]
        self.assertIn("KeyboardInterrupt", said)
        self.assertLess(time.monotonic() - start, 30)


class Module(unittest.TestCase):
    def test_keys_are_the_table_of_the_program(self):
        names = {key["name"] for key in pdplate.keys()}
        printed = subprocess.run([PROGRAM, "keys"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(names, {line.split()[0] for line in printed.splitlines() if line and not line.startswith(" ")})
        self.assertTrue(all("spacing" in key["name"] for key in pdplate.keys("spacing")))

    def test_check_and_version(self):
        self.assertIn("points", pdplate.check(PLATE))
        version = subprocess.run([PROGRAM, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(version, f"pdplate {pdplate.__version__}, kernels {pdplate.kernels}\n")

    def test_others_run_on(self):
        thread = threading.Thread(target=pdplate.run, args=(PLATE, {"discretization.spacing": 0.02}))
        turns = 0
        thread.start()
        while thread.is_alive():
            time.sleep(0.001)
            turns += 1
        self.assertGreater(turns, 5)  # 1 where the run kept the interpreter's lock

    def test_wheel(self):
        wheels = list(pathlib.Path(pdplate.__file__).parents[1].glob("pdplate-*.whl"))
        self.assertEqual(len(wheels), 1)
        script = "import pdplate, sys; print(pdplate.__file__); print(pdplate.run(eval(sys.argv[1])).factors[0]['K1'])"
        with tempfile.TemporaryDirectory() as folder:
            with zipfile.ZipFile(wheels[0]) as wheel:
                wheel.extractall(folder)
                listed = [name for name in wheel.namelist() if name.endswith("RECORD")]
                self.assertEqual(len(wheel.read(listed[0]).decode().splitlines()), len(wheel.namelist()))
            environment = dict(os.environ, PYTHONPATH=folder)
            done = subprocess.run([sys.executable, "-B", "-c", script, repr(PLATE)], env=environment, text=True, capture_output=True, check=True)
            place, K1 = done.stdout.split()
            self.assertTrue(place.startswith(folder))
        self.assertEqual(float(K1), float(pdplate.run(PLATE).factors[0]["K1"]))

    def test_example(self):
        spec = importlib.util.spec_from_file_location("crack_lengths", ROOT / "cases/python/crack_lengths.py")
        example = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(example)
        rows = example.sweep([0.4, 0.8], 0.05)
        self.assertLess(rows[0][1], rows[1][1])  # the longer crack has the larger K1
        if importlib.util.find_spec("matplotlib"):
            with tempfile.TemporaryDirectory() as folder:
                plot = pathlib.Path(folder) / "plot.png"
                example.draw(rows, plot)
                self.assertEqual(plot.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    sys.exit(unittest.main(verbosity=2))
