"""All that one rubber's curves give: its card, and the tables of other models and ranges."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from nptcs.calibrate.compare import c10_against_range, compare_models
from nptcs.calibrate.rubber import calibrate_rubber
from nptcs.calibrate.strain_sources import without_travel_next_to_sensors
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.reduce.strain_origin import strain_origins_of
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.material_card import RubberCard
from nptcs.tables.laboratory.specimens import Specimen


def calibrate_rubber_tables(
    name: str,
    curves: Mapping[str, pd.DataFrame],
    specimens: Sequence[Specimen],
    settings: CalibrationSettings,
    records: Sequence[IngestRecord],
) -> tuple[RubberCard, pd.DataFrame, pd.DataFrame]:
    """Fit the card's model, the models compared with it and the growing ranges.

    Parameters
    ----------
    name : str
        Material in the sheet.
    curves : mapping of str to DataFrame
        `nptcs.tables.laboratory.curves.Curve` by specimen; an empty one was not read and is
        skipped.
    specimens : sequence of Specimen
        Rows of the sheet, repeated data left out.
    settings : CalibrationSettings
        The section ``calibration`` of the configuration.
    records : sequence of IngestRecord
        Strain sources and strain origins come from these.

    Returns
    -------
    card : RubberCard
    models : DataFrame
        `nptcs.tables.laboratory.hyperelastic.ModelComparison`.
    ranges : DataFrame
        `nptcs.tables.laboratory.hyperelastic.RangeTable`.
    """
    usable = {specimen: curve for specimen, curve in curves.items() if len(curve)}
    sources = {record.specimen: record.strain_source for record in records}
    words: list[str] = []
    if settings.rubber.only_specimen is None:
        specimens, words = without_travel_next_to_sensors(name, specimens, sources)
    data = (name, usable, specimens, settings)
    origins = strain_origins_of(records)
    card = calibrate_rubber(*data, sources, origins)
    return (
        card.model_copy(update={"checks": (*card.checks, *words)}),
        compare_models(*data, origins),
        c10_against_range(*data, origins),
    )
