"""The parts of the Abaqus deck: counts, volumes, what lies inside what, what touches what."""

import shutil
import subprocess

import numpy as np
import pytest
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import spsolve

from nptcs.config.solvers.abaqus import AbaqusMesh, AbaqusModel
from nptcs.config.solvers.fe import SpokeGeometry, SpokeMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.decks.abaqus.mesh import spoke_part
from nptcs.decks.calculix import total_forces
from nptcs.fe.elements.groups import RubberGroup
from nptcs.fe.elements.lagrange import gauss, jacobians, tensor_shape
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.period import SpokeDesign

# a section for these tests alone: they must not change with the calibrated one
SECTION = SpokeGeometry(
    leg_angle_deg=26.433,
    height_mm=84.1,
    leg_thickness_mm=2.6,
    block_thickness_mm=11.239,
    block_half_length_mm=4.375,
    block_ramp_mm=5.27,
    foot_thickness_mm=8.988,
    foot_taper_mm=7.0,
    plate_foot_gap_mm=2.642,
    plate_mid_gap_mm=2.828,
    plate_layer_mm=1.0,
)


def test_default_mesh_has_the_counts_of_table_4(deck):
    count = {name: len(part.elements) for name, part in deck.parts.items()}
    assert count["SPOKE"] == 3612
    assert count["PLATES"] == 30 * 22
    assert count["BAND"] == 33480
    kinds = {name: {kind for kind, _ in p.elements.values()} for name, p in deck.parts.items()}
    assert kinds == {
        "SPOKE": {"C3D8H"},
        "PLATES": {"S4R"},
        "BAND": {"C3D8H"},
        "WIRES": {"SFM3D4R"},
        "GROUND": set(),
    }


@pytest.mark.parametrize(("spacing", "count"), [(10.0, 22), (15.0, 15), (20.0, 11)])
def test_plates_are_whole_and_inside_the_width(spacing, count, reader, small_deck):
    assert TyreGeometry().plates_across(spacing) == count
    part = small_deck(spacing_mm=spacing).parts["PLATES"]
    z = np.sort(np.unique(np.round(reader.corners(part).mean(axis=1)[:, 2], 6)))
    assert len(z) == count
    assert np.diff(z) == pytest.approx(spacing)
    edges = reader.places(part)[:, 2]
    assert edges.max() == pytest.approx(-edges.min())
    assert edges.max() <= 107.5 + 1e-9
    assert edges.max() + spacing > 107.5


def test_sixty_spokes_with_their_plates_every_six_degrees(deck):
    for part in ("SPOKE", "PLATES"):
        angles = [deck.instances[f"{part}-{i:02d}"].angle_deg for i in range(1, 61)]
        assert angles == pytest.approx(np.arange(60) * 6.0)
    middles = []
    for i in range(1, 61):
        spoke = deck.instances[f"SPOKE-{i:02d}"]
        feet = np.mean([spoke.position(n) for n in spoke.part.node_sets["RIMFOOT"]], axis=0)
        middles.append(np.round(np.degrees(np.arctan2(feet[0], -feet[1])), 6) % 360.0)
        assert np.hypot(*feet[:2]) == pytest.approx(215.9)
        assert feet[2] == pytest.approx(0.0, abs=1e-9)
    assert np.sort(middles) == pytest.approx(np.arange(60) * 6.0, abs=1e-6)


def test_first_spoke_can_be_turned(small_deck):
    mesh = AbaqusMesh(spoke_axial=3, around=60, band_axial=3)
    model = AbaqusModel(mesh=mesh, first_spoke_deg=3.0)
    deck = small_deck(model)
    assert deck.instances["SPOKE-01"].angle_deg == 3.0
    assert deck.instances["PLATES-60"].angle_deg == 357.0


def test_all_bricks_are_positive_and_fill_the_section(deck, reader):
    geometry = AbaqusModel().geometry
    heights, thickness = geometry.section()
    wide = np.array(thickness) / np.cos(np.radians(geometry.leg_angle_deg))
    section_mm2 = 2.0 * np.trapezoid(wide, heights)
    volume, smallest = reader.volumes(reader.corners(deck.parts["SPOKE"]))
    assert smallest.min() > 0.0
    assert volume.sum() == pytest.approx(section_mm2 * 215.0)
    volume, smallest = reader.volumes(reader.corners(deck.parts["BAND"]))
    assert smallest.min() > 0.0
    polygon = 360 / 2.0 * np.sin(2.0 * np.pi / 360) * (323.4**2 - 300.0**2)
    assert volume.sum() == pytest.approx(polygon * 215.0)


def test_band_and_tread_have_the_radii_of_table_3(deck, reader):
    part = deck.parts["BAND"]
    for name, low, high in (("BAND", 300.0, 314.0), ("TREAD", 314.0, 323.4)):
        radii = np.hypot(*reader.corners(part, name).reshape(-1, 3)[:, :2].T)
        assert (radii.min(), radii.max()) == (pytest.approx(low), pytest.approx(high))
    neutral = np.array([part.positions[n] for n in part.node_sets["NEUTRAL"]])
    assert len(neutral) == 360
    assert np.hypot(*neutral[:, :2].T) == pytest.approx(307.0)
    assert np.abs(neutral[:, 2]).max() < 215.0 / 31


def test_plates_lie_inside_the_rubber_of_their_own_spoke(deck, reader):
    spoke, plates = reader.corners(deck.parts["SPOKE"]), reader.places(deck.parts["PLATES"])
    assert reader.held(spoke, plates).sum() == len(plates)
    section = AbaqusModel().geometry
    beside = 0.5 * section.leg_thickness_mm / np.cos(np.radians(section.leg_angle_deg)) + 0.2
    aside = plates[np.isclose(plates[:, 1], -(215.9 + 20.0), atol=2.0)] + [beside, 0.0, 0.0]
    assert reader.held(spoke, aside).sum() == 0 < len(aside)  # the check can fail
    hosts = {
        block.data[0][0]: block.parameters["HOST ELSET"]
        for block in deck.assembly.named("EMBEDDED ELEMENT")
    }
    assert len(hosts) == 61
    for i in range(1, 61):
        assert hosts[f"PLATES-{i:02d}.LOWER"] == f"SPOKE-{i:02d}.RUBBER"


def test_plates_end_where_the_geometry_says_in_the_middle_of_the_legs(deck, reader):
    geometry = AbaqusModel().geometry
    part = deck.parts["PLATES"]
    slope = np.tan(np.radians(geometry.leg_angle_deg))
    for leg in ("LOWER", "UPPER"):
        x, y, _ = reader.corners(part, leg).reshape(-1, 3).T
        height = -y - 215.9
        from_end = height if leg == "LOWER" else geometry.height_mm - height
        assert from_end.min() == pytest.approx(geometry.plate_foot_gap_mm)
        assert from_end.max() == pytest.approx(geometry.height_mm / 2 - geometry.plate_mid_gap_mm)
        assert x == pytest.approx(-from_end * slope)


def test_wires_lie_inside_the_shear_band(deck, reader):
    band = reader.corners(deck.parts["BAND"], "BAND")
    wires = reader.places(deck.parts["WIRES"])[::97]
    assert reader.held(band, wires).sum() == len(wires)
    block = deck.assembly.named("EMBEDDED ELEMENT")[-1]
    assert block.parameters["HOST ELSET"] == "BAND-1.BAND"
    assert block.data == [["WIRES-1.INNER", "WIRES-1.OUTER"]]


def test_feet_meet_the_band_and_the_tread_meets_the_road(deck, reader):
    (tie,) = deck.assembly.named("TIE")
    assert tie.data == [[f"SPOKE-{i:02d}.FOOT", "BAND-1.INSIDE"] for i in range(1, 61)]
    band, spoke = deck.parts["BAND"], deck.parts["SPOKE"]
    inside = reader.face_radii(band, "INSIDE")
    assert inside == pytest.approx(300.0)
    gap = np.abs(reader.face_radii(spoke, "FOOT") - 300.0)
    # a flat foot of half a width w is w²/2R off the round band: 0.135 mm for 9 mm
    assert gap.max() < 0.135 < float(tie.parameters["POSITION TOLERANCE"])
    outside = reader.face_radii(band, "OUTSIDE")
    assert outside == pytest.approx(323.4)
    (contact,) = deck.named("CONTACT PAIR")
    assert contact.data == [["BAND-1.OUTSIDE", "GROUND-1.PLANE"]]
    ground = deck.instances["GROUND-1"]
    height = ground.position(1)[1]
    assert height == pytest.approx(reader.places(band)[:, 1].min())
    start, end = ground.part.surfaces["PLANE"].data
    # the outward normal lies 90 degrees anticlockwise of the line: up
    assert (start[0], end[0]) == ("START", "LINE")
    assert float(end[1]) > 400.0
    assert float(start[1]) < -400.0
    assert float(start[2]) == float(end[2]) == 0.0


def test_rim_is_rigid_and_moves_up_and_down_only(deck):
    rim = deck.resolve("RIM", "node_sets")
    assert len(rim) == len(set(rim)) == 60 * 3 * 44
    assert {name for name, _ in rim} == {f"SPOKE-{i:02d}" for i in range(1, 61)}
    radii = [np.hypot(*deck.instances[name].position(node)[:2]) for name, node in rim[::97]]
    # feet are flat: their edges lie a little outside the round rim
    edge = np.hypot(215.9, AbaqusModel().geometry.foot_width_mm() / 2.0)
    assert min(radii) == pytest.approx(215.9)
    assert max(radii) == pytest.approx(edge)
    held = {}
    for name, first, last in deck.named("BOUNDARY")[0].data:
        held.setdefault(name, set()).update(range(int(first), int(last) + 1))
    assert held == {"GROUND-REF": {1, 2, 3, 4, 5, 6}, "RIM-REF": {1, 3, 4, 5, 6}}
    assert deck.resolve("GROUND-REF", "node_sets") == [("GROUND-1", 1)]


def test_constant_pressure_bricks_of_the_default_mesh_bend():
    """C3D8H: eight nodes, full integration, one pressure. The rubber alone, in plane strain."""
    default = AbaqusModel().mesh
    fine = default.model_copy(
        update={"rows": tuple(3 * count for count in default.rows), "columns": 4}
    )
    assert slice_stiffness(default) == pytest.approx(slice_stiffness(fine), rel=0.15)
    few_along = default.model_copy(update={"rows": (1, 2, 7, 2, 1, 1), "columns": 3})
    assert slice_stiffness(few_along) > 1.4 * slice_stiffness(fine)  # as many bricks, locked


def slice_stiffness(mesh):
    """N/mm of one spoke's rubber (C10 = 1, 5 mm wide) against small outward motion of its foot."""
    model = AbaqusModel(geometry=SECTION, mesh=mesh.model_copy(update={"spoke_axial": 1}))
    part = spoke_part(model.geometry, model.mesh, TyreGeometry(tread_width_mm=5.0))
    # the tensor product of the kernel runs z fastest
    nodes = part.elements[:, [0, 4, 3, 7, 1, 5, 2, 6]] - 1
    points, weights = gauss((2, 2, 2))
    gradient, volume = jacobians(tensor_shape((1, 1, 1), points)[1], part.positions[nodes])
    bricks = RubberGroup(nodes, gradient, volume * weights, np.ones((8, 1)), 1.0, 200.0)
    dofs = nodes[:, :, None] * 3 + np.arange(3)
    dofs = dofs.reshape(len(nodes), -1)
    answer = bricks.respond(np.zeros_like(part.positions))
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    size = part.positions.size
    matrix = csr_matrix((answer.tangent.reshape(-1), (rows, columns)), shape=(size, size))
    y = part.positions[:, 1]
    moved = np.isclose(y, y.min())
    free = np.ones((len(y), 3), dtype=bool)
    free[:, 2] = False
    free[moved | np.isclose(y, y.max())] = False
    unknown = free.ravel()
    motion = np.zeros((len(y), 3))
    motion[moved, 1] = -1.0
    pulled = matrix @ motion.ravel()
    motion[free] = spsolve(matrix[unknown][:, unknown].tocsc(), -pulled[unknown])
    return -(matrix @ motion.ravel()).reshape(-1, 3)[moved, 1].sum()


def test_the_decks_spoke_is_as_stiff_as_the_packages_own(small_deck, reader, spoke_solver, ply):
    """All that the deck says about a spoke, solved at rest: embedding and plate spacing differ."""
    deck = small_deck(AbaqusModel(geometry=SECTION, mesh=AbaqusMesh(around=60, band_axial=1)))
    design = SpokeDesign(
        geometry=SECTION,
        mesh=SpokeMesh(),
        pitch_mm=215.0 / 15,
        plate_width_mm=5.0,
        thickness_mm=1.8,
        angle_deg=30.0,
        c10_mpa=3.0,
        ply=ply,
        plates=15,
        plate_coupling="embedded",
    )
    ours = SpokeModel(design).rest().tangent[0, 0]
    assert spoke_solver.radial_stiffness(deck, reader) == pytest.approx(ours, rel=0.1)


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_the_spokes_mesh_is_sound_in_another_solver(tmp_path, ply):
    """A slice of the spoke's rubber alone, in plane strain, against the package's own spoke.

    Bricks with incompatible modes, four across a leg; both meshes lie within 5 % of their own
    limits.
    """
    width, u_r, ratio = 5.0, 1.0, 100.0
    model = AbaqusModel(geometry=SECTION, mesh=AbaqusMesh(spoke_axial=1, columns=4))
    slice_mm = TyreGeometry(tread_width_mm=width)
    part = spoke_part(model.geometry, model.mesh, slice_mm)
    lines = ["*NODE, NSET=NALL"]
    lines += [f"{i}, {x:.9g}, {y:.9g}, {z:.9g}" for i, (x, y, z) in enumerate(part.positions, 1)]
    lines.append("*ELEMENT, TYPE=C3D8I, ELSET=RUBBER")
    lines += [", ".join(map(str, [i, *e])) for i, e in enumerate(part.elements.tolist(), 1)]
    outer = np.flatnonzero(np.isclose(part.positions[:, 1], part.positions[:, 1].min())) + 1
    for name, nodes in (("NBOTTOM", part.node_sets["RIMFOOT"]), ("NTOP", outer)):
        lines += [f"*NSET, NSET={name}", *[f"{node}," for node in nodes.tolist()]]
    lines += ["*MATERIAL, NAME=M", "*HYPERELASTIC, NEO HOOKE", f"1., {2.0 / (ratio * 2.0)}"]
    lines += [
        "*SOLID SECTION, ELSET=RUBBER, MATERIAL=M",
        "*STEP, NLGEOM",
        "*STATIC",
        "0.5, 1., 1e-3, 0.5",
    ]
    lines += ["*BOUNDARY", "NALL, 3, 3", "NBOTTOM, 1, 2", "NTOP, 1, 1", f"NTOP, 2, 2, {-u_r}"]
    lines += ["*NODE PRINT, NSET=NTOP, TOTALS=ONLY, FREQUENCY=1000", "RF", "*END STEP"]
    (tmp_path / "spoke.inp").write_text("\n".join(lines) + "\n")
    run = subprocess.run(["ccx", "spoke"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "*WARNING" not in run.stdout
    theirs = -total_forces((tmp_path / "spoke.dat").read_text())[-1, 1]
    design = SpokeDesign(
        geometry=model.geometry,
        mesh=SpokeMesh(rows=(1, 2, 4, 2, 1, 1), bulk_to_shear_ratio=ratio),
        pitch_mm=width,
        plate_width_mm=0.01,
        thickness_mm=1e-6,
        angle_deg=0.0,
        c10_mpa=1.0,
        ply=ply,
        plates=1,
        plate_coupling="embedded",
    )
    spoke = SpokeModel(design)
    ours = spoke.move(spoke.rest(), np.array([u_r, 0.0, 0.0])).force[0]
    assert theirs == pytest.approx(ours, rel=0.05)
