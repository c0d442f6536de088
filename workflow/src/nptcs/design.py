"""Design tables: full factorial, numbered like tables 5 and 7 of the paper, and other kinds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import assert_never

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.design import (
    BoxBehnken,
    CentralComposite,
    DOptimal,
    FullFactorial,
    SpaceFilling,
    SplitPlot,
)
from nptcs.config.studies.study import Level, MeasuredRubber, Study
from nptcs.doe.d_optimal import d_optimal
from nptcs.doe.points import box_behnken, central_composite, space_filling
from nptcs.doe.split_plot import split_plot
from nptcs.doe.whole_plates import whole_plates
from nptcs.errors import InputError
from nptcs.terms import parse

DIGITS = 6
"""Significant digits of the values of cases between the levels."""


def build_design(
    study: Study, rubber_c10_mpa: Mapping[str, float], tyre: TyreGeometry
) -> pd.DataFrame:
    """Build the design table of a study.

    Parameters
    ----------
    study : Study
        Factors with their levels, the fixed values, and the kind of design.
    rubber_c10_mpa : mapping of str to float
        C10 of each tested rubber that a level or a fixed value names.
    tyre : TyreGeometry
        Its width decides which spacings give a whole number of plates.

    Returns
    -------
    DataFrame
        ``case_id`` (``plate_017``), ``case`` (from 1), one column for each factor, then one for
        each fixed value.

    Raises
    ------
    InputError
        If a level names a rubber that has no card, two levels of a factor coincide, the design
        needs values between tested rubbers, or it does not suit the number of factors or cases.
    """
    levels = _levels(study, rubber_c10_mpa)
    design = study.design
    match design:
        case FullFactorial():
            points = _combinations(levels)
        case SpaceFilling():
            coded = space_filling(design.kind, design.cases, len(levels), design.seed)
            points = _between(study, levels, coded)
        case CentralComposite():
            coded = central_composite(len(levels), design.axial, design.centre_cases)
            points = _between(study, levels, coded)
        case BoxBehnken():
            points = _between(study, levels, box_behnken(len(levels), design.centre_cases))
        case SplitPlot():
            points = _between(study, levels, _on_plots(list(levels), design), design.log_spaced)
        case DOptimal():
            points = _chosen(levels, design, tyre)
        case _:
            assert_never(design)
    if not isinstance(design, FullFactorial | DOptimal) and design.whole_plates:
        points = whole_plates(points, list(levels), tyre)
    table = pd.DataFrame(points, columns=list(levels), dtype=float)
    if study.further_cases:
        further = pd.DataFrame(list(study.further_cases))[list(levels)]
        table = pd.concat([table, further], ignore_index=True)
    return _numbered(table, study, rubber_c10_mpa)


def full_factorial(study: Study, rubber_c10_mpa: Mapping[str, float]) -> pd.DataFrame:
    """Build the table of all combinations of the levels, whatever the design of the study.

    The last factor of the configuration changes fastest, so that spacing × thickness × angle
    gives the numbering of table 5 and T-C × S-C that of table 7. Parameters, result and errors
    are those of `build_design`, without the tyre.

    Examples
    --------
    >>> from nptcs.config.studies.study import Study
    >>> angle = {"name": "angle_deg", "label": "A", "unit": "deg", "levels": [0, 45, 90]}
    >>> spacing = {"name": "spacing_mm", "label": "S", "unit": "mm", "levels": [10, 20]}
    >>> study = Study(name="plate", title="", factors=[spacing, angle], solvers=["fe_tyre"])
    >>> print(full_factorial(study, {}).to_string(index=False))
      case_id  case  spacing_mm  angle_deg
    plate_001     1        10.0        0.0
    plate_002     2        10.0       45.0
    plate_003     3        10.0       90.0
    plate_004     4        20.0        0.0
    plate_005     5        20.0       45.0
    plate_006     6        20.0       90.0
    """
    points = _combinations(_levels(study, rubber_c10_mpa))
    names = [factor.name for factor in study.factors]
    return _numbered(pd.DataFrame(points, columns=names), study, rubber_c10_mpa)


def _levels(study: Study, rubber_c10_mpa: Mapping[str, float]) -> dict[str, list[float]]:
    """Return the numbers of the levels of each factor."""
    levels = {
        factor.name: [
            _number(level, rubber_c10_mpa, f"studies.{study.name}.factors.{factor.name}")
            for level in factor.levels
        ]
        for factor in study.factors
    }
    for name, values in levels.items():
        if len(set(values)) < len(values):
            raise InputError(
                f"two levels of {name} have the same value",
                column=f"studies.{study.name}.factors.{name}",
                value=values,
                remedy="give levels that differ",
            )
    return levels


def _combinations(levels: Mapping[str, list[float]]) -> Array:
    return np.array(list(product(*levels.values())), dtype=float)


def _on_plots(factors: list[str], design: SplitPlot) -> Array:
    """Coded points of a split-plot design, columns in the order of the factors."""
    hard = [name for name in factors if name in design.hard_to_change]
    easy = [name for name in factors if name not in design.hard_to_change]
    coded = split_plot(
        len(hard), len(easy), design.whole_plots, design.cases_per_plot, design.corners, design.seed
    )
    order = [*hard, *easy]
    return coded[:, [order.index(name) for name in factors]]


def _between(
    study: Study,
    levels: Mapping[str, list[float]],
    coded: Array,
    log_spaced: Sequence[str] = (),
) -> Array:
    """Map coded points to the box between the lowest and the highest level of each factor."""
    for factor in study.factors:
        if any(isinstance(level, MeasuredRubber) for level in factor.levels):
            raise InputError(
                "this kind of design needs values between the levels, which tested rubbers do not "
                "have",
                column=f"studies.{study.name}.factors.{factor.name}",
                value=study.design.kind,
                remedy="use full_factorial or d_optimal, or give numbers as levels",
            )
    low, high = (np.array([side(values) for values in levels.values()]) for side in (min, max))
    points = (low + high) / 2 + coded * (high - low) / 2
    for name in log_spaced:
        axis = list(levels).index(name)
        part = (coded[:, axis] + 1) / 2
        points[:, axis] = low[axis] * (high[axis] / low[axis]) ** part
    rounded = [[float(f"{value:.{DIGITS}g}") for value in point] for point in points]
    return np.clip(np.array(rounded), low, high)


def _chosen(levels: Mapping[str, list[float]], design: DOptimal, tyre: TyreGeometry) -> Array:
    """Choose the best cases among all combinations of the levels."""
    factors = list(levels)
    points = _combinations(levels)
    if design.whole_plates:
        points = np.unique(whole_plates(points, factors, tyre), axis=0)
    low, high = points.min(axis=0), points.max(axis=0)
    polynomial = parse(design.terms, factors)
    matrix = polynomial.matrix((points - (low + high) / 2) / ((high - low) / 2))
    return points[d_optimal(matrix, design.cases, design.starts, design.seed)]


def _numbered(
    table: pd.DataFrame, study: Study, rubber_c10_mpa: Mapping[str, float]
) -> pd.DataFrame:
    """Add the fixed values and the numbers of the cases."""
    for name, level in study.fixed.items():
        table[name] = _number(level, rubber_c10_mpa, f"studies.{study.name}.fixed.{name}")
    digits = max(3, len(str(len(table))))
    numbers = range(1, len(table) + 1)
    table.insert(0, "case_id", [f"{study.name}_{number:0{digits}d}" for number in numbers])
    table.insert(1, "case", list(numbers))
    return table


def _number(level: Level, rubber_c10_mpa: Mapping[str, float], key: str) -> float:
    """Return the number that a level stands for."""
    if not isinstance(level, MeasuredRubber):
        return float(level)
    if level.rubber not in rubber_c10_mpa:
        known = ", ".join(sorted(rubber_c10_mpa)) or "none"
        raise InputError(
            "this rubber has no material card",
            column=key,
            value=level.rubber,
            remedy=f"name a rubber of the specimen sheet (known: {known})",
        )
    return rubber_c10_mpa[level.rubber]
