"""Headings of columns whose names do not state the unit, for the rows of the catalogue."""

from __future__ import annotations

from nptcs.tables.result_table import Heading

IMPACT = {
    "gradient": Heading("gradient", "N/mm per unit of the factor"),
    "range": Heading("range", "unit of the factor"),
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
QUALITY = {
    "residual_sd": Heading("residual SD", "N/mm"),
    "largest_residual": Heading("largest residual", "N/mm"),
}
RESPONSES = {"value": Heading("value", "unit of the row")}
