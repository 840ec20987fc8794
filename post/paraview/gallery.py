#!/usr/bin/env pvbatch
"""One picture of several results side by side, from above.

    xvfb-run -a -s "-screen 0 1600x1200x24 -noreset" pvbatch post/paraview/gallery.py OUT.png FOLDER[:FIELD[:FRAME]] ... [--columns 3]

FIELD: as of views.py, von_mises where it is left out. FRAME: first, peak, last (the standard) or a number."""
import argparse
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import views
from paraview import simple
from vtkmodules.vtkImagingCore import vtkImageAppend
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter


def tile(wanted, path, size, caption):
    folder, field, frame = (wanted.split(":") + ["", ""])[:3]
    results = views.Results(folder)
    (_, time), = views.chosen(results, frame or "last")
    simple.SetActiveView(simple.CreateRenderView())
    view = views.View(results, field or "von_mises", [time], warp="none", size=size, direction="top")
    view.go_to(time, caption)
    view.save(path)
    for source in list(simple.GetSources().values()):
        simple.Delete(source)


def read(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def appended(images, axis):
    append = vtkImageAppend()
    append.SetAppendAxis(axis)
    for image in images:
        append.AddInputData(image)
    append.Update()
    return append.GetOutput()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("tiles", nargs="+", metavar="FOLDER[:FIELD[:FRAME]]")
    parser.add_argument("--columns", type=int, default=3)
    parser.add_argument("--size", default="520x400", help="pixels of a tile")
    arguments = parser.parse_args()
    size = tuple(int(n) for n in arguments.size.split("x"))
    with tempfile.TemporaryDirectory() as folder:
        paths = [pathlib.Path(folder) / f"{i}.png" for i in range(len(arguments.tiles))]
        for wanted, path in zip(arguments.tiles, paths):
            tile(wanted, path, size, caption=pathlib.Path(wanted.split(":")[0]).name.replace("_", " "))
        images = [read(path) for path in paths]
    rows = [appended(images[i:i + arguments.columns], 0) for i in range(0, len(images), arguments.columns)]
    writer = vtkPNGWriter()
    writer.SetFileName(str(arguments.out))
    writer.SetInputData(appended(rows[::-1], 1))  # VTK counts from below
    writer.Write()
    print(arguments.out)


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # as in views.py
