#!/usr/bin/env pvbatch
"""Ready-made views of a folder of results, as PNG: a field on the plate as it bends, cracks and tips on top, the scale in its unit.

    xvfb-run -a -s "-screen 0 1600x1200x24 -noreset" pvbatch post/paraview/views.py results/NAME [--field von_mises] [--frames first,peak,last] [--out DIR] ...

Colours run from the 2nd to the 98th percentile of the area (--percentiles), so that the few cells at a tip do not eat the scale; where
that says nothing, as for damage along a thin crack, over all values. In ParaView itself: View > Python Shell, then
    import sys; sys.path.insert(0, "post/paraview"); import views; views.show("results/NAME", field="w")"""
import argparse
import os
import pathlib
import sys
import tomllib

import numpy
from paraview import simple, servermanager
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter

# array: what it is, its unit in SI, whether colours part at zero
FIELDS = {
    "w": ("deflection w", "m", True), "theta_x": ("rotation theta_x", "1", True), "theta_y": ("rotation theta_y", "1", True),
    "Mxx": ("moment Mxx", "N", True), "Myy": ("moment Myy", "N", True), "Mxy": ("twisting moment Mxy", "N", True),
    "Qx": ("shear force Qx", "N/m", True), "Qy": ("shear force Qy", "N/m", True),
    "von_mises": ("von Mises stress, top face", "Pa", False), "damage": ("damage", "1", False), "cut": ("cut", "1", False)}
TRIANGLE, QUAD = 5, 9


class Results:
    """A folder of results: frames of the plate, and the cracks of each."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "fields.pvd").is_file():
            raise SystemExit(f"{folder}: no fields.pvd there; run the case with output.fields = [\"vtk\"]")
        with open(self.folder / "case.resolved.toml", "rb") as file:
            self.case = tomllib.load(file)
        self.reader = simple.PVDReader(registrationName=self.folder.name, FileName=str(self.folder / "fields.pvd"))
        self.reader.UpdatePipelineInformation()
        times = self.reader.TimestepValues
        self.times = list(times) if hasattr(times, "__len__") else [times]
        grows = (self.folder / "cracks.pvd").is_file()
        path = self.folder / ("cracks.pvd" if grows else "cracks.vtp")
        self.cracks = None
        if path.is_file():
            self.cracks = (simple.PVDReader if grows else simple.XMLPolyDataReader)(FileName=str(path))

    def title(self):
        return self.case.get("title", self.folder.name)

    def grid(self, time):
        return fetched(self.reader, time)

    def array(self, grid, field):
        name, _, part = field.partition("_")
        if name == "theta" and part:
            return vtk_to_numpy(grid.GetPointData().GetArray("theta"))[:, "xy".index(part)]
        found = grid.GetPointData().GetArray(field)
        if found is None:
            raise SystemExit(f"no field {field}: {', '.join(FIELDS)}")
        return vtk_to_numpy(found)


def fetched(source, time):
    """What a reader has at a time, out of the blocks that a .pvd comes in."""
    source.UpdatePipeline(time)
    data = servermanager.Fetch(source)
    while data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    return data


def areas(grid):
    """Area that each point stands for."""
    where = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
    cells, kinds = grid.GetCells(), vtk_to_numpy(grid.GetCellTypesArray())
    offsets, corners = vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())
    result = numpy.zeros(len(where))
    for kind, count in ((TRIANGLE, 3), (QUAD, 4)):
        ids = corners[offsets[:-1][kinds == kind][:, None] + numpy.arange(count)]
        x, y = where[ids, 0], where[ids, 1]
        area = numpy.abs((x * numpy.roll(y, -1, 1) - y * numpy.roll(x, -1, 1)).sum(1)) / 2
        for i in range(count):
            numpy.add.at(result, ids[:, i], area / count)
    return result


def colour_range(values, weights, percentiles, parts_at_zero):
    """(low, high, whether these are percentiles)."""
    order = numpy.argsort(values)
    share = numpy.cumsum(weights[order]) / weights.sum()
    low, high = (float(values[order][min(numpy.searchsorted(share, p / 100), len(order) - 1)]) for p in percentiles)
    least, most = float(values.min()), float(values.max())
    robust = high - low > 1e-3 * (most - least)
    if not robust:
        low, high = least, most
    if parts_at_zero and low < 0 < high:
        low, high = -max(-low, high), max(-low, high)
    return (low, high, robust) if high > low else (low, low + 1, False)


def fine(vertices, step):
    """Places along a line, no further apart than `step`, and the normals of the line there."""
    way, normals = [], []
    for a, b in zip(vertices, vertices[1:]):
        count = max(1, int(numpy.ceil(numpy.linalg.norm(b - a) / step)))
        along = (b - a) / max(numpy.linalg.norm(b - a), 1e-300)
        first = 0 if not way else 1
        way += [a + (b - a) * n / count for n in range(first, count + 1)]
        normals += [numpy.array([-along[1], along[0], 0])] * (count + 1 - first)
    return way, normals


def on_plate(cracks, grid, scale, lift, step):
    """Both faces of cracks, fine enough to follow the plate as it bends, and tips."""
    seen, places, faces, lines, tips = vtkPoints(), [], [], vtkCellArray(), vtkCellArray()
    for i in range(cracks.GetNumberOfCells()):
        cell = cracks.GetCell(i)
        vertices = [numpy.array(cell.GetPoints().GetPoint(k)) for k in range(cell.GetNumberOfPoints())]
        way, normals = fine(vertices, step) if len(vertices) > 1 else (vertices, [numpy.zeros(3)])
        for side in (1, -1) if len(vertices) > 1 else (1,):
            target = lines if len(vertices) > 1 else tips
            target.InsertNextCell(len(way))
            faces.append((len(places), len(places) + len(way)))
            for x, n in zip(way, normals):
                target.InsertCellPoint(seen.InsertNextPoint(*(x + side * step / 20 * n)))
                places.append(x)
    result = vtkPolyData()
    result.SetPoints(seen), result.SetLines(lines), result.SetVerts(tips)
    probe = vtkProbeFilter()
    probe.SetInputData(result), probe.SetSourceData(grid), probe.Update()
    found = probe.GetOutput().GetPointData()
    deflections = vtk_to_numpy(found.GetArray("displacement"))[:, 2].copy()
    inside = vtk_to_numpy(found.GetArray(probe.GetValidPointMaskArrayName())) > 0
    for first, end in faces:  # a face that meets an edge at an angle ends beyond it
        known = first + numpy.flatnonzero(inside[first:end])
        for k in first + numpy.flatnonzero(~inside[first:end]):
            deflections[k] = deflections[known[numpy.abs(known - k).argmin()]] if len(known) else 0
    place = numpy.array(places, dtype=float)
    place[:, 2] = scale * deflections + lift
    moved = vtkPoints()
    moved.SetData(numpy_to_vtk(place, deep=1))
    result.SetPoints(moved)
    return result


class View:
    """The pipeline: the same in ParaView's window and in pvbatch."""

    def __init__(self, results, field, frames, warp="auto", percentiles=(2, 98), size=(1500, 1000), direction="oblique", edges=False):
        self.results, self.field, self.frames = results, field, frames
        what, unit, parts_at_zero = FIELDS.get(field, (field, "", False))
        grids = [results.grid(time) for time in frames]
        low, high = numpy.array(grids[0].GetBounds()).reshape(3, 2).T
        self.length = float(max(high - low))
        largest = max(abs(v) for grid in grids for v in grid.GetPointData().GetArray("w").GetRange())
        self.scale = {"auto": 0.15 * self.length / largest if largest > 0 else 0.0, "none": 0.0}.get(warp)
        if self.scale is None:
            self.scale = float(warp)
        values = numpy.concatenate([results.array(grid, field) for grid in grids])
        weights = numpy.concatenate([areas(grid) for grid in grids])
        self.low, self.high, robust = colour_range(values, weights, percentiles, parts_at_zero)
        self.stated = "{:g}th to {:g}th percentile of the area".format(*percentiles) if robust else "all values"
        if robust:
            self.stated = self.stated.replace("2th", "2nd").replace("3th", "3rd").replace("1th", "1st")
        simple._DisableFirstRenderCameraReset()
        self.view = simple.GetActiveViewOrCreate("RenderView")
        self.view.ViewSize = list(size)
        self.view.OrientationAxesVisibility = 0
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.plate(what, unit, parts_at_zero, edges, size)
        self.overlay(size)
        self.camera(direction)

    def plate(self, what, unit, parts_at_zero, edges, size):
        warped = simple.WarpByVector(registrationName="plate", Input=self.results.reader, Vectors=["POINTS", "displacement"], ScaleFactor=self.scale)
        shown = simple.Show(warped, self.view)
        name, _, part = self.field.partition("_")
        array = ("theta", "XY"["xy".index(part)]) if name == "theta" and part else (self.field,)
        simple.ColorBy(shown, ("POINTS", *array))
        simple.HideScalarBarIfNotNeeded(simple.GetColorTransferFunction(array[0]), self.view)
        shown.SetRepresentationType("Surface With Edges" if edges else "Surface")
        shown.Specular, shown.Ambient, shown.Diffuse = 0, 0.35, 0.7
        colours = simple.GetColorTransferFunction(array[0])
        colours.AutomaticRescaleRangeMode = "Never"
        colours.ApplyPreset("Cool to Warm" if parts_at_zero else "Viridis (matplotlib)", True)
        colours.RescaleTransferFunction(self.low, self.high)
        shown.SetScalarBarVisibility(self.view, True)
        bar = simple.GetScalarBar(colours, self.view)
        si = self.results.case.get("units") == "SI" and unit and unit != "1"
        bar.Title, bar.ComponentTitle = f"{what} [{unit}]" if si else what, ""
        bar.TitleColor = bar.LabelColor = [0, 0, 0]
        bar.TitleFontSize, bar.LabelFontSize = (20, 18) if size[0] > 800 else (12, 11)
        bar.Orientation, bar.WindowLocation, bar.ScalarBarLength = "Vertical", "Any Location", 0.6
        bar.Position = [0.87, 0.2]
        bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.3g", "%.3g"
        bar.UseCustomLabels, bar.CustomLabels = 1, [self.low + (self.high - self.low) * i / 5 for i in range(1, 5)]

    def overlay(self, size):
        self.text = simple.Text(registrationName="caption")
        shown = simple.Show(self.text, self.view)
        shown.Color, shown.FontSize = [0, 0, 0], 18 if size[0] > 800 else 14
        shown.WindowLocation, shown.Position, shown.Justification = "Any Location", [0.015, 0.015], "Left"
        self.producer = None
        if self.results.cracks is None:
            return
        self.producer = simple.TrivialProducer(registrationName="cracks")
        self.crack_data(self.frames[0])
        shown = simple.Show(self.producer, self.view)
        shown.SetRepresentationType("Surface")
        shown.DiffuseColor = shown.AmbientColor = [0.85, 0.05, 0.1]
        shown.Ambient, shown.Diffuse = 1, 0
        shown.LineWidth, shown.PointSize, shown.RenderPointsAsSpheres = (2.5, 10, 1) if size[0] > 800 else (1.5, 5, 1)

    def crack_data(self, time):
        cracks, grid = fetched(self.results.cracks, time), self.results.grid(time)
        moved = on_plate(cracks, grid, self.scale, 0.003 * self.length, self.length / 400)
        self.producer.GetClientSideObject().SetOutput(moved)
        self.producer.MarkModified(self.producer)
        self.producer.UpdatePipeline()

    def camera(self, direction):
        """As large as the bent plate fits beside the scale and above the caption."""
        view, towards = self.view, {"top": numpy.array((0, 0, 1.0)), "oblique": numpy.array((0.35, -1, 0.95))}[direction]
        towards /= numpy.linalg.norm(towards)
        up = numpy.array((0, 1.0, 0) if direction == "top" else (0, 0, 1.0))
        right = numpy.cross(up, towards) / numpy.linalg.norm(numpy.cross(up, towards))
        up = numpy.cross(towards, right)
        seen = []
        for time in self.frames:
            grid = self.results.grid(time)
            place = vtk_to_numpy(grid.GetPoints().GetData()).copy()
            place[:, 2] += self.scale * vtk_to_numpy(grid.GetPointData().GetArray("w"))
            across, along = place @ right, place @ up
            seen.append((across.min(), across.max(), along.min(), along.max()))
        seen = numpy.array(seen)
        left, most, bottom, top = seen[:, 0].min(), seen[:, 1].max(), seen[:, 2].min(), seen[:, 3].max()
        wide, tall = view.ViewSize
        view.CameraParallelProjection = 1
        view.CameraParallelScale = half = max((top - bottom) / 0.84, (most - left) / 0.8 * tall / wide) / 2
        centre = (left + most) / 2 * right + (bottom + top) / 2 * up + 0.09 * half * wide / tall * 2 * right - 0.05 * half * 2 * up
        view.CameraFocalPoint, view.CameraPosition = list(centre), list(centre + 10 * self.length * towards)
        view.CameraViewUp = list(up)
        simple.GetActiveCamera().SetClippingRange(0.1 * self.length, 30 * self.length)

    def go_to(self, time, caption=None):
        simple.GetAnimationScene().AnimationTime = time
        self.view.ViewTime = time
        if self.producer:
            self.crack_data(time)
        analysis = self.results.case.get("analysis", {}).get("kind", "static")
        grows = "growth" in self.results.case
        when = {"frequencies": f"mode {time:g}", "dynamic": f"t = {time:.4g}"}.get(analysis, f"advance {time:g}" if grows else "")
        parts = [when, f"deflection times {self.scale:.3g}" if self.scale else "flat", f"colours: {self.stated}"]
        self.text.Text = caption or self.results.title() + "\n" + ", ".join(part for part in parts if part)
        simple.Render(self.view)

    def save(self, path):
        simple.SaveScreenshot(str(path), self.view, ImageResolution=list(self.view.ViewSize))


def chosen(results, frames):
    """(name, time) of the frames that are wanted."""
    times = results.times
    if frames == "all":
        return [(f"{i:04}", time) for i, time in enumerate(times)]
    result = []
    for name in frames.split(","):
        if name == "peak":
            def size(time):
                return max(abs(v) for v in results.grid(time).GetPointData().GetArray("w").GetRange())
            result.append((name, max(times, key=size)))
        elif name in ("first", "last"):
            result.append((name, times[0 if name == "first" else -1]))
        elif name.isdigit() and int(name) < len(times):
            result.append((name, times[int(name)]))
        else:
            raise SystemExit(f"--frames {name}: all, or first, peak, last, and numbers from 0 to {len(times) - 1}, with commas between")
    return result


def show(folder, field="von_mises", frames="last", **options):
    """The view in ParaView's window."""
    results = Results(folder)
    wanted = chosen(results, frames)
    view = View(results, field, [time for _, time in wanted], **options)
    view.go_to(wanted[-1][1])
    return view


def main():
    parser = argparse.ArgumentParser(prog="views.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="of results")
    parser.add_argument("--out", type=pathlib.Path, help="folder of the pictures (default: that of the results)")
    parser.add_argument("--field", default="von_mises", help=", ".join(FIELDS) + " (default: von_mises)")
    parser.add_argument("--frames", help="first, peak, last, numbers, or all (default: first,peak,last of a series); one scale for all of them")
    parser.add_argument("--warp", default="auto", help="times the deflection; auto: 0.15 of the plate; none")
    parser.add_argument("--percentiles", default="2,98", help="of the colours (default: 2,98); 0,100: all values")
    parser.add_argument("--size", default="1500x1000", help="pixels")
    parser.add_argument("--view", default="oblique", choices=("oblique", "top"))
    parser.add_argument("--mesh", action="store_true", help="draw the cells")
    arguments = parser.parse_args()
    if arguments.field not in FIELDS:
        parser.error(f"no field {arguments.field}: {', '.join(FIELDS)}")
    results = Results(arguments.folder)
    out = arguments.out or results.folder
    out.mkdir(parents=True, exist_ok=True)
    single = len(results.times) == 1
    wanted = chosen(results, arguments.frames or ("last" if single else "first,peak,last"))
    view = View(results, arguments.field, [time for _, time in wanted], arguments.warp,
                tuple(float(p) for p in arguments.percentiles.split(",")), tuple(int(n) for n in arguments.size.split("x")),
                arguments.view, arguments.mesh)
    for name, time in wanted:
        view.go_to(time)
        path = out / (f"{arguments.field}.png" if single else f"{arguments.field}_{name}.png")
        view.save(path)
        print(f"{path}: {arguments.field} from {view.low:.4g} to {view.high:.4g} ({view.stated}), deflection times {view.scale:.4g}")


if __name__ == "__main__":
    sys.stdout = open(1, "w", buffering=1, closefd=False, encoding="utf-8")  # what pvbatch puts in its place is lost by _exit
    main()
    sys.stdout.flush()
    os._exit(0)  # Debian's pvbatch ends with an error of the X server that its pictures have been taken from
