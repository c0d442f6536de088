"""Margins of the plates: the stress at their faces compared with the ply's tested strengths."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.arrays import Array

# strength: test, orientation of the specimens and property of the statistics table
TESTED = {
    "xt_mpa": ("tension", 0.0, "strength"),
    "xc_mpa": ("compression", 0.0, "strength"),
    "yt_mpa": ("tension", 90.0, "strength"),
    "yc_mpa": ("compression", 90.0, "strength"),
    "s12_mpa": ("shear", None, "shear_strength"),
}


@dataclass(frozen=True)
class PlyStrengths:
    """Strengths of the ply, positive, MPa; None for one that is not tested.

    Parameters
    ----------
    xt_mpa, xc_mpa : float or None
        Along the fibres in tension and compression.
    yt_mpa, yc_mpa : float or None
        Across the fibres.
    s12_mpa : float or None
        In-plane shear.
    """

    xt_mpa: float | None = None
    xc_mpa: float | None = None
    yt_mpa: float | None = None
    yc_mpa: float | None = None
    s12_mpa: float | None = None

    def missing(self) -> list[str]:
        """Name the strengths that are not tested."""
        return [name.removesuffix("_mpa") for name in TESTED if getattr(self, name) is None]


def ply_strengths(statistics: pd.DataFrame, material: str | None) -> PlyStrengths:
    """Take the strengths of a ply from the statistics of its tests.

    Each is the reported statistic (mean or median) of its group of specimens, the lowest if there
    are several groups; a group whose statistic is empty is left out.

    Parameters
    ----------
    statistics : DataFrame
        `StatisticsTable`.
    material : str or None
        Name of the ply's material in the specimen sheet; without one there are no strengths.
    """
    if material is None:
        return PlyStrengths()
    rows = statistics[(statistics["material"] == material) & (statistics["scope"] == "group")]
    return PlyStrengths(**{name: _reported(rows, *place) for name, place in TESTED.items()})


def _reported(
    rows: pd.DataFrame, test: str, orientation_deg: float | None, name: str
) -> float | None:
    found = rows[(rows["test"] == test) & (rows["property"] == name)]
    if orientation_deg is not None:
        found = found[found["orientation_deg"] == orientation_deg]
    values = [row[row["reported_statistic"]] for row in found.to_dict("records")]
    values = [float(value) for value in values if np.isfinite(value) and value > 0.0]
    return min(values, default=None)


def maximum_stress_factor(stress: Array, strengths: PlyStrengths) -> float:
    """Factor by which all stresses may grow until one of them reaches its strength.

    Parameters
    ----------
    stress : array (points, 3)
        σ1, σ2, τ12 in the fibre axes, MPa.
    strengths : PlyStrengths
        All of them tested.
    """
    xt, xc, yt, yc, s12 = _all_of(strengths)
    along, across, shear = stress.T
    used = np.concatenate([along / xt, -along / xc, across / yt, -across / yc, np.abs(shear) / s12])
    largest = float(used.max())
    return np.inf if largest <= 0.0 else 1.0 / largest


def tsai_wu_factor(stress: Array, strengths: PlyStrengths) -> float:
    """Factor by which all stresses may grow until the Tsai–Wu criterion is met somewhere.

    F1 σ1 + F2 σ2 + F11 σ1² + F22 σ2² + F66 τ12² + 2 F12 σ1 σ2 = 1 (Tsai and Wu 1971), with
    F12 = -½ √(F11 F22), which no uniaxial test gives.

    Parameters
    ----------
    stress : array (points, 3)
        σ1, σ2, τ12 in the fibre axes, MPa.
    strengths : PlyStrengths
        All of them tested.
    """
    xt, xc, yt, yc, s12 = _all_of(strengths)
    along, across, shear = stress.T
    f11, f22 = 1.0 / (xt * xc), 1.0 / (yt * yc)
    linear = (1.0 / xt - 1.0 / xc) * along + (1.0 / yt - 1.0 / yc) * across
    square = f11 * along**2 + f22 * across**2 + (shear / s12) ** 2
    square -= np.sqrt(f11 * f22) * along * across
    # 2 / (b + √(b² + 4a)) is the positive root of a R² + b R = 1, also where a is small
    below = linear + np.sqrt(linear**2 + 4.0 * square)
    largest = float(below.max())
    return np.inf if largest <= 0.0 else 2.0 / largest


def _all_of(strengths: PlyStrengths) -> tuple[float, ...]:
    values = tuple(getattr(strengths, name) for name in TESTED)
    if None in values:
        raise ValueError(f"not tested: {', '.join(strengths.missing())}")
    return values
