"""From one curve to the properties of one specimen."""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

import pandas as pd

from nptcs.config.reduction import ReductionSettings
from nptcs.mechanical_tests import TestType
from nptcs.reduce.compression import reduce_compression
from nptcs.reduce.deviations import CROSSHEAD, deviations, speed_properties
from nptcs.reduce.rows import Property, loading_branch, to_table
from nptcs.reduce.rubber import reduce_rubber
from nptcs.reduce.shear import reduce_shear
from nptcs.reduce.tension import reduce_tension
from nptcs.tables.specimens import Specimen


def reduce_specimen(
    curve: pd.DataFrame,
    specimen: Specimen,
    settings: ReductionSettings,
    strain_source: str = "",
    flags: Iterable[str] = (),
) -> pd.DataFrame:
    """Reduce one curve to properties by the standard in force for its test.

    Parameters
    ----------
    curve : DataFrame
        Tidy curve: time_s, force_n, stress_mpa, strain_axial, strain_transverse,
        strain_axial_back; tension positive.
    specimen : Specimen
        Row of the specimen sheet.
    settings : ReductionSettings
        Standards and ranges.
    strain_source : str
        Where the strain came from, as the ingest record says; "crosshead" is flagged.
    flags : iterable of str
        Flags of the ingest record; they go with every value.

    Returns
    -------
    DataFrame
        `nptcs.tables.properties.PropertiesTable`. A property that the data cannot give is a
        row with an empty value and a flag "not assessed: …".

    Raises
    ------
    InputError
        If the curve has no load in the direction of the test.
    """
    branch = loading_branch(curve, specimen)
    rules = settings.rules(specimen.test)
    told = list(flags)
    found = deviations(branch, specimen, rules, strain_source)
    # the ingest record says it in its own words
    if any(flag.startswith(CROSSHEAD) for flag in told):
        found = tuple(flag for flag in found if not flag.startswith(CROSSHEAD))
    remarks = [*found, *told]
    rows = [*_reduce(branch, specimen, settings), *speed_properties(branch, rules.title)]
    return to_table((row.flagged(remarks) for row in rows), specimen)


def _reduce(
    branch: pd.DataFrame, specimen: Specimen, settings: ReductionSettings
) -> list[Property]:
    match specimen.test:
        case TestType.TENSION:
            return reduce_tension(branch, settings.tension())
        case TestType.COMPRESSION:
            return reduce_compression(branch, settings.astm_d6641)
        case TestType.SHEAR:
            return reduce_shear(branch, settings.shear())
        case TestType.RUBBER_TENSION | TestType.RUBBER_EQUIBIAXIAL | TestType.RUBBER_PURE_SHEAR:
            return reduce_rubber(branch, settings.rubber())
        case _:
            assert_never(specimen.test)
