"""The Abaqus deck of a case: the paper's whole tyre, loaded on a rigid plane.

Keywords, their parameters and data lines are those of the Abaqus Keywords Reference Guide.
"""

from __future__ import annotations

from collections.abc import Mapping

from nptcs.config.solvers.abaqus import AbaqusModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.decks.abaqus.mesh import check_radii, spoke_part
from nptcs.decks.abaqus.parts import (
    band_lines,
    ground_lines,
    plates_lines,
    spoke_text,
    wires_lines,
)
from nptcs.decks.abaqus.text import RULE, comment, members, number, numbers

RIM, GROUND = "RIM-REF", "GROUND-REF"
"""Node sets whose displacement and reaction are printed to the .dat file."""


def tyre_deck(
    model: AbaqusModel,
    tyre: TyreGeometry,
    ply: Mapping[str, float],
    values: Mapping[str, float],
    load_n: float,
    case_id: str,
) -> str:
    """Write the complete deck of one case.

    Parameters
    ----------
    model : AbaqusModel
        Spoke section, mesh, friction and increments.
    tyre : TyreGeometry
    ply : mapping
        The nine ply constants.
    values : mapping
        ``spacing_mm``, ``thickness_mm``, ``angle_deg``, ``spoke_c10_mpa``,
        ``shear_band_c10_mpa``.
    load_n : float
        Vertical load at the end of the step, N.
    case_id : str
        For the heading only.

    Raises
    ------
    InputError
        If spoke, rim and band do not fit, or the wire layers are odd in number.
    """
    check_radii(model.geometry, tyre)
    plate = (values["spacing_mm"], values["thickness_mm"], values["angle_deg"])
    lines = [
        *_heading(values, load_n, case_id),
        *spoke_text(model, tyre),
        *plates_lines(model, tyre, *plate),
        *band_lines(model, tyre),
        *wires_lines(model, tyre),
        *ground_lines(tyre),
        *_instances(model, tyre),
        *_joints(model, tyre),
        *_materials(tyre, ply, values),
        *_contact(model),
        *_supports(),
        *_step(model, load_n),
        *_output(),
        "*END STEP",
    ]
    return "\n".join(lines) + "\n"


def _heading(values: Mapping[str, float], load_n: float, case_id: str) -> list[str]:
    return [
        "*HEADING",
        f"Non-pneumatic tyre with composite spokes on a rigid plane, case {case_id}",
        RULE,
        *comment("The finite element tyre of Sun et al., Machines 2024, 12, 358, section 3.2."),
        *comment("Units: N, mm, MPa. X along the road, Y up, Z the tyre's axis; origin: hub."),
        *comment(
            f"Plates: spacing S {values['spacing_mm']:g} mm, thickness T "
            f"{values['thickness_mm']:g} mm, fibre angle A {values['angle_deg']:g} degrees."
        ),
        *comment(
            f"Rubbers: C10 {values['spoke_c10_mpa']:g} MPa in the spokes, "
            f"{values['shear_band_c10_mpa']:g} MPa in shear band and tread."
        ),
        *comment(f"Load: {load_n:g} N. Vertical stiffness = load / settlement of the rim."),
        RULE,
        "*PREPRINT, ECHO=NO, MODEL=NO, HISTORY=NO, CONTACT=NO",
    ]


def _names(tyre: TyreGeometry) -> list[str]:
    return [f"{i + 1:02d}" for i in range(tyre.spoke_count)]


def _instances(model: AbaqusModel, tyre: TyreGeometry) -> list[str]:
    """Open the assembly and place the parts."""
    pitch = 360.0 / tyre.spoke_count
    lines = [
        RULE,
        *comment(
            f"ASSEMBLY: {tyre.spoke_count} spokes every {pitch:g} degrees, all pointing the same "
            "way. The road touches the tread. Placing a part: translation, then two points of an "
            "axis and an angle in degrees."
        ),
        "*ASSEMBLY, NAME=TYRE",
        "*INSTANCE, NAME=BAND-1, PART=BAND",
        "*END INSTANCE",
        "*INSTANCE, NAME=WIRES-1, PART=WIRES",
        "*END INSTANCE",
        "*INSTANCE, NAME=GROUND-1, PART=GROUND",
        numbers([0.0, -tyre.outer_diameter_mm / 2.0, 0.0]),
        "*END INSTANCE",
    ]
    for i, name in enumerate(_names(tyre)):
        angle = model.first_spoke_deg + i * pitch
        for part in ("SPOKE", "PLATES"):
            lines.append(f"*INSTANCE, NAME={part}-{name}, PART={part}")
            if angle != 0.0:
                lines += ["0., 0., 0.", numbers([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, angle])]
            lines.append("*END INSTANCE")
    return lines


def _joints(model: AbaqusModel, tyre: TyreGeometry) -> list[str]:
    """Join the parts and close the assembly."""
    names = _names(tyre)
    rim_foot = members(spoke_part(model.geometry, model.mesh, tyre).node_sets["RIMFOOT"].tolist())
    lines = [
        *comment(
            "the rim: a rigid body of all nodes of the spokes' inner feet (section 3.2); its "
            "reference node is the wheel's centre"
        ),
        "*NODE",
        "1, 0., 0., 0.",
        f"*NSET, NSET={RIM}",
        "1,",
        *[
            line
            for name in names
            for line in (f"*NSET, NSET=RIM, INSTANCE=SPOKE-{name}", *rim_foot)
        ],
        f"*RIGID BODY, REF NODE={RIM}, PIN NSET=RIM",
        f"*NSET, NSET={GROUND}, INSTANCE=GROUND-1",
        "1,",
        *comment(
            "outer feet tied to the inside of the band (section 3.2); the flat feet lie less than "
            "0.1 mm off its cylinder and are moved onto it"
        ),
        "*TIE, NAME=FEET, POSITION TOLERANCE=0.5, ADJUST=YES, TYPE=SURFACE TO SURFACE",
        *[f"SPOKE-{name}.FOOT, BAND-1.INSIDE" for name in names],
        *comment("plates embedded in the rubber of their spoke, wires in the band (section 3.2)"),
    ]
    for name in names:
        lines += [
            f"*EMBEDDED ELEMENT, HOST ELSET=SPOKE-{name}.RUBBER",
            f"PLATES-{name}.LOWER, PLATES-{name}.UPPER",
        ]
    return [
        *lines,
        "*EMBEDDED ELEMENT, HOST ELSET=BAND-1.BAND",
        "WIRES-1.INNER, WIRES-1.OUTER",
        "*END ASSEMBLY",
    ]


def _materials(
    tyre: TyreGeometry, ply: Mapping[str, float], values: Mapping[str, float]
) -> list[str]:
    lines = [
        RULE,
        *comment("MATERIALS. Rubber: neo-Hooke (equation 1): C10 (MPa), D1 = 0: incompressible."),
    ]
    for name, key in (("SPOKE-RUBBER", "spoke_c10_mpa"), ("BAND-RUBBER", "shear_band_c10_mpa")):
        lines += [
            f"*MATERIAL, NAME={name}",
            "*HYPERELASTIC, NEO HOOKE",
            numbers([values[key], 0.0]),
        ]
    lamina = ("e1_mpa", "e2_mpa", "nu12", "g12_mpa", "g13_mpa", "g23_mpa")
    return [
        *lines,
        *comment(
            "ply (table 2) in plane stress, as in every shell: E1, E2 (MPa), nu12, G12, G13, G23 "
            "(MPa); E3, nu13 and nu23 do not enter"
        ),
        "*MATERIAL, NAME=CFRP",
        "*ELASTIC, TYPE=LAMINA",
        numbers(ply[name] for name in lamina),
        *comment("steel wire (section 3.2): Young's modulus (MPa), Poisson's ratio"),
        "*MATERIAL, NAME=STEEL",
        "*ELASTIC",
        numbers([tyre.wire_modulus_mpa, tyre.wire_poisson_ratio]),
    ]


def _contact(model: AbaqusModel) -> list[str]:
    return [
        RULE,
        *comment(
            "CONTACT of tread and road: hard, Coulomb friction (section 3.2). Nodes within 0.01 mm "
            "start in contact, so that the load finds a support in the first increment."
        ),
        "*SURFACE INTERACTION, NAME=ROAD",
        "*FRICTION",
        f"{number(model.friction)},",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD",
        "*CONTACT PAIR, INTERACTION=ROAD, TYPE=SURFACE TO SURFACE, ADJUST=0.01",
        "BAND-1.OUTSIDE, GROUND-1.PLANE",
    ]


def _supports() -> list[str]:
    return [
        RULE,
        *comment("SUPPORTS: the road is fixed, the rim moves only up and down (figure 7)"),
        "*BOUNDARY",
        f"{GROUND}, 1, 6",
        f"{RIM}, 1, 1",
        f"{RIM}, 3, 6",
        *comment("the load grows linearly with time (section 3.2)"),
        "*AMPLITUDE, NAME=LINEAR",
        "0., 0., 1., 1.",
    ]


def _step(model: AbaqusModel, load_n: float) -> list[str]:
    first, smallest, largest = model.increments
    return [
        RULE,
        *comment(
            "STEP: static, 1 s, large displacements; the load acts at the rim's centre (section "
            "3.2). Data of *STATIC: first increment, duration, smallest and largest increment (s)."
        ),
        "*STEP, NAME=LOAD, NLGEOM=YES, INC=1000",
        "*STATIC",
        numbers([first, 1.0, smallest, largest]),
        "*CLOAD, AMPLITUDE=LINEAR",
        f"{RIM}, 2, {number(-load_n)}",
    ]


def _output() -> list[str]:
    return [
        *comment(
            "text output (.dat): settlement of the rim (mm) and reaction of the road (N) at each "
            "increment, places of the deformed neutral line (mm) at the end"
        ),
        f"*NODE PRINT, NSET={RIM}, FREQUENCY=1, SUMMARY=NO",
        "U2",
        f"*NODE PRINT, NSET={GROUND}, FREQUENCY=1, SUMMARY=NO",
        "RF2",
        "*NODE PRINT, NSET=BAND-1.NEUTRAL, FREQUENCY=1000, SUMMARY=NO",
        "COORD",
        *comment("output database (.odb)"),
        "*OUTPUT, FIELD, NUMBER INTERVAL=10, TIME MARKS=NO",
        "*NODE OUTPUT",
        "U, RF, COORD",
        "*ELEMENT OUTPUT",
        "S, LE",
        "*CONTACT OUTPUT",
        "CSTRESS, CDISP",
        "*OUTPUT, HISTORY, FREQUENCY=1",
        f"*NODE OUTPUT, NSET={RIM}",
        "U2",
        f"*NODE OUTPUT, NSET={GROUND}",
        "RF1, RF2",
    ]
