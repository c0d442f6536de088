"""Displacement against load by finite elements next to the load-bearing model, figure 15."""

from __future__ import annotations

from itertools import product

import numpy as np
import pandas as pd

from nptcs.lca.section import PHYSICAL_SECTION
from nptcs.responses.curve import LoadCurve
from nptcs.tables.tyres.displacement_by_load import DisplacementByLoad

FIDUCIAL_PLATES = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
"""The plates of table 11's tyres: the paper's fiducial ones."""

OK, NOT_ASSESSED, NOT_REACHED = "ok", "not assessed", "not reached"
LCA = {
    "displacement_mm": "lca_displacement_mm",
    "published_displacement_mm": "published_lca_displacement_mm",
    "published_largest_error_percent": "published_largest_error_percent",
}
"""Column of ``lca_validation.csv`` → column of this table."""


def displacement_by_load(
    cases: pd.DataFrame, curves: pd.DataFrame, validation: pd.DataFrame, shear_band_c10_mpa: float
) -> pd.DataFrame:
    """Read the displacement at each load of figure 15 from the curves of the solved tyres.

    Of several cases that are the same tyre, the one with the largest load is read. The difference
    is that of the stiffness, 100 (δ_FE/δ_LCA - 1), as the paper's relative error is.

    Parameters
    ----------
    cases : DataFrame
        `nptcs.tables.tyres.cases.Cases`, with the factors and fixed values of each case.
    curves : DataFrame
        `nptcs.tables.tyres.tyre_responses.TyreCurves`.
    validation : DataFrame
        `nptcs.tables.published.lca_validation.LcaValidation`: loads and spoke rubbers come from it.
    shear_band_c10_mpa : float
        C10 of the band in table 11 (MPa).

    Returns
    -------
    DataFrame
        `DisplacementByLoad`; no rows if no solver computed such a tyre with its plates.
    """
    model = validation[validation["section"].eq(PHYSICAL_SECTION)]
    tyres = same_tyres(cases, curves, shear_band_c10_mpa)
    by_case = {key: rows for key, rows in curves.groupby(["solver", "case_id"], sort=False)}
    rows = []
    for solver, lca in product(tyres["solver"].unique(), model.to_dict("records")):
        mine = tyres[
            tyres["solver"].eq(solver) & np.isclose(tyres["spoke_c10_mpa"], lca["spoke_c10_mpa"])
        ].sort_values("load_n")
        case_id = str(mine["case_id"].iloc[-1]) if len(mine) else ""
        found = displacement(by_case.get((solver, case_id)), lca["load_n"])
        fem = lca["published_fem_stiffness_n_per_mm"]
        rows.append(
            {
                "solver": solver,
                "case_id": case_id,
                "shear_band_c10_mpa": shear_band_c10_mpa,
                "spoke_c10_mpa": lca["spoke_c10_mpa"],
                "load_n": lca["load_n"],
                **dict(zip(("status", "note", "displacement_mm"), found, strict=True)),
                **{name: lca[column] for column, name in LCA.items()},
                "lca_difference_percent": 100 * (found[2] / lca["displacement_mm"] - 1),
                "published_fem_displacement_mm": lca["load_n"] / fem,
            }
        )
    return pd.DataFrame(rows, columns=list(DisplacementByLoad.to_schema().columns))


def same_tyres(
    cases: pd.DataFrame, curves: pd.DataFrame, shear_band_c10_mpa: float
) -> pd.DataFrame:
    """Take the cases with table 11's band and plates that have a curve."""
    wanted = {**FIDUCIAL_PLATES, "shear_band_c10_mpa": shear_band_c10_mpa}
    if not {*wanted, "spoke_c10_mpa"} <= set(cases):
        return cases.iloc[:0].reindex(columns=["solver", "case_id", "spoke_c10_mpa", "load_n"])
    same = np.isclose(cases[list(wanted)], list(wanted.values())).all(axis=1)
    drawn = cases.merge(curves[["solver", "case_id"]].drop_duplicates(), how="left", indicator=True)
    # a solver without plates, such as the load-bearing model, uses no whole number of them
    realised = cases.reindex(columns=["realised_spacing_mm"]).notna().to_numpy().ravel()
    return cases[same & realised & drawn["_merge"].eq("both").to_numpy()]


def displacement(curve: pd.DataFrame | None, load_n: float) -> tuple[str, str, float]:
    """Return status, reason and displacement (mm) of a curve at a load."""
    if curve is None:
        return NOT_ASSESSED, "no solved case is this tyre", np.nan
    try:
        line = LoadCurve(curve["displacement_mm"].to_numpy(), curve["force_n"].to_numpy())
    except ValueError as error:
        return NOT_ASSESSED, str(error), np.nan
    point = line.at_load(load_n)
    if point is None:
        return NOT_REACHED, f"the curve ends at {line.last_load_n:g} N", np.nan
    return OK, "", point.displacement_mm
