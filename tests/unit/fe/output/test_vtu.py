import argparse
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from nptcs.commands import fe_export
from nptcs.commands.fe_picture import SolvedTyre
from nptcs.config.solvers.fe import GroundContact, SpokeGeometry, SpokeMesh, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.fe.output.bricks import MATERIALS, Bricks, spoke_bricks, tyre_bricks
from nptcs.fe.output.fields import lattice
from nptcs.fe.output.vtu import require_vtk, shared_nodes, write_pvd, write_vtu
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.tyre.equilibrium import TyreModel

pytest.importorskip("vtkmodules", reason="needs vtk: pip install 'nptcs[paraview]'")

# few spokes: each is solved again for the file
TYRE = TyreGeometry(spoke_count=8)


def read(path):
    """Grid, point, cell and field arrays of a file, read by VTK."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    parts = []
    for data in (grid.GetPointData(), grid.GetCellData(), grid.GetFieldData()):
        arrays = range(data.GetNumberOfArrays())
        parts.append({data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in arrays})
    return grid, *parts


def volumes(grid):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter

    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    return vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))


@pytest.fixture(scope="module")
def spoke(published_ply):
    coarse = SpokeMesh(rows=(1, 1, 1, 1, 1, 1))
    return SpokeModel(
        SpokeDesign(
            SpokeGeometry(), coarse, 215.0 / 14, 5.0, 1.8, 45.0, 1.0, published_ply, 14, "embedded"
        )
    )


@pytest.fixture(scope="module")
def pressed(spoke):
    return spoke.move(spoke.rest(), np.array([-4.0, 1.0, 0.02]))


@pytest.fixture(scope="module")
def tyre():
    """A tyre on springs: what its file must contain does not depend on the table."""
    unit = np.array([12.0, 0.2, 0.2])
    exponents = np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)])
    # k x²/2 = k h²/4 (T2(x/h) + 1)
    terms = np.array([60.0, 1.4e5, 2e4]) * unit**2 / 4.0
    table = SpokeEnergyTable(
        84.1, 1e12, -unit, unit, exponents, np.array([terms.sum(), *terms]), 1.0, 0.0
    )
    width = SpokeGeometry().foot_width_mm()
    model = TyreModel(TYRE, table, width, 5.0, 2000.0, TyreMesh(gap_elements=4), GroundContact())
    return model, model.load([200.0])


def test_the_energy_in_a_spokes_file_is_the_models(tmp_path, spoke, pressed):
    spoke.rest()  # leaves other pressures in the model than the state's
    write_vtu(tmp_path / "spoke.vtu", spoke_bricks(spoke, pressed), {"u_r_mm": -4.0})
    grid, points, cells, fields = read(tmp_path / "spoke.vtu")
    drawn = volumes(grid)
    assert drawn == pytest.approx(cells["reference_volume_mm3"], rel=1e-6)
    energy = spoke.design.plates * np.sum(drawn * cells["strain_energy_density_mpa"])
    assert energy == pytest.approx(pressed.energy, rel=1e-6)
    assert fields["u_r_mm"] == pytest.approx([-4.0])
    rubber = cells["material"] == MATERIALS["spoke rubber"]
    assert np.isnan(cells["fibre_stress_plus_mpa"]).tolist() == rubber.tolist()
    assert set(cells["leg"]) == {0, 1}
    assert grid.GetNumberOfPoints() < 27 * grid.GetNumberOfCells() / 2
    assert points["mises_mpa"].shape == (grid.GetNumberOfPoints(),)


def test_displacements_and_neighbours_in_a_spokes_file(tmp_path, spoke, pressed):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    write_vtu(tmp_path / "spoke.vtu", spoke_bricks(spoke, pressed), {})
    grid, points, _, _ = read(tmp_path / "spoke.vtu")
    place = vtk_to_numpy(grid.GetPoints().GetData())
    moved = points["displacement_mm"]
    assert moved[place[:, 2] < 1e-6] == pytest.approx(0.0)
    top = place[:, 2] > spoke.design.geometry.height_mm - 1e-6
    assert moved[top][:, 2] == pytest.approx(-4.0 + place[top, 0] * np.sin(0.02))
    # the two ends of the period move alike
    low, high = place[:, 1] == place[:, 1].min(), place[:, 1] == place[:, 1].max()
    ends = [
        part[np.lexsort(np.round(place[part][:, [0, 2]], 4).T)]
        for part in map(np.flatnonzero, (low, high))
    ]
    assert moved[ends[0]] == pytest.approx(moved[ends[1]], abs=1e-12)
    # values at VTK's own nodes lie on the straight-sided bricks of the mesh
    cell = grid.GetCell(0)
    nodes = np.array([cell.GetPointId(i) for i in range(27)])
    local = np.array(cell.GetParametricCoords()).reshape(-1, 3)
    corner = place[nodes]
    assert corner[8] == pytest.approx(0.5 * (corner[0] + corner[1]))
    assert corner[26] == pytest.approx(corner[:8].mean(axis=0))
    assert local[26].tolist() == [0.5, 0.5, 0.5]


def test_the_energy_in_a_tyres_file_is_the_models(tmp_path, tyre, spoke):
    model, state = tyre
    write_vtu(tmp_path / "tyre.vtu", tyre_bricks(model, TYRE, state, spoke), {"load_n": 200.0})
    grid, points, cells, _ = read(tmp_path / "tyre.vtu")
    energy = spoke.design.plates * (
        cells["reference_volume_mm3"] * cells["strain_energy_density_mpa"]
    )
    parts = model.energy(state)
    ring = cells["spoke"] < 0
    assert energy[ring].sum() == pytest.approx(parts["rubber"] + parts["wires"], rel=1e-6)
    assert parts["wires"] > 0.01 * parts["rubber"]
    for number, motion in enumerate(state.motion):
        alone = spoke.move(spoke.rest(), motion)
        assert energy[cells["spoke"] == number].sum() == pytest.approx(alone.energy, rel=1e-6)
    assert volumes(grid).sum() == pytest.approx(cells["reference_volume_mm3"].sum(), rel=2e-2)
    assert set(cells["material"]) == set(MATERIALS.values())
    assert np.nanmin(points["displacement_mm"][:, 1]) > -5.0


def test_spokes_stand_on_the_band_in_the_tyres_file(tyre, spoke):
    model, state = tyre
    bricks = tyre_bricks(model, TYRE, state, spoke)
    radius = np.hypot(*bricks.position[..., :2].reshape(-1, 2).T)
    inner = model.mesh.radii[0]
    own = np.repeat(bricks.cell["spoke"] >= 0, 27)
    # a flat foot of half a width w is w²/2R off the round band: 0.135 mm for 9 mm
    assert radius[own].max() == pytest.approx(inner, abs=0.135)
    assert radius[own].min() == pytest.approx(inner - spoke.design.geometry.height_mm, abs=0.135)
    assert radius[~own].min() == pytest.approx(inner)
    # where a spoke meets the band, both move alike but for the foot's own bending
    flat, moved = bricks.position.reshape(-1, 3), bricks.displacement.reshape(-1, 3)
    for angle in model.mesh.spoke_angle:
        foot = inner * np.array([np.sin(angle), -np.cos(angle)])
        near = [
            np.flatnonzero(part)[np.linalg.norm(flat[part][:, :2] - foot, axis=1).argmin()]
            for part in (own, ~own)
        ]
        assert moved[near[0], :2] == pytest.approx(moved[near[1], :2], abs=0.15)


def test_nodes_are_shared_within_a_body_and_fields_are_means_of_what_is_known():
    nodes = lattice(3, 3)
    places = np.stack([nodes, nodes + [2.0, 0.0, 0.0], nodes])
    values = np.stack([np.full(27, value) for value in (1.0, 3.0, np.nan)])
    cell = {"spoke": np.array([0, 0, 1])}
    bricks = Bricks(places, np.zeros_like(places), cell, {"mises_mpa": values})
    number, position, _, fields = shared_nodes(bricks)
    assert len(position) == 27 + 18 + 27
    assert position[number] == pytest.approx(places)
    assert fields["mises_mpa"][number[0]] == pytest.approx(1.0 + (nodes[:, 0] == 1.0))
    assert np.isnan(fields["mises_mpa"][number[2]]).all()


def test_a_collection_names_its_files_and_times(tmp_path):
    write_pvd(tmp_path / "row.pvd", [-2.0, 0.5], ["a.vtu", "b.vtu"])
    sets = ElementTree.parse(tmp_path / "row.pvd").getroot().findall("./Collection/DataSet")
    assert [(s.get("timestep"), s.get("file")) for s in sets] == [("-2", "a.vtu"), ("0.5", "b.vtu")]


def test_the_command_writes_tyre_and_spoke(tmp_path, tyre, spoke, monkeypatch, capsys):
    parser = argparse.ArgumentParser()
    fe_export.register(parser.add_subparsers())
    case = SolvedTyre(TYRE, *tyre, spoke, "the published ply")
    monkeypatch.setattr(fe_export, "solved", lambda arguments: case)
    monkeypatch.setattr(fe_export, "PRESSED_STEPS", 5)
    monkeypatch.setattr(fe_export, "PULLED_STEPS", 2)
    folder = tmp_path / "new"
    arguments = parser.parse_args(["fe-export", str(folder), "--load", "200"])
    assert arguments.run(arguments) == 0
    assert "8 states" in capsys.readouterr().out
    names = {path.name for path in Path(folder).iterdir()}
    assert names == {
        "design.json",
        "tyre.vtu",
        "spoke.pvd",
        *(f"spoke_{i:04d}.vtu" for i in range(8)),
    }
    assert '"materials": "the published ply"' in (folder / "design.json").read_text("utf-8")
    sets = ElementTree.parse(folder / "spoke.pvd").getroot().findall("./Collection/DataSet")
    assert [float(s.get("timestep")) for s in sets] == [-20, -16, -12, -8, -4, 0, 2, 4]
    *_, fields = read(folder / "spoke_0000.vtu")
    assert fields["u_r_mm"] == pytest.approx([-20.0])
    assert fields["force_n"][0] < 0.0


def test_without_vtk_the_remedy_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "vtkmodules", None)
    with pytest.raises(InputError, match="nptcs\\[paraview\\]"):
        require_vtk()
