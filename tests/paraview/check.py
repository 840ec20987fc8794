"""Reads folders of results by ParaView's readers: all fields are there, cells fill the plate exactly, cracks are open, tips are named."""
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "post/paraview"))
import views
from vtkmodules.util.numpy_support import vtk_to_numpy

WANTED = {"w", "theta", "damage", "cut", "Mxx", "Myy", "Mxy", "Qx", "Qy", "von_mises", "displacement"}
IN_PLANE = {"Nxx", "Nyy", "Nxy"}


def polygon_area(ring):
    x, y = numpy.array(ring).T
    return abs((x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum()) / 2


def area(geometry):
    """(least, most): circles are drawn as polygons whose area is up to 1 % less."""
    def one(shape):
        if "rectangle" in shape:
            x0, y0, x1, y1 = shape["rectangle"]
            return (x1 - x0) * (y1 - y0), 0
        if "circle" in shape:
            full = numpy.pi * shape["circle"][2] ** 2
            return full, 0.01 * full
        return polygon_area(shape["polygon"]), 0
    plate = one(geometry["outline"])[0]
    holes = [one(hole) for hole in geometry.get("holes", [])]
    least = plate - sum(full for full, _ in holes)
    return least * (1 - 1e-9), (least + sum(missing for _, missing in holes)) * (1 + 1e-9)


def faults(folder):
    results = views.Results(folder)
    low, high = area(results.case["geometry"])
    for number, time in enumerate(results.times):
        grid = results.grid(time)
        arrays = {grid.GetPointData().GetArrayName(i) for i in range(grid.GetPointData().GetNumberOfArrays())}
        wanted = WANTED | (IN_PLANE if results.case["analysis"].get("nonlinear") else set())
        if not wanted <= arrays:
            yield f"frame {number} lacks {wanted - arrays}"
        for name in wanted & arrays:
            if not numpy.isfinite(vtk_to_numpy(grid.GetPointData().GetArray(name))).all():
                yield f"frame {number}: {name} is not finite"
        drawn = views.areas(grid).sum()
        if not low <= drawn <= high:
            yield f"frame {number}: cells have an area of {drawn:.12g}, the plate {low:.12g} to {high:.12g}"
        if results.cracks is not None:
            lines = views.fetched(results.cracks, time)
            tips = vtk_to_numpy(lines.GetPointData().GetArray("tip")) if lines.GetNumberOfPoints() else numpy.array([])
            if (tips >= 0).sum() != lines.GetNumberOfVerts():
                yield f"frame {number}: {lines.GetNumberOfVerts()} tips, {(tips >= 0).sum()} have a number"
    if results.case["geometry"].get("cracks") and results.cracks is None:
        yield "no crack lines"


def main():
    bad = 0
    for folder in sys.argv[1:]:
        if not (pathlib.Path(folder) / "fields.pvd").is_file():
            continue
        found = list(faults(folder))
        bad += bool(found)
        print(f"{folder}: {'; '.join(found) or 'as wanted'}", flush=True)
    return bad


if __name__ == "__main__":
    import os
    sys.stdout = open(1, "w", buffering=1, closefd=False, encoding="utf-8")  # what pvbatch puts in its place is lost by _exit
    status = main()
    sys.stdout.flush()
    os._exit(status)
