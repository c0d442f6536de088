"""Parts of the Abaqus deck of the tyre, block by block, with comments for the reader."""

from __future__ import annotations

import numpy as np

from nptcs.config.solvers.abaqus import AbaqusModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.decks.abaqus.mesh import (
    DeckPart,
    band_part,
    plate_axes,
    plates_part,
    spoke_part,
    wires_part,
)
from nptcs.decks.abaqus.text import THIN_RULE, comment, members, number, numbers
from nptcs.errors import InputError


def spoke_text(model: AbaqusModel, tyre: TyreGeometry) -> list[str]:
    """Write the part of one spoke's rubber."""
    part = spoke_part(model.geometry, model.mesh, tyre)
    return [
        THIN_RULE,
        *comment(
            "SPOKE: the rubber of one spoke, drawn under the wheel's centre (figure 6e). "
            f"{len(part.elements)} C3D8H bricks (table 4: 3612 C3D8H/C3D6H per spoke); the mesh "
            "needs no wedges (C3D6H). Hybrid elements, because the rubber is incompressible. "
            f"As wide as the tread ({tyre.tread_width_mm:g} mm), since the paper gives no other "
            "width. FOOT: faces on the shear band."
        ),
        "*PART, NAME=SPOKE",
        *_mesh(part, "C3D8H"),
        "*SURFACE, NAME=FOOT, TYPE=ELEMENT",
        "BANDFOOT, S2",
        "*SOLID SECTION, ELSET=RUBBER, MATERIAL=SPOKE-RUBBER",
        "*END PART",
    ]


def plates_lines(
    model: AbaqusModel,
    tyre: TyreGeometry,
    spacing_mm: float,
    thickness_mm: float,
    angle_deg: float,
) -> list[str]:
    """Write the part of one spoke's reinforcement plates."""
    part = plates_part(model.geometry, model.mesh, tyre, spacing_mm)
    count = tyre.plates_across(spacing_mm)
    lines = [
        THIN_RULE,
        *comment(
            f"PLATES: the {2 * count} CFRP reinforcement plates of one spoke (section 3.2, table "
            f"4), {count} per leg, {tyre.plate_width_mm:g} mm wide, every S = {spacing_mm:g} mm, "
            f"{np.prod(model.mesh.plate)} S4R shells each. A plate is a laminate [+A/-A] of two "
            f"plies, A = {angle_deg:g} degrees from the plate's length, T/2 = "
            f"{thickness_mm / 2.0:g} mm each. The section holds its true thickness; it takes no "
            "room from the rubber. The first ply lies on the negative side of the shells' normal."
        ),
        "*PART, NAME=PLATES",
        *_mesh(part, "S4R"),
    ]
    for leg, along in plate_axes(model.geometry).items():
        lines += [
            *comment(
                f"leg at the {'rim' if leg == 'LOWER' else 'band'}: local 1 along the plate, at "
                "right angles to the tyre's axis; local 2 along the axis; local 3 the normal"
            ),
            f"*ORIENTATION, NAME=ALONG-{leg}, SYSTEM=RECTANGULAR",
            numbers([*along, 0.0, 0.0, 1.0]),
            "3, 0.",
            f"*SHELL SECTION, ELSET={leg}, COMPOSITE, ORIENTATION=ALONG-{leg}",
            "** thickness (mm), integration points, material, angle from local 1 (deg), ply",
        ]
        for name, sign in (("PLUS", 1.0), ("MINUS", -1.0)):
            thickness, angle = number(thickness_mm / 2.0), number(sign * angle_deg)
            lines.append(f"{thickness}, 3, CFRP, {angle}, {leg}-{name}")
    return [*lines, "*END PART"]


def band_lines(model: AbaqusModel, tyre: TyreGeometry) -> list[str]:
    """Write the part of shear band and tread."""
    part = band_part(model.mesh, tyre)
    return [
        THIN_RULE,
        *comment(
            f"BAND: shear band ({tyre.shear_band_thickness_mm:g} mm thick, its wires in the "
            f"middle) and tread, of one rubber (tables 3 and 4). {len(part.elements)} C3D8H bricks "
            "(table 4: 33480 C3D8H/C3D6H). NEUTRAL: nodes of the band's neutral line near the "
            "middle of the tyre's width (figure 14)."
        ),
        "*PART, NAME=BAND",
        *_mesh(part, "C3D8H"),
        "*SURFACE, NAME=INSIDE, TYPE=ELEMENT",
        "INSIDE, S1",
        "*SURFACE, NAME=OUTSIDE, TYPE=ELEMENT",
        "OUTSIDE, S2",
        "*SOLID SECTION, ELSET=BAND, MATERIAL=BAND-RUBBER",
        "*SOLID SECTION, ELSET=TREAD, MATERIAL=BAND-RUBBER",
        "*END PART",
    ]


def wires_lines(model: AbaqusModel, tyre: TyreGeometry) -> list[str]:
    """Write the part of the steel wire layers.

    Raises
    ------
    InputError
        If the layers cannot be shared equally by the two diameters.
    """
    if tyre.wire_layers % 2:
        raise InputError(
            "half of the wire layers lie inside, half outside",
            "give an even number",
            column="tyre.wire_layers",
            value=tyre.wire_layers,
        )
    part = wires_part(model.mesh, tyre)
    area = np.pi / 4.0 * tyre.wire_diameter_mm**2
    lines = [
        THIN_RULE,
        *comment(
            f"WIRES: {tyre.wire_layers} layers of steel wire around the tyre (section 3.2, table "
            f"3), half of them at diameter {tyre.inner_wire_diameter_mm:g} mm, half at "
            f"{tyre.outer_wire_diameter_mm:g} mm; wires of {tyre.wire_diameter_mm:g} mm diameter "
            f"every {tyre.wire_pitch_mm:g} mm. Each layer is a rebar layer, as in the paper. The "
            "layers lie in surface elements, which have no stiffness of their own: the paper's S4R "
            "would need a shell material and a thickness, which it does not give."
        ),
        "*PART, NAME=WIRES",
        *_mesh(part, "SFM3D4R"),
        *comment(
            "local 1 around the tyre, local 2 along its axis: the radial axis 1 of the cylindrical "
            "system is the normal"
        ),
        "*ORIENTATION, NAME=HOOP, SYSTEM=CYLINDRICAL",
        "0., 0., 0., 0., 0., 1.",
        "1, 0.",
    ]
    for place in ("INNER", "OUTER"):
        lines += [
            f"*SURFACE SECTION, ELSET={place}",
            "*REBAR LAYER, ORIENTATION=HOOP",
            "** layer, area of a wire (mm2), spacing (mm), -, material, angle from local 1 (deg)",
        ]
        for layer in range(1, tyre.wire_layers // 2 + 1):
            pitch = number(tyre.wire_pitch_mm)
            lines.append(f"{place}-{layer}, {number(area)}, {pitch}, , STEEL, 0.")
    return [*lines, "*END PART"]


def ground_lines(tyre: TyreGeometry) -> list[str]:
    """Write the part of the road."""
    reach = tyre.outer_diameter_mm
    return [
        THIN_RULE,
        *comment(
            "GROUND: the road, an analytical rigid plane (section 3.2). Drawn from left to right, "
            "its outward normal points up to the tyre. REF: its reference node."
        ),
        "*PART, NAME=GROUND",
        "*NODE, NSET=REF",
        "1, 0., 0., 0.",
        "*SURFACE, NAME=PLANE, TYPE=CYLINDER",
        f"START, {number(-reach)}, 0.",
        f"LINE, {number(reach)}, 0.",
        "*RIGID BODY, REF NODE=REF, ANALYTICAL SURFACE=PLANE",
        "*END PART",
    ]


def _mesh(part: DeckPart, element: str) -> list[str]:
    """Nodes, elements and sets of a part."""
    lines = ["*NODE"]
    for label, position in enumerate(part.positions, 1):
        lines.append(f"{label}, {numbers(position)}")
    lines.append(f"*ELEMENT, TYPE={element}")
    for label, nodes in enumerate(part.elements.tolist(), 1):
        lines.append(", ".join(map(str, [label, *nodes])))
    for name, labels in part.node_sets.items():
        lines += [f"*NSET, NSET={name}", *members(labels.tolist())]
    for name, labels in part.element_sets.items():
        lines += [f"*ELSET, ELSET={name}", *members(labels.tolist())]
    return lines
