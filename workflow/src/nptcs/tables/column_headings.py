"""Headings of columns whose names do not state the unit, for the rows of the catalogue."""

from __future__ import annotations

from collections.abc import Mapping

import pandera.pandas as pa

from nptcs.tables.result_table import Heading

IMPACT = {
    "gradient": Heading("gradient", "N/mm per unit of the factor"),
    "range": Heading("range", "unit of the factor"),
    "nominal_range": Heading("range of the levels", "unit of the factor"),
    "impact": Heading("impact", "N/mm"),
    "published_gradient": Heading("published gradient", "N/mm per unit of the factor"),
    "published_impact": Heading("published impact", "N/mm"),
    "difference_percent": Heading("difference", "%"),
    "published_rank": Heading("published rank"),
}
SURFACE = {
    "coefficient_natural": Heading("coefficient, natural", "N/mm per unit of the term"),
    "coefficient_coded": Heading("coefficient, coded", "N/mm"),
    "standard_error": Heading("standard error, natural", "N/mm per unit of the term"),
    "standard_error_coded": Heading("standard error, coded", "N/mm"),
    "published_coefficient": Heading("published coefficient (FE)", "N/mm per unit of the term"),
}
SPOKE = {
    f"{prefix}{direction}_r2{suffix}": Heading(f"{prefix.replace('_', ' ')}{direction} R²{kind}")
    for direction in ("tension", "compression")
    for prefix, suffix, kind in (
        ("", "_uncentred", ", uncentred"),
        ("", "_centred", ", centred"),
        ("published_", "", ""),
    )
}
ERRORS = {
    "compared": Heading("cases compared"),
    "largest_case_id": Heading("case of the largest"),
}
LEVELS = {
    "level": Heading("level", "unit of the factor"),
    "compared": Heading("cases compared"),
}
EXPONENTS = {
    "held": Heading("other factors at"),
    "levels": Heading("levels"),
    "computed_exponent": Heading("computed"),
    "published_exponent": Heading("published"),
    "exponent_difference": Heading("computed − published"),
}
QUALITY = {
    "press": Heading("PRESS", "(N/mm)²"),
    "residual_sd": Heading("residual SD", "N/mm"),
    "largest_residual": Heading("largest residual", "N/mm"),
}
RESPONSES = {"value": Heading("value", "unit of the row")}
RESPONSE_SURFACES = {
    name: Heading(words, "unit of the row")
    for name, words in {
        "smallest": "smallest",
        "largest": "largest",
        "largest_residual": "largest residual",
        "left_out_largest": "left out, largest error",
        "left_out_rms": "left out, rms error",
    }.items()
} | {
    "left_out_largest_percent": Heading("left out, largest error", "%"),
    "left_out_rms_percent": Heading("left out, rms error", "%"),
    "coverage_percent": Heading("in the 95 % interval", "%"),
}
RESPONSE_IMPACT = {
    name: Heading(words, "unit of the row")
    for name, words in {
        "impact": "impact, mean |slope| × range",
        "signed_impact": "mean slope × range",
        "effect": "effect, √ST × SD",
    }.items()
} | {name: Heading(name, "unit of the factor") for name in ("lowest", "highest")}
COMPARISON = {
    "largest_residual": Heading("largest residual", "N/mm"),
    "leave_one_out_largest": Heading("leave-one-out, largest", "N/mm"),
    "leave_one_out_rms": Heading("leave-one-out, rms", "N/mm"),
    "leave_one_out_not_fitted": Heading("leave-one-out, not fitted"),
    "coverage_percent": Heading("in the 95 % interval", "%"),
    "level_out_largest": Heading("level left out, largest", "N/mm"),
    "level_out_not_fitted": Heading("level left out, not fitted"),
}
BY_FACTOR = {
    "level_out_largest": Heading("level left out, largest", "N/mm"),
    "lowest": Heading("lowest", "unit of the factor"),
    "highest": Heading("highest", "unit of the factor"),
    "rising_percent": Heading("steps that rise", "%"),
    "falling_percent": Heading("steps that fall", "%"),
}
DIAGNOSTICS = {
    "coefficient_coded": Heading("coefficient, coded", "N/mm"),
    "confidence_low": Heading("95 % interval from", "N/mm"),
    "confidence_high": Heading("95 % interval to", "N/mm"),
    "sequential_ss": Heading("sequential sum of squares", "(N/mm)²"),
    "partial_ss": Heading("partial sum of squares", "(N/mm)²"),
    "mean_square": Heading("mean square", "(N/mm)²"),
    "response": Heading("response", "N/mm"),
    "residual": Heading("residual", "N/mm"),
    "left_out_residual": Heading("left-out residual", "N/mm"),
    "value": Heading("value", "unit of the factor"),
    "press": Heading("PRESS", "(N/mm)²"),
}
SOBOL = {
    "cut_percent": Heading("cut off", "%"),
    "index": Heading("first order, or interaction"),
    "index_confidence": Heading("± first order"),
    "total_confidence": Heading("± total"),
    "value": Heading("value", "unit of the factor"),
    "effect_n_per_mm": Heading("effect", "N/mm"),
}
UNCERTAINTY = {
    name: Heading(words, "unit of the row")
    for name, words in {
        "nominal": "nominal",
        "mean": "mean",
        "sd": "SD",
        "low": "interval from",
        "high": "interval to",
        "effect_sd": "SD by this source",
    }.items()
}
DECISION = {
    "with_probability": Heading("required probability"),
    "search_cpu_s": Heading("fit and search, CPU", "s"),
    "mean": Heading("mean", "unit of the row"),
    "sd": Heading("SD", "unit of the row"),
    "low": Heading("interval from", "unit of the row"),
    "high": Heading("interval to", "unit of the row"),
    "smallest_accepted": Heading("smallest accepted", "unit of the row"),
    "largest_accepted": Heading("largest accepted", "unit of the row"),
    "predicted": Heading("predicted", "unit of the row"),
    "solved": Heading("solved", "unit of the row"),
    "difference": Heading("difference", "unit of the row"),
}


def of(headings: Mapping[str, Heading], contract: type[pa.DataFrameModel]) -> dict[str, Heading]:
    """Return those of the headings whose columns the contract has."""
    columns = contract.to_schema().columns
    return {name: heading for name, heading in headings.items() if name in columns}
