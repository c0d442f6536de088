"""The Abaqus deck: every name refers to something, and each block contains what the paper says."""

import numpy as np
import pytest

from nptcs.config.solvers.abaqus import AbaqusModel
from nptcs.config.solvers.fe import SpokeGeometry
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError


def test_every_reference_exists(deck):
    materials = {block.parameters["NAME"] for block in deck.named("MATERIAL")}
    for part in deck.parts.values():
        orientations = {block.parameters["NAME"] for block in part.named("ORIENTATION")}
        used = {node for _, nodes in part.elements.values() for node in nodes}
        assert used <= set(part.positions)
        assert not used or used == set(part.positions)
        for labels in part.node_sets.values():
            assert labels
            assert set(labels) <= set(part.positions)
        for labels in part.element_sets.values():
            assert labels
            assert set(labels) <= set(part.elements)
        for block in part.named("SOLID SECTION"):
            assert block.parameters["MATERIAL"] in materials
        for block in part.named("SHELL SECTION"):
            assert block.parameters["ORIENTATION"] in orientations
            assert {row[2] for row in block.data} <= materials
        for block in part.named("REBAR LAYER"):
            assert block.parameters["ORIENTATION"] in orientations
            assert {row[4] for row in block.data} <= materials
        for block in part.surfaces.values():
            if block.parameters["TYPE"] == "ELEMENT":
                assert {row[0] for row in block.data} <= set(part.element_sets)
        for block in part.named("RIGID BODY"):
            assert block.parameters["REF NODE"] in part.node_sets
            assert block.parameters["ANALYTICAL SURFACE"] in part.surfaces
    for block in deck.assembly.blocks:
        if block.keyword == "TIE":
            assert all(deck.surface(name) for row in block.data for name in row)
        if block.keyword == "EMBEDDED ELEMENT":
            names = [block.parameters["HOST ELSET"], *block.data[0]]
            assert all(deck.resolve(name, "element_sets") for name in names)
        if block.keyword == "RIGID BODY":
            names = (block.parameters["REF NODE"], block.parameters["PIN NSET"])
            assert len(deck.resolve(names[0], "node_sets")) == 1
            assert deck.resolve(names[1], "node_sets")
    for block in deck.named("BOUNDARY") + deck.named("CLOAD"):
        assert all(deck.resolve(row[0], "node_sets") for row in block.data)
    for keyword in ("NODE PRINT", "NODE OUTPUT"):
        for block in deck.named(keyword):
            if "NSET" in block.parameters:
                assert deck.resolve(block.parameters["NSET"], "node_sets")
    (contact,) = deck.named("CONTACT PAIR")
    interactions = {block.parameters["NAME"] for block in deck.named("SURFACE INTERACTION")}
    assert contact.parameters["INTERACTION"] in interactions
    assert all(deck.surface(name) for name in contact.data[0])
    amplitudes = {block.parameters["NAME"] for block in deck.named("AMPLITUDE")}
    assert deck.named("CLOAD")[0].parameters["AMPLITUDE"] in amplitudes


def test_each_element_has_one_section(deck):
    for part in deck.parts.values():
        kinds = ("SOLID SECTION", "SHELL SECTION", "SURFACE SECTION")
        sets = [block.parameters["ELSET"] for kind in kinds for block in part.named(kind)]
        labels = [label for name in sets for label in part.element_sets[name]]
        assert sorted(labels) == sorted(part.elements)


def test_labels_are_ascii_and_short(text):
    assert text.isascii()
    names = [w.split("=")[1] for line in text.splitlines() if line[:2] != "**" and "=" in line
             for w in line.split(",") if "=" in w]  # fmt: skip
    assert max(map(len, names)) <= 38  # 80 in Abaqus, with instance and assembly in front


def test_plies_are_plus_and_minus_a_of_half_the_thickness_along_the_plate(deck, reader):
    part = deck.parts["PLATES"]
    axes = {block.parameters["NAME"]: block.data for block in part.named("ORIENTATION")}
    for block in part.named("SHELL SECTION"):
        assert "COMPOSITE" in block.parameters
        assert [float(row[0]) for row in block.data] == [0.9, 0.9]
        assert [float(row[3]) for row in block.data] == [30.0, -30.0]
        assert len({row[4] for row in block.data}) == 2
        first, second = axes[block.parameters["ORIENTATION"]]
        assert second[0] == "3"  # the local axis that is nearest to the normal
        along, axial = np.array(first, dtype=float).reshape(2, 3)
        assert axial.tolist() == [0.0, 0.0, 1.0]
        shells = reader.corners(part, block.parameters["ELSET"])
        edges = shells[:, 1] - shells[:, 0]
        edges /= np.linalg.norm(edges, axis=1)[:, None]
        assert edges == pytest.approx(np.broadcast_to(along, edges.shape), abs=1e-6)
        normals = np.cross(shells[:, 1] - shells[:, 0], shells[:, 3] - shells[:, 0])
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        wanted = np.broadcast_to(np.cross(along, axial), normals.shape)
        assert normals == pytest.approx(wanted, abs=1e-6)
        assert np.linalg.norm(shells[:, 3] - shells[:, 0], axis=1) == pytest.approx(2.5)


def test_ply_is_the_lamina_of_table_2(deck, reader):
    data = reader.material(deck, "CFRP")["ELASTIC"]
    assert data.parameters["TYPE"] == "LAMINA"
    wanted = [128000.0, 8800.0, 0.357, 3147.0, 3147.0, 2300.0]
    assert [float(value) for value in data.data[0]] == wanted


def test_rubbers_are_incompressible_neo_hooke(deck, reader):
    for name, c10 in (("SPOKE-RUBBER", 3.0), ("BAND-RUBBER", 5.0)):
        block = reader.material(deck, name)["HYPERELASTIC"]
        assert "NEO HOOKE" in block.parameters
        assert [float(value) for value in block.data[0]] == [c10, 0.0]
    used = {b.parameters["MATERIAL"] for b in deck.parts["BAND"].named("SOLID SECTION")}
    assert used == {"BAND-RUBBER"}
    (section,) = deck.parts["SPOKE"].named("SOLID SECTION")
    assert section.parameters["MATERIAL"] == "SPOKE-RUBBER"


def test_four_wire_layers_run_around_the_band_at_the_diameters_of_table_3(deck, reader):
    part = deck.parts["WIRES"]
    names = []
    for section, layers, radius in zip(
        part.named("SURFACE SECTION"), part.named("REBAR LAYER"), (300.75, 313.25), strict=True
    ):
        surface = reader.corners(part, section.parameters["ELSET"])
        assert np.hypot(*surface.reshape(-1, 3)[:, :2].T) == pytest.approx(radius)
        assert np.ptp(surface[..., 2]) == pytest.approx(215.0)
        assert len(layers.data) == 2
        for name, area, spacing, _, steel, angle in layers.data:
            names.append(name)
            assert float(area) == pytest.approx(np.pi / 4.0)
            assert float(spacing) == 2.0
            assert steel == "STEEL"
            assert float(angle) == 0.0
    assert len(set(names)) == 4
    (orientation,) = part.named("ORIENTATION")
    # axis Z; local 1 of the surface follows axis 1, the radial one, in the cycle: the hoop
    assert orientation.parameters["SYSTEM"] == "CYLINDRICAL"
    a, b = np.array(orientation.data[0], dtype=float).reshape(2, 3)
    assert (b - a).tolist() == [0.0, 0.0, 1.0]
    assert orientation.data[1][0] == "1"
    assert [float(v) for v in reader.material(deck, "STEEL")["ELASTIC"].data[0]] == [80000.0, 0.3]


def test_load_grows_linearly_over_a_static_second_with_large_displacements(deck):
    (step,) = deck.named("STEP")
    assert step.parameters["NLGEOM"] == "YES"
    first, period, smallest, largest = (float(v) for v in deck.named("STATIC")[0].data[0])
    assert (first, period, smallest, largest) == (0.02, 1.0, 1e-7, 0.05)
    (load,) = deck.named("CLOAD")
    assert load.data == [["RIM-REF", "2", "-5000."]]
    amplitude = [float(v) for v in deck.named("AMPLITUDE")[0].data[0]]
    assert amplitude == [0.0, 0.0, 1.0, 1.0]
    assert float(deck.named("FRICTION")[0].data[0][0]) == 0.3
    assert deck.named("SURFACE BEHAVIOR")[0].parameters["PRESSURE-OVERCLOSURE"] == "HARD"


def test_curve_and_fields_are_requested(deck):
    printed = {b.parameters["NSET"]: b.data[0] for b in deck.named("NODE PRINT")}
    assert printed == {"RIM-REF": ["U2"], "GROUND-REF": ["RF2"], "BAND-1.NEUTRAL": ["COORD"]}
    field, history = deck.named("OUTPUT")
    assert ("FIELD" in field.parameters, "HISTORY" in history.parameters) == (True, True)
    assert deck.named("ELEMENT OUTPUT")[0].data == [["S", "LE"]]


def test_case_and_load_reach_the_deck(reader, small_deck):
    deck = small_deck(load_n=3000.0, thickness_mm=2.4, angle_deg=75.0, spoke_c10_mpa=1.0,
        shear_band_c10_mpa=4.5,
    )  # fmt: skip
    section = deck.parts["PLATES"].named("SHELL SECTION")[0]
    assert [row[0] for row in section.data] == ["1.2", "1.2"]
    assert [row[3] for row in section.data] == ["75.", "-75."]
    assert deck.named("CLOAD")[0].data[0][2] == "-3000."
    assert reader.material(deck, "SPOKE-RUBBER")["HYPERELASTIC"].data[0][0] == "1."
    assert reader.material(deck, "BAND-RUBBER")["HYPERELASTIC"].data[0][0] == "4.5"


@pytest.mark.parametrize(
    ("model", "tyre", "column"),
    [
        (AbaqusModel(geometry=SpokeGeometry(height_mm=80.0)), TyreGeometry(), "geometry.height_mm"),
        (AbaqusModel(), TyreGeometry(wire_layers=3), "tyre.wire_layers"),
    ],
)
def test_parts_that_do_not_fit_are_refused(model, tyre, column, small_deck):
    with pytest.raises(InputError) as caught:
        small_deck(model, tyre)
    assert caught.value.column == column


@pytest.mark.parametrize(
    "change", [{"mesh": {"rows": (1, 1, 0, 1, 1, 1)}}, {"mesh": {"band_rows": 3}},
               {"increments": (0.1, 1e-7, 0.05)}],
)  # fmt: skip
def test_meshes_and_increments_without_meaning_are_refused(change):
    with pytest.raises(ValueError, match=r"rows|multiple of 2|increments"):
        AbaqusModel.model_validate(change)
