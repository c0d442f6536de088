"""What the finite element solvers check in a case before they compute."""

from __future__ import annotations

from collections.abc import Mapping

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.solvers.contract import CaseInputs
from nptcs.tables.laboratory.material_card import PLY_CONSTANTS

SPOKE_FACTORS = frozenset({"spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa"})
TYRE_FACTORS = SPOKE_FACTORS | {"shear_band_c10_mpa"}


def checked_values(inputs: CaseInputs, names: frozenset[str]) -> dict[str, float]:
    """Return the case's values of these factors.

    Raises
    ------
    InputError
        If one is missing, a dimension or modulus is not positive, or the plates overlap.
    """
    values: dict[str, float] = {}
    for name in sorted(names):
        if name not in inputs.values:
            raise InputError(
                "the finite element model needs this value",
                "give it as a factor or a fixed value of the study",
                column=name,
                specimen=inputs.case_id,
            )
        values[name] = float(inputs.values[name])
        if name != "angle_deg" and not values[name] > 0.0:
            raise InputError(
                "must be positive",
                "give a number above zero",
                column=name,
                specimen=inputs.case_id,
                value=values[name],
            )
    if values["spacing_mm"] <= inputs.tyre.plate_width_mm:
        raise InputError(
            f"plates {inputs.tyre.plate_width_mm:g} mm wide overlap at this spacing",
            "choose a spacing above the plate's width",
            column="spacing_mm",
            specimen=inputs.case_id,
            value=values["spacing_mm"],
        )
    return values


def ply_constants(inputs: CaseInputs) -> Mapping[str, float]:
    """Return the ply's nine constants.

    Raises
    ------
    InputError
        If the material card names no ply, or not all of its constants.
    """
    missing = [name for name in PLY_CONSTANTS if name not in (inputs.ply or {})]
    if inputs.ply is None or missing:
        raise InputError(
            f"the finite element model needs the ply's constants, missing: {', '.join(missing)}",
            "name a ply of the material card in the study",
            specimen=inputs.case_id,
        )
    return inputs.ply


def realised_spacing(values: Mapping[str, float], tyre: TyreGeometry) -> dict[str, float]:
    """Return the pitch of the plates in mm: a whole number of them shares the tyre's width."""
    return {"spacing_mm": tyre.tread_width_mm / tyre.plates_across(values["spacing_mm"])}
