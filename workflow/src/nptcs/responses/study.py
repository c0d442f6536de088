"""The responses of one study to which surfaces are fitted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from nptcs.campaign.cases import read_tyres
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.config.studies.study import Study
from nptcs.responses.strength import ply_strengths
from nptcs.responses.table import tyre_responses
from nptcs.tables.io import read_tables
from nptcs.tables.laboratory.statistics import StatisticsTable


def study_responses(
    study: Study, records: Sequence[str], statistics: Sequence[str], job: Mapping[str, Any]
) -> pd.DataFrame | None:
    """Gather the responses of a study's solved tyres, at all loads that its surfaces need.

    Parameters
    ----------
    study : Study
    records : sequence of str
        Batch files of its cases.
    statistics : sequence of str
        ``statistics.csv``, for the strengths of the ply.
    job : mapping
        ``settings`` (`TyreResponseSettings`) and ``ply`` (name of the ply, or None).

    Returns
    -------
    DataFrame or None
        `nptcs.tables.tyres.tyre_responses.TyreResponses`; None for a study without further
        responses.
    """
    if not study.responses:
        return None
    settings = TyreResponseSettings.model_validate(job["settings"])
    strengths = ply_strengths(read_tables(statistics, StatisticsTable), job["ply"])
    return tyre_responses(read_tyres(records), with_places(settings, study), strengths)


def with_places(settings: TyreResponseSettings, *studies: Study) -> TyreResponseSettings:
    """Add the loads and displacements of the responses of studies to those of the settings."""
    choices = [choice for study in studies for choice in study.responses]
    loads = {choice.load_n for choice in choices if choice.load_n is not None}
    displacements = {c.displacement_mm for c in choices if c.displacement_mm is not None}
    return settings.model_copy(
        update={
            "loads_n": tuple(sorted({*settings.loads_n, *loads})),
            "displacements_mm": tuple(sorted({*settings.displacements_mm, *displacements})),
        }
    )
