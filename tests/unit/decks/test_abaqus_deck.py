"""The Abaqus deck: every name refers to something, and each block contains what the paper says."""

import numpy as np
import pytest

from nptcs.config.solvers.abaqus import AbaqusModel
from nptcs.config.solvers.fe import SpokeGeometry
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError


def test_every_reference_exists(deck, references):
    assert references.undefined(deck) == []


def test_no_node_is_left_over_and_the_rim_has_one_reference(deck):
    for part in deck.parts.values():
        used = {node for _, nodes in part.elements.values() for node in nodes}
        assert not used or used == set(part.positions)
    (rim,) = deck.assembly.named("RIGID BODY")
    assert len(deck.resolve(rim.parameters["REF NODE"], "node_sets")) == 1
    assert len(deck.named("CONTACT PAIR")) == 1


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("ELSET=RUBBER, MAT", "ELSET=CAOUTCHOUC, MAT", "*SECTION: no element set CAOUTCHOUC"),
        ("MATERIAL=BAND-RUBBER", "MATERIAL=RUBBER", "*SOLID SECTION: no material RUBBER"),
        (", STEEL, 0.", ", IRON, 0.", "*REBAR LAYER: no material IRON"),
        ("ORIENTATION=HOOP", "ORIENTATION=LOOP", "*REBAR LAYER: no orientation LOOP"),
        ("\nBANDFOOT, S2", "\nFOOTBAND, S2", "*SURFACE: no element set FOOTBAND"),
        ("REF NODE=REF", "REF NODE=HUB", "*RIGID BODY: no node set HUB"),
        ("SPOKE-01.FOOT", "SPOKE-99.FOOT", "*TIE: no surface SPOKE-99.FOOT"),
        ("PLATES-01.UPPER", "PLATES-01.OUTER", "no element set PLATES-01.OUTER"),
        ("AMPLITUDE=LINEAR", "AMPLITUDE=JUMP", "*CLOAD: no amplitude JUMP"),
        ("INTERACTION=ROAD", "INTERACTION=ICE", "no surface interaction ICE"),
        ("NSET=BAND-1.NEUTRAL", "NSET=BAND-1.MIDDLE", "no node set BAND-1.MIDDLE"),
    ],
)
def test_a_missing_reference_is_named(small_text, reader, references, old, new, fault):
    broken = small_text.replace(old, new, 1)
    assert broken != small_text
    assert any(fault in found for found in references.undefined(reader.read_deck(broken)))


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
