"""The tables of one study's surfaces, next to the published coefficients: tables 6 and 8."""

from __future__ import annotations

import pandas as pd
import pandera.pandas as pa

from nptcs.compare.coefficients import by_powers
from nptcs.compare.conditions import surface_faults
from nptcs.config.studies.study import Study
from nptcs.files import write_text
from nptcs.surface.sensitivity.response_tables import response_surfaces
from nptcs.surface.stored import dump, dump_registry
from nptcs.surface.study import StudySurfaces
from nptcs.surface.tables import comparison_tables, quality_table, surface_table
from nptcs.tables.analysis.response_surfaces import ResponseSurfaces
from nptcs.tables.analysis.surface import (
    SurfaceByFactor,
    SurfaceComparison,
    SurfaceQuality,
    SurfaceTable,
)
from nptcs.tables.problems import Problems

Checked = tuple[pd.DataFrame, type[pa.DataFrameModel]]


def study_tables(study: Study, done: StudySurfaces, published: pd.DataFrame) -> dict[str, Checked]:
    """Return each table of a study's surfaces with its contract.

    Parameters
    ----------
    study : Study
    done : StudySurfaces
        Result of `nptcs.surface.study.fit_study`.
    published : DataFrame
        `nptcs.tables.published.inputs.PublishedCoefficients`; may be empty. They are left out
        if the study is not under their conditions (`nptcs.compare.conditions`).

    Returns
    -------
    dict
        ``table``, ``quality``, ``comparison``, ``by_factor``, ``responses`` and ``problems``.
    """
    factors = [factor.name for factor in study.factors]
    powers = {} if surface_faults(study) else by_powers(published, factors)
    comparison, by_factor = comparison_tables(done)
    return {
        "table": (surface_table(done.polynomials, powers), SurfaceTable),
        "quality": (quality_table(done), SurfaceQuality),
        "comparison": (comparison, SurfaceComparison),
        "by_factor": (by_factor, SurfaceByFactor),
        "responses": (response_surfaces(done), ResponseSurfaces),
        "problems": (done.problems, Problems),
    }


def write_surfaces(done: StudySurfaces, polynomials: str, registry: str) -> None:
    """Write the polynomials of tables 6 and 8, and all surfaces of the study, as sealed files."""
    write_text(polynomials, dump(done.polynomials))
    write_text(registry, dump_registry(done.registry()))
