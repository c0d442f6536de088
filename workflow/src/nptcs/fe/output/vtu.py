"""Bricks as VTK files for ParaView: ``.vtu``, and ``.pvd`` for a series of states.

The VTK library writes them (extra ``nptcs[paraview]``, see ``docs/how-to/use-finite-elements.md``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.errors import InputError
from nptcs.fe.output.bricks import BRICK_NODES, Bricks
from nptcs.files import atomic_path

# positions nearer than this are one node, mm
SAME_NODE_MM = 1e-5


def require_vtk() -> None:
    """Check that VTK is installed.

    Raises
    ------
    InputError
        If it is not.
    """
    try:
        import vtkmodules  # noqa: F401
    except ImportError as error:
        raise InputError(
            "files for ParaView need the library vtk", "pip install 'nptcs[paraview]'"
        ) from error


def shared_nodes(bricks: Bricks) -> tuple[Index, Array, Array, dict[str, Array]]:
    """Merge the nodes that bricks of the same body share.

    Returns
    -------
    connectivity : array (bricks, 27)
    position, displacement : arrays (points, 3)
    fields : mapping of arrays (points,)
        Mean over those bricks at a node that have a value there.
    """
    body = np.repeat(bricks.cell["spoke"], BRICK_NODES)
    places = np.round(bricks.position.reshape(-1, 3) / SAME_NODE_MM)
    keys = np.column_stack([places, body])
    _, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    number = number.ravel()
    fields = {}
    for name, values in bricks.point.items():
        known = ~np.isnan(values.ravel())
        count = np.bincount(number[known], minlength=len(first))
        total = np.bincount(number[known], values.ravel()[known], minlength=len(first))
        fields[name] = np.where(count > 0, total / np.maximum(count, 1), np.nan)
    return (
        number.reshape(-1, BRICK_NODES),
        bricks.position.reshape(-1, 3)[first],
        bricks.displacement.reshape(-1, 3)[first],
        fields,
    )


def write_vtu(path: str | Path, bricks: Bricks, values: Mapping[str, float]) -> None:
    """Write bricks as VTK's triquadratic hexahedra on their reference positions.

    Point data: ``displacement_mm`` (ParaView: Warp By Vector), ``mises_mpa``, ``pressure_mpa``,
    which are means over the rubber elements at a node. Cell data: those of `Bricks`.

    Parameters
    ----------
    path : path
        Ends in ``.vtu``.
    bricks : Bricks
    values : mapping
        Numbers of the whole state, written as field data.

    Raises
    ------
    OSError
        If VTK could not write the file.
    """
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    nodes, position, displacement, fields = shared_nodes(bricks)
    grid = _grid(nodes, position)
    for place, arrays in (
        (grid.GetPointData(), {"displacement_mm": displacement, **fields}),
        (grid.GetCellData(), bricks.cell),
        (grid.GetFieldData(), {name: np.array([value]) for name, value in values.items()}),
    ):
        for name, array in arrays.items():
            data = numpy_to_vtk(np.ascontiguousarray(array), deep=True)
            data.SetName(name)
            place.AddArray(data)
    writer = vtkXMLUnstructuredGridWriter()
    with atomic_path(path) as temporary:
        writer.SetFileName(str(temporary))
        writer.SetInputData(grid)
        if not writer.Write():
            raise OSError(f"VTK could not write {path}")


def _grid(nodes: Index, position: Array) -> Any:
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import (
        VTK_TRIQUADRATIC_HEXAHEDRON,
        vtkCellArray,
        vtkTriQuadraticHexahedron,
        vtkUnstructuredGrid,
    )

    # VTK's own local coordinates show where each of our nodes belongs
    local = np.array(vtkTriQuadraticHexahedron().GetParametricCoords()).reshape(-1, 3)
    order = np.round(2.0 * local).astype(np.int64) @ np.array([9, 3, 1])
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(position), deep=True))
    cells = vtkCellArray()
    offsets = np.arange(0, nodes.size + 1, BRICK_NODES, dtype=np.int64)
    flat = np.ascontiguousarray(nodes[:, order].ravel())
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(flat, deep=True)
    )
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(VTK_TRIQUADRATIC_HEXAHEDRON, cells)
    return grid


def write_pvd(path: str | Path, times: Sequence[float], files: Sequence[str]) -> None:
    """Write a collection: each file with the "time" at which ParaView shows it."""
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for time, file in zip(times, files, strict=True):
        ElementTree.SubElement(collection, "DataSet", timestep=f"{time:.9g}", part="0", file=file)
    ElementTree.indent(root)
    with atomic_path(path) as temporary:
        ElementTree.ElementTree(root).write(temporary, encoding="utf-8", xml_declaration=True)
