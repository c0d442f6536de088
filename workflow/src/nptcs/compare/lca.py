"""The load-bearing model compared with table 11, the loads of figure 15 and table 7's FE values.

Published numbers come in as tables. For figure 15's FE results the paper prints only the largest
error of its model at each load, so away from table 11's load our results can be compared with that
error only.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.lca.batch import solve_batch
from nptcs.lca.neutral_line import neutral_line
from nptcs.lca.section import SECTION_KINDS, SectionKind, ShearBandSection
from nptcs.lca.single import design_row, solve
from nptcs.lca.spokes.stiffness_table import SpokeStiffnessTable

TABLE_11_SHEAR_BAND_C10_MPA = 5.0
_COMPARED = {
    "theta_c_deg": "theta_c_deg",
    "theta_t_deg": "theta_t_deg",
    "displacement_mm": "lca_displacement_mm",
    "stiffness_n_per_mm": "lca_stiffness_n_per_mm",
}
"""Our column → column of table 11."""
_COMPUTED_ALONE = ("contact_length_mm", "mean_pressure_mpa", "balance_residual")


def _solve_cases(
    cases: pd.DataFrame, spoke_table: pd.DataFrame, tyre: TyreGeometry, section: SectionKind
) -> pd.DataFrame:
    """Solve rows of shear_band_c10_mpa, spoke_c10_mpa and load_n; returns the model's columns."""
    spokes = SpokeStiffnessTable.from_rows(spoke_table.to_dict("records"))
    designs = pd.DataFrame(
        [
            design_row(
                ShearBandSection.from_tyre(tyre, band, section),
                spokes.spokes(spoke, tyre.spoke_count),
            )
            for band, spoke in zip(cases["shear_band_c10_mpa"], cases["spoke_c10_mpa"], strict=True)
        ]
    )
    batch = solve_batch(
        {str(name): designs[name].to_numpy() for name in designs}, load_n=cases["load_n"].to_numpy()
    )
    solved = pd.DataFrame(batch.columns).drop(columns="load_n")
    angle = np.radians(solved["theta_c_deg"])
    return solved.assign(contact_length_mm=2 * designs["radius_mm"] * angle)


def _percent(computed: pd.Series[float], published: pd.Series[float]) -> pd.Series[float]:
    """Difference of the computed from the published value, in percent of the published one."""
    return 100 * (computed / published - 1)


def lca_validation(
    spoke_table: pd.DataFrame,
    table_11: pd.DataFrame,
    load_errors: pd.DataFrame,
    tyre: TyreGeometry,
    sections: Sequence[SectionKind] = SECTION_KINDS,
    shear_band_c10_mpa: float = TABLE_11_SHEAR_BAND_C10_MPA,
) -> pd.DataFrame:
    """Return the rows of ``lca_validation.csv``.

    Parameters
    ----------
    spoke_table : DataFrame
        Table 10: spoke_c10_mpa, tension_stiffness_n_per_mm, compression_stiffness_n_per_mm.
    table_11 : DataFrame
        Table 11: spoke_c10_mpa, lca_force_n, theta_c_deg, theta_t_deg, lca_displacement_mm,
        lca_stiffness_n_per_mm, fem_stiffness_n_per_mm.
    load_errors : DataFrame
        Figure 15: load_n, largest_relative_error_percent of the paper's model.
    tyre : TyreGeometry
        The tyre.
    sections : sequence of {"sandwich", "printed"}
        Sections to solve with.
    shear_band_c10_mpa : float
        C10 of the band in table 11 and figure 15 (MPa).
    """
    errors = load_errors.astype(float).rename(
        columns={"largest_relative_error_percent": "published_largest_error_percent"}
    )
    parts = []
    for section in sections:
        cases = (
            table_11[["spoke_c10_mpa"]]
            .astype(float)
            .merge(errors[["load_n", "published_largest_error_percent"]], how="cross")
        )
        solved = _solve_cases(
            cases.assign(shear_band_c10_mpa=shear_band_c10_mpa), spoke_table, tyre, section
        )
        part = pd.concat([cases, solved[[*_COMPARED, *_COMPUTED_ALONE]]], axis=1)
        part.insert(0, "section", section)
        parts.append(part)
    compared = _with_table_11(pd.concat(parts, ignore_index=True), table_11)
    last = "published_largest_error_percent"
    return compared[[*compared.columns.drop(last), last]]


def _with_table_11(computed: pd.DataFrame, table_11: pd.DataFrame) -> pd.DataFrame:
    """Join table 11 where C10 and load agree, and take the differences."""
    names = {column: f"published_{name}" for name, column in _COMPARED.items()}
    names["fem_stiffness_n_per_mm"] = "published_fem_stiffness_n_per_mm"
    published = table_11.rename(columns=names | {"lca_force_n": "load_n"})
    keys = ["spoke_c10_mpa", "load_n"]
    published = published[[*keys, *names.values()]].astype(float)
    joined = computed.merge(published, on=keys, how="left", validate="many_to_one")
    for name in _COMPARED:
        quantity = name.removesuffix("_deg").removesuffix("_mm").removesuffix("_n_per_mm")
        quantity = "stiffness" if name == "stiffness_n_per_mm" else quantity
        joined[f"{quantity}_difference_percent"] = _percent(
            joined[name], joined[f"published_{name}"]
        )
    joined["fem_difference_percent"] = _percent(
        joined["stiffness_n_per_mm"], joined["published_fem_stiffness_n_per_mm"]
    )
    return joined


def lca_against_fem(
    spoke_table: pd.DataFrame,
    table_7: pd.DataFrame,
    tyre: TyreGeometry,
    sections: Sequence[SectionKind] = SECTION_KINDS,
    load_n: float = 5000.0,
) -> pd.DataFrame:
    """Compare the model with the FE stiffness of table 7 (`LcaAgainstFem`).

    Parameters
    ----------
    spoke_table : DataFrame
        Table 10.
    table_7 : DataFrame
        Table 7: case, shear_band_c10_mpa, spoke_c10_mpa, stiffness_n_per_mm.
    tyre : TyreGeometry
        The tyre.
    sections : sequence of {"sandwich", "printed"}
        Sections to solve with.
    load_n : float
        Load of the FE results (N).
    """
    parts = []
    for section in sections:
        part = table_7[["case", "shear_band_c10_mpa", "spoke_c10_mpa"]].copy()
        part[["shear_band_c10_mpa", "spoke_c10_mpa"]] *= 1.0
        part["load_n"] = float(load_n)
        solved = _solve_cases(part, spoke_table, tyre, section)
        part["stiffness_n_per_mm"] = solved["stiffness_n_per_mm"].to_numpy()
        part["published_fem_stiffness_n_per_mm"] = table_7["stiffness_n_per_mm"]
        part["fem_difference_percent"] = _percent(
            part["stiffness_n_per_mm"], part["published_fem_stiffness_n_per_mm"]
        )
        part.insert(0, "section", section)
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def ring_neutral_lines(
    spoke_table: pd.DataFrame,
    table_11: pd.DataFrame,
    tyre: TyreGeometry,
    section: SectionKind = "sandwich",
    shear_band_c10_mpa: float = TABLE_11_SHEAR_BAND_C10_MPA,
    points: int = 721,
) -> pd.DataFrame:
    """Return the neutral lines of table 11's designs under its loads (contract `LcaNeutralLine`).

    Parameters
    ----------
    spoke_table, table_11 : DataFrame
        Tables 10 and 11.
    tyre : TyreGeometry
        The tyre.
    section : {"sandwich", "printed"}
        Section to solve with.
    shear_band_c10_mpa : float
        C10 of the band (MPa).
    points : int
        Points around each ring.
    """
    spokes = SpokeStiffnessTable.from_rows(spoke_table.to_dict("records"))
    ring = ShearBandSection.from_tyre(tyre, shear_band_c10_mpa, section)
    lines = []
    for c10, load in zip(table_11["spoke_c10_mpa"], table_11["lca_force_n"], strict=True):
        state = solve(ring, spokes.spokes(float(c10), tyre.spoke_count), load_n=float(load))
        line = neutral_line(state, points)
        for name, value in (("load_n", load), ("spoke_c10_mpa", c10)):
            line.insert(0, name, float(value))
        line.insert(0, "section", section)
        lines.append(line)
    return pd.concat(lines, ignore_index=True)
