"""PDPlate from Python: cracked Mindlin plates in peridynamics, with results as numpy arrays and no files.

    import pdplate
    result = pdplate.run("plate.toml", overrides={"discretization.spacing": 0.01})
    result = pdplate.run({"section": {"young": 1000.0, ...}, "geometry": {...}, ...})
    result.factors[0]["K1"], result.w, result.history["time"]

A case is the path of a case file, or a dict of the same form: pdplate.keys() has the table of its keys. Overrides map dotted keys
to values; None takes a key out. A case that is wrong raises CaseError, with all its problems, before anything is computed; numbers
that fail raise NumericalError, whose `result` holds what was good until then. Other threads run on during a computation."""
import json as _json
import os as _os

import numpy as _np

_os.environ.setdefault("OMP_WAIT_POLICY", "passive")  # read as OpenMP is loaded: threads that wait sleep
from pdplate import _door  # noqa: E402

__version__, kernels = _door.version()  # of the program; the instruction set that the processor was found to have
__all__ = ["run", "check", "keys", "Result", "CaseError", "NumericalError", "kernels"]


class CaseError(ValueError):
    """What is wrong with a case; `problems`: a list of (place, key, what)."""

    def __init__(self, message, problems):
        super().__init__(message)
        self.problems = problems

    def __reduce__(self):  # to other processes, as of a pool
        return type(self), (str(self), self.problems)


class NumericalError(ArithmeticError):
    """Numbers that failed; `result`: what was good until then."""

    def __init__(self, message, result):
        super().__init__(message)
        self.result = result

    def __reduce__(self):
        return type(self), (str(self), self.result)


def _cells(column):
    """Numbers with nan for what is empty, or a list where there are words."""
    return column if any(isinstance(cell, str) for cell in column) else _np.array(column, dtype=float)


class Frame:
    """The fields of one instant, advance or mode: `time`, `points` (n, 2), `w` (n,), `theta` (n, 2), `moments` (n, 3: Mxx, Myy, Mxy),
    `shear` (n, 2: Qx, Qy), `von_mises` (top face; with loads in the plane the larger of both faces), `damage`, `cut`, `area`;
    with loads in the plane `displacement` (n, 2: u, v) and `membrane_forces` (n, 3: Nxx, Nyy, Nxy), otherwise None; cells `quads`
    (., 4) and `triangles` (., 3). After the points stand the corners of cells on edges and cracks, where `area` is 0."""

    def __init__(self, raw):
        self.time, self.points, self.w, self.theta = raw["time"], raw["x"], raw["w"], raw["theta"]
        self.moments, self.shear, self.von_mises = raw["moments"], raw["shear"], raw["von_mises"]
        self.damage, self.cut, self.area = raw["damage"], raw["cut"], raw["area"]
        self.displacement, self.membrane_forces = raw.get("displacement"), raw.get("membrane_forces")
        self.quads, self.triangles = raw["quads"], raw["triangles"]


class Result:
    """What a run gives.

    summary      as summary.json: a dict
    factors      its entries of `srif`: dicts, the recommended method of each tip first, with K1, K2, K3, their estimated errors and
                 `faces`; with loads in the plane N1 and N2 as well. With load cases those of all, the name of each in `case`
    cases        name of a load case or a combination -> its entry of `load_cases` in summary.json; in the order of `frames`
    tables       name -> column -> array, as the .csv files: history, srif, probes, frequencies, growth, tips, cracks; nan where a cell
                 is empty; columns of words are lists
    frames       a list of Frame; points, w, theta, moments, shear, von_mises, damage, displacement, membrane_forces are those of the
                 last one
    cracks       with growth, the cracks at the end: arrays (n, 2)
    parts        further runs: "motion" after a growth, or the other formulation
    resolved     the whole case with its defaults, as TOML"""

    def __init__(self, raw):
        self.summary = _json.loads(raw["summary"]) if raw["summary"] else {}
        self.cases = {entry["name"]: entry for entry in self.summary.get("load_cases", [])}
        self.factors = self.summary.get("srif", []) + [dict(factor, case=name) for name, entry in self.cases.items()
                                                       for factor in entry.get("srif", [])]
        self.tables = {name: {column: _cells([row[i] for row in rows]) for i, column in enumerate(columns)}
                       for name, (columns, rows) in raw["tables"].items()}
        self.cracks, self.resolved = raw["cracks"], raw["resolved"]
        self.frames = [Frame(frame) for frame in raw["frames"]]
        self.parts = {name: Result(part) for name, part in raw["parts"].items()}

    def __getattr__(self, name):
        if name in ("points", "w", "theta", "moments", "shear", "von_mises", "damage", "cut", "area", "displacement", "membrane_forces",
                    "quads", "triangles"):
            if not self.frames:
                raise AttributeError(f"{name}: the run kept no fields")
            return getattr(self.frames[-1], name)
        if name in ("history", "probes", "growth", "tips"):
            return self.tables.get(name)
        raise AttributeError(name)

    @property
    def frequencies(self):
        """Of the modes [1/time], ascending."""
        return self.tables["frequencies"]["frequency"] if "frequencies" in self.tables else _np.array([])

    def K(self, tip=0, method=None, case=None):
        """Factors of a tip in time, over the advances of a growth, or of a load case, by its recommended method: arrays time, K1, K2,
        K3, estimated_error; with loads in the plane N1 and N2. ValueError where there are none, or load cases and `case` names none."""
        if (case is None and self.cases) or (case is not None and case not in self.cases):
            raise ValueError(f"case is {case!r}, must be one of {list(self.cases)}")
        methods = [entry["method"] for entry in self.factors if entry["tip"] == tip and entry.get("case") == case]
        if not methods:
            raise ValueError(f"tip {tip} has no factors")
        table = self.tables["srif"]
        rows = (table["tip"] == tip) & (_np.array(table["method"]) == (method or methods[0]))
        if case is not None:
            rows &= _np.array(table["case"]) == case
        return {name: table[name][rows] for name in ("time", "K1", "K2", "K3", "estimated_error", "N1", "N2") if name in table}

    def __repr__(self):
        return f"<pdplate.Result {self.summary.get('title', '')!r}: {self.summary.get('outcome', 'failed')}>"


def _toml(value):
    """A value as TOML, in one line."""
    if isinstance(value, (bool, _np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return _json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (int, _np.integer)):
        return str(int(value))
    if isinstance(value, (float, _np.floating)):
        return repr(float(value))
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_toml(str(key))} = {_toml(one)}" for key, one in value.items()) + "}"
    if isinstance(value, (list, tuple, _np.ndarray)):
        return "[" + ", ".join(_toml(one) for one in value) + "]"
    raise TypeError(f"{value!r}: a case is made of numbers, words, booleans, lists and dicts")


def _source(case, overrides):
    settings = [f"-{key}" if value is None else f"{key}={_toml(value)}" for key, value in (overrides or {}).items()]
    if isinstance(case, dict):
        return "", "".join(f"{_toml(str(key))} = {_toml(value)}\n" for key, value in case.items()), settings
    return _os.fspath(case), "", settings


_computed = False  # here, or in the process that this one was forked from
_forked = False


def _after_fork():
    global _forked
    _forked = _forked or _computed


# The threads of OpenMP stay with the process that started them: a child that waited for them would wait for ever.
_os.register_at_fork(after_in_child=_after_fork)


def _call(function, *arguments, threads=0):
    global _computed
    _computed = True
    try:
        return function(*arguments, 1 if _forked else threads)
    except _door.Wrong as error:
        message, problems = error.args
        raise CaseError(message, [tuple(problem) for problem in problems]) from None


def run(case, overrides=None, *, fields=True, threads=0):
    """Runs a case and gives its Result. `fields`: keep frames, which `output.every` spaces in motion; `threads`: 0 for all. A process
    that was forked from one that had run a case, as those of multiprocessing.Pool, runs with one thread."""
    raw, failure = _call(_door.run, *_source(case, overrides), fields, threads=threads)
    result = Result(raw)
    if failure:
        raise NumericalError(failure, result)
    return result


def check(case, overrides=None):
    """Validates a case and says what its run would cost, as text."""
    return _call(_door.check, *_source(case, overrides))


def keys(containing=""):
    """The keys of a case: dicts of name, unit, allowed, default, meaning."""
    names = ("name", "unit", "allowed", "default", "meaning")
    return [dict(zip(names, key)) for key in _door.keys() if containing in key[0]]
