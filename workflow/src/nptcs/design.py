"""Full-factorial design tables, numbered as tables 5 and 7 of the paper are."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

import pandas as pd

from nptcs.config.study import Level, MeasuredRubber, Study
from nptcs.errors import InputError


def full_factorial(study: Study, rubber_c10_mpa: Mapping[str, float]) -> pd.DataFrame:
    """Build the design table of a study.

    The last factor of the configuration changes fastest, so that spacing × thickness × angle
    gives the numbering of table 5 and T-C × S-C that of table 7.

    Parameters
    ----------
    study : Study
        Factors with their levels, and the fixed values.
    rubber_c10_mpa : mapping of str to float
        C10 of each tested rubber that a level or a fixed value names.

    Returns
    -------
    DataFrame
        ``case_id`` (``plate_017``), ``case`` (from 1), a column for each factor, then one for
        each fixed value.

    Raises
    ------
    InputError
        When a level names a rubber that has no card, or two levels of a factor coincide.

    Examples
    --------
    >>> from nptcs.config.study import Study
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
    table = pd.DataFrame(list(product(*levels.values())), columns=list(levels), dtype=float)
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
