"""The loading branch that a reduction or a fit starts from, and how it was chosen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.arrays import Array, Rows
from nptcs.errors import InputError
from nptcs.loading import Loading, loadings
from nptcs.tables.laboratory.specimens import Specimen

SMALLEST_SET = 0.002
"""A smaller strain that is left at the start of a later loading is not subtracted."""


@dataclass(frozen=True)
class Branch:
    """Rows of a test, load positive.

    Parameters
    ----------
    rows : DataFrame
        The chosen loading: one branch, from its start to its largest force.
    to_peak : DataFrame
        The whole record up to its largest force, which belongs to the last row.
    turned : DataFrame
        The whole record.
    reaches_peak : bool
        Whether the chosen loading ends at the largest force of the record.
    words : tuple of str
        How many loadings were found and which one was taken; empty where there is only one.
    """

    rows: pd.DataFrame
    to_peak: pd.DataFrame
    turned: pd.DataFrame
    reaches_peak: bool
    words: tuple[str, ...] = ()


def loading_branch(curve: pd.DataFrame, specimen: Specimen) -> Branch:
    """Turn a curve so that its load is positive, and take the loading that the sheet names.

    Parameters
    ----------
    curve : DataFrame
        Columns time_s, force_n, stress_mpa, strain_axial, …; tension positive.
    specimen : Specimen
        A compression test is turned over: force, stress and strains come out positive when
        compressive (axial) so that all reductions see a growing load. The column ``loading``
        says which loading of several is taken.

    Raises
    ------
    InputError
        If no row has a finite force, the load has the wrong sign, or the record has fewer
        loadings than the sheet asks for.
    """
    turned = _turned(curve, specimen)
    stress, strain = (turned[name].to_numpy(dtype=float) for name in ("stress_mpa", "strain_axial"))
    found = loadings(stress, strain)
    peak = int(np.argmax(stress))
    to_peak = turned.iloc[: peak + 1].reset_index(drop=True)
    if len(found) == 1:
        _one_at_least(specimen, found)
        return Branch(to_peak, to_peak, turned, True)
    kept, name = _chosen(stress, strain, found, specimen)
    rows = turned.iloc[kept].reset_index(drop=True)
    words = [f"{len(found)} loadings in the record, {name} taken"]
    if specimen.test.is_rubber and name != "the first" and name != "their envelope":
        rows, set_words = _without_set(rows)
        words += set_words
    return Branch(rows, to_peak, turned, int(kept[-1]) == peak, tuple(words))


def _turned(curve: pd.DataFrame, specimen: Specimen) -> pd.DataFrame:
    turned = curve.loc[np.isfinite(curve["stress_mpa"])].reset_index(drop=True)
    sign = specimen.test.load_sign
    mirrored = [c for c in turned.columns if c != "time_s"]
    turned = turned.assign(**{c: sign * turned[c] for c in mirrored})
    peak = float("nan") if turned.empty else float(turned["stress_mpa"].max())
    if not peak > 0:
        raise InputError(
            f"no {'tensile' if sign > 0 else 'compressive'} load",
            "check the test type and the sign of the force",
            specimen=specimen.specimen,
            column="stress_mpa",
            value=peak,
        )
    return turned


def _one_at_least(specimen: Specimen, found: list[Loading]) -> None:
    """Refuse the number of a loading that the record does not have."""
    if specimen.loading.isdigit() and int(specimen.loading) > len(found):
        raise InputError(
            f"the record has {len(found)} loading{'s' if len(found) > 1 else ''}",
            "write the number of one of them, first, last or envelope",
            specimen=specimen.specimen,
            column="loading",
            value=specimen.loading,
        )


def _chosen(
    stress: Array, strain: Array, found: list[Loading], specimen: Specimen
) -> tuple[Rows, str]:
    """Rows of the loading that the sheet names, and its name in words."""
    _one_at_least(specimen, found)
    choice = specimen.loading
    if choice == "envelope":
        return _envelope(stress, strain, found), "their envelope"
    numbers = {"first": 1, "last": len(found)}
    number = numbers[choice] if choice in numbers else int(choice)
    loading = found[number - 1]
    name = "the first" if number == 1 else f"number {number}"
    return np.arange(loading.start, loading.stop), name


def _envelope(stress: Array, strain: Array, found: list[Loading]) -> Rows:
    """Rows of all loadings beyond the strain reached before: the virgin curve.

    Without a strain there, the force decides.
    """
    course = strain if np.isfinite(strain).sum() >= 3 else stress
    kept: list[int] = []
    reached = -np.inf
    for loading in found:
        for row in range(loading.start, loading.stop):
            if course[row] > reached or (loading is found[0]):
                kept.append(row)
        reached = max(reached, float(np.nanmax(course[loading.rows])))
    return np.array(kept)


def _without_set(rows: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Count strain and stress of a later loading from the length that the earlier ones left.

    With the set ε0, strain (ε - ε0)/(1 + ε0) and stress σ (1 + ε0): the piece is longer, and at
    constant volume thinner.
    """
    measured = rows.loc[rows["strain_axial"].notna()]
    if measured.empty:
        return rows, []
    strain = float(measured["strain_axial"].iloc[0])
    if strain <= SMALLEST_SET:
        return rows, []
    stress = float(measured["stress_mpa"].iloc[0])
    share = stress / float(rows["stress_mpa"].max())
    if share > 0.05:
        return rows, [f"it begins at strain {strain:.4g} under {100 * share:.3g} % of its load"]
    scale = 1 + strain
    rows = rows.assign(
        strain_axial=(rows["strain_axial"] - strain) / scale, stress_mpa=rows["stress_mpa"] * scale
    )
    return rows, [f"strain counted from the set of {strain:.4g} that the earlier loadings left"]
