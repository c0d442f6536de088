"""Compression of rubber discs: ISO 7743 and ASTM D575."""

from __future__ import annotations

from typing import assert_never

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.materials.reduction import RubberCompressionRules
from nptcs.reduce.rows import Property, finite_pair
from nptcs.reduce.standards.rubber import stress_at
from nptcs.tables.laboratory.specimen import Platens


def reduce_rubber_compression(
    branch: pd.DataFrame, rules: RubberCompressionRules, platens: Platens
) -> list[Property]:
    """Stress at given compressions and the secant modulus stress over strain there.

    Nominal stress F/A0 against compression Δh/h0, both positive (ISO 7743: modulus at 10 and
    20 %). With dry or bonded platens the disc barrels: both values then belong to the disc and its
    shape, not to the material.

    Parameters
    ----------
    branch : DataFrame
        Loading branch turned over (compression positive): stress_mpa, strain_axial.
    rules : RubberCompressionRules
        Section of the standard in force.
    platens : str
        As stated in the sheet; empty where it is not.
    """
    strain, stress = finite_pair(branch, "strain_axial", "stress_mpa")
    rows: list[Property] = []
    for percent in rules.compressions_percent:
        at = stress_at(strain, stress, percent, rules)
        rows += [at, _secant(at, percent, strain, rules)]
    return [row.flagged(_platen_words(platens)) for row in rows]


def _secant(at: Property, percent: float, strain: Array, rules: RubberCompressionRules) -> Property:
    rule = f"{rules.title}, stress over strain at {percent:g} % compression"
    value = at.value / (percent / 100)
    points = at.points if np.isfinite(value) else 0
    name = f"compression_modulus_at_{percent:g}_percent"
    return Property(name, value, "MPa", rule, points=points, flags=at.flags)


def disc_barrels(platens: Platens) -> bool | None:
    """Tell whether friction makes a disc barrel; None where the platens are not stated."""
    match platens:
        case "lubricated":
            return False
        case "dry" | "bonded":
            return True
        case "":
            return None
        case _:
            assert_never(platens)


def _platen_words(platens: Platens) -> list[str]:
    barrels = disc_barrels(platens)
    if barrels is None:
        return ["lubrication of the platens not stated: friction stiffens the disc"]
    if barrels:
        return [f"{platens} platens: value of the disc and its shape, not of the material"]
    return []
