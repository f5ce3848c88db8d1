#!/usr/bin/env python3
"""Reads the ParaView series of a folder with VTK itself and checks them.

    pip install vtk numpy
    python3 read_back.py FOLDER

FOLDER holds particles.pvd, bridges.pvd and walls.pvd. Checked for every frame: the file reads
without a warning, its time is the series', arrays have their types, every number is finite, cells
name points that exist. Where FOLDER has an expected.json (a list of frames, as the Rust tests write
it), every number is compared; where FOLDER's parent has a retained.csv with a row of the same time,
the number of particles is. Exit code: 0 if all is well, 1 on a mismatch, 2 on wrong usage.
"""

import csv
import json
import os
import sys
import xml.etree.ElementTree as ElementTree

try:
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkCommand
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as error:
    sys.exit(f"needs VTK's Python package (pip install vtk numpy): {error}")

# Series: where its arrays are, their types in VTK's words, corners of a cell.
SERIES = {
    "particles": ("GetPointData", {"id": "long long", "class": "int", "radius": "float",
                                   "velocity": "float", "film": "float"}, 1),
    "bridges": ("GetCellData", {"volume": "float", "force": "float", "gap": "float"}, 2),
    "walls": ("GetCellData", {"film": "float"}, 3),
}
WIDTH = {"velocity": 3, "position": 3}


class Mismatch(Exception):
    pass


def check(holds, message):
    if not holds:
        raise Mismatch(message)


def read(path):
    """The poly data of a file; what VTK complains about is a mismatch."""
    said = []
    reader = vtkXMLPolyDataReader()

    def listen(_caller, event):
        said.append(event)

    for event in (vtkCommand.ErrorEvent, vtkCommand.WarningEvent):
        reader.AddObserver(event, listen)
    check(reader.CanReadFile(path), f"{path}: VTK cannot read it")
    reader.SetFileName(path)
    reader.Update()
    check(not said, f"{path}: VTK says {said}")
    return reader.GetOutput()


def columns(path, series, data):
    """Every array of a file by name, checked for type, length and finite numbers."""
    where, kinds, corners = SERIES[series]
    attributes = getattr(data, where)()
    found = {}
    entries = data.GetNumberOfPoints() if series == "particles" else data.GetNumberOfCells()
    check(attributes.GetNumberOfArrays() == len(kinds), f"{path}: arrays other than {list(kinds)}")
    for name, kind in kinds.items():
        array = attributes.GetArray(name)
        check(array is not None, f"{path}: no array {name}")
        is_kind = array.GetDataTypeAsString()
        check(is_kind in (kind, "long", "vtkIdType") if kind == "long long" else is_kind == kind,
              f"{path}: {name} is {is_kind}, not {kind}")
        check(array.GetNumberOfComponents() == WIDTH.get(name, 1), f"{path}: components of {name}")
        check(array.GetNumberOfTuples() == entries,
              f"{path}: {array.GetNumberOfTuples()} of {name} for {entries}")
        found[name] = vtk_to_numpy(array)
    points = data.GetPoints()
    found["position"] = vtk_to_numpy(points.GetData()).reshape(-1, 3) if points else numpy.zeros((0, 3))
    for name, values in found.items():
        check(numpy.isfinite(values).all(), f"{path}: {name} is not finite somewhere")
    cells = {1: data.GetVerts, 2: data.GetLines, 3: data.GetPolys}[corners]()
    check(cells.GetNumberOfCells() == data.GetNumberOfCells(), f"{path}: other cells than expected")
    connectivity = vtk_to_numpy(cells.GetConnectivityArray())
    check(len(connectivity) == corners * cells.GetNumberOfCells(), f"{path}: corners of cells")
    inside = (connectivity >= 0) & (connectivity < data.GetNumberOfPoints())
    check(inside.all(), f"{path}: a cell names a point that is not there")
    found["cells"] = connectivity
    return found


def compare(path, found, expected):
    for name, values in expected.items():
        flat = [v for row in values for v in (row if isinstance(row, list) else [row])]
        numbers = found["cells" if name == "triangles" else name].ravel().tolist()
        check(len(flat) == len(numbers), f"{path}: {len(numbers)} of {name}, not {len(flat)}")
        for index, (a, b) in enumerate(zip(numbers, flat)):
            close = a == b if isinstance(b, int) else abs(a - b) <= 6e-8 * abs(b)
            check(close, f"{path}: {name}, number {index}, is {a}, not {b}")


def retained(folder):
    """Particles above the screen by time, from the run's table where there is one."""
    path = os.path.join(folder, os.pardir, "retained.csv")
    if not os.path.exists(path):
        return {}
    with open(path, newline="") as file:
        return {round(float(row["time_s"]), 6): int(row["particles_above"])
                for row in csv.DictReader(file)}


def main(folder):
    expected_path = os.path.join(folder, "expected.json")
    expected = None
    if os.path.exists(expected_path):
        with open(expected_path) as file:
            expected = json.load(file)
    above = retained(folder)
    counted = 0
    frames = {}
    for series in SERIES:
        path = os.path.join(folder, f"{series}.pvd")
        root = ElementTree.parse(path).getroot()
        check(root.get("type") == "Collection", f"{path}: not a collection")
        sets = root.findall("./Collection/DataSet")
        times = [float(s.get("timestep")) for s in sets]
        check(times == sorted(set(times)), f"{path}: times do not rise")
        check(expected is None or times == [f["time"] for f in expected],
              f"{path}: times are {times}")
        frames[series] = times
        total = 0
        for index, (time, entry) in enumerate(zip(times, sets)):
            file = os.path.join(folder, entry.get("file"))
            data = read(file)
            stamp = data.GetFieldData().GetArray("TimeValue")
            check(stamp is not None and stamp.GetValue(0) == time, f"{file}: its time is not {time}")
            found = columns(file, series, data)
            total += data.GetNumberOfCells()
            if expected is not None:
                compare(file, found, expected[index][series])
            if series == "particles" and round(time, 6) in above:
                counted += 1
                check(data.GetNumberOfPoints() == above[round(time, 6)],
                      f"{file}: {data.GetNumberOfPoints()} particles, "
                      f"{above[round(time, 6)]} in retained.csv")
        print(f"{series}: {len(times)} frames, {total} cells in all")
    check(len({tuple(times) for times in frames.values()}) == 1, "series have different times")
    if expected is not None:
        print("every number is the expected one")
    if counted:
        print(f"{counted} frames have as many particles as retained.csv says")


if __name__ == "__main__":
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    try:
        main(sys.argv[1])
    except (Mismatch, OSError, ElementTree.ParseError, ValueError, KeyError) as error:
        sys.exit(f"mismatch: {error}")
