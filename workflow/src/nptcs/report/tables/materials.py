"""The material card as tables."""

from __future__ import annotations

import pandas as pd

from nptcs.report.data import Results
from nptcs.report.tables.headings import words

CONSTANT_COLUMNS = [
    "material",
    "constant",
    "value",
    "standard_error",
    "unit",
    "origin",
    "rule",
    "specimens",
    "synthetic",
]


def ply_table(results: Results) -> pd.DataFrame:
    """Write the constants of all plies, one row per constant."""
    return pd.DataFrame(
        [
            {
                "material": ply.name,
                "constant": words(name.removesuffix("_mpa")),
                "value": quantity.value,
                "standard_error": quantity.standard_error,
                "unit": quantity.unit,
                "origin": quantity.origin,
                "rule": quantity.rule,
                "specimens": ", ".join(quantity.specimens),
                "synthetic": "yes" if ply.synthetic else "no",
            }
            for ply in results.card.plies.values()
            for name, quantity in ply.constants.items()
        ],
        columns=CONSTANT_COLUMNS,
    ).astype({"value": float, "standard_error": float})


def rubber_table(results: Results) -> pd.DataFrame:
    """Write the constants of all rubbers, with range and quality of the fit."""
    rows = [
        {
            "material": rubber.name,
            "model": rubber.model,
            "constant": words(name.removesuffix("_mpa")),
            "value": quantity.value,
            "standard_error": quantity.standard_error,
            "unit": quantity.unit,
            "strain_low": rubber.strain_range[0],
            "strain_high": rubber.strain_range[1],
            **{key: _yes_no(key, value) for key, value in rubber.fit_quality.items()},
            "origin": quantity.origin,
            "rule": quantity.rule,
            "specimens": ", ".join(quantity.specimens),
            "synthetic": "yes" if rubber.synthetic else "no",
        }
        for rubber in results.card.rubbers.values()
        for name, quantity in rubber.constants.items()
    ]
    table = pd.DataFrame(rows, columns=None if rows else CONSTANT_COLUMNS)
    return table.astype({"value": float, "standard_error": float})


def _yes_no(name: str, value: float) -> float | str:
    """Write a quality that is true or false, such as Drucker stability, as yes or no."""
    if name.endswith("_stable"):
        return "yes" if value else "no"
    return value
