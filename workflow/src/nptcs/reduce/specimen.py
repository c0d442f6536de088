"""From one curve to the properties of one specimen."""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

import pandas as pd

from nptcs.config.materials.ingest import Plausible
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.mechanical_tests import TestType
from nptcs.reduce.curve.branch import Branch, loading_branch
from nptcs.reduce.curve.evidence import Evidence, evidence_of_failure
from nptcs.reduce.deviations import CROSSHEAD, deviations, speed_properties
from nptcs.reduce.plausible import only_plausible
from nptcs.reduce.rows import Property, to_table
from nptcs.reduce.standards.compression import reduce_compression
from nptcs.reduce.standards.flexure import reduce_flexure
from nptcs.reduce.standards.rubber import reduce_rubber
from nptcs.reduce.standards.rubber_compression import reduce_rubber_compression
from nptcs.reduce.standards.shear import reduce_shear
from nptcs.reduce.standards.tension import reduce_tension
from nptcs.reduce.strain_origin import StrainOrigin, strain_origin_of, with_origin
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.specimens import Specimen


def reduce_specimen(
    curve: pd.DataFrame,
    specimen: Specimen,
    settings: ReductionSettings,
    strain_source: str = "",
    flags: Iterable[str] = (),
    *,
    failure_seen: bool = False,
    plausible: Plausible | None = None,
    origin: StrainOrigin | None = None,
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
        Flags of the ingest record; they are added to every value.
    failure_seen : bool
        Whether the ingest saw the specimen fail, before it cut what follows. Without it (and
        without a statement in the sheet) the curve itself must show a failure, or strength,
        ultimate strain and energy are not assessed.
    plausible : Plausible, optional
        The limits of the curve; a value outside them is not assessed either.
    origin : StrainOrigin, optional
        Shift and error of the strain origin; they enter the standard errors.

    Returns
    -------
    DataFrame
        `nptcs.tables.laboratory.properties.PropertiesTable`. A property that the data cannot give
        is a row with an empty value and a flag "not assessed: …".

    Raises
    ------
    InputError
        If the curve has no load in the direction of the test, or fewer loadings than the sheet
        asks for.
    """
    branch = loading_branch(curve, specimen)
    told = list(flags)
    evidence = evidence_of_failure(branch.turned, specimen, failure_seen, told)
    rules = settings.rules(specimen.test)
    found = deviations(branch, specimen, rules, strain_source, evidence)
    # the ingest record says it in its own words
    if any(flag.startswith(CROSSHEAD) for flag in told):
        found = tuple(flag for flag in found if not flag.startswith(CROSSHEAD))
    remarks = [*branch.words, *found, *told]

    def reduce(of: Branch) -> list[Property]:
        return _reduce(of, evidence, specimen, settings, strain_source)

    reduced = reduce(branch)
    if origin is not None:
        reduced = with_origin(reduced, origin, branch, specimen.test.load_sign, reduce)
    rows = [
        *reduced,
        *speed_properties(branch, rules.title, evidence),
    ]
    limits = plausible or Plausible()
    judged = (only_plausible(row, specimen.test, limits) for row in rows)
    return to_table((row.flagged(remarks) for row in judged), specimen)


def reduce_record(
    curve: pd.DataFrame,
    specimen: Specimen,
    record: IngestRecord,
    settings: ReductionSettings,
    plausible: Plausible | None = None,
) -> pd.DataFrame:
    """Reduce one curve with all that its ingest record says of it.

    Parameters
    ----------
    curve, specimen, settings, plausible
        As for `reduce_specimen`.
    record : IngestRecord
        Strain source, flags and whether the specimen was seen to fail.
    """
    return reduce_specimen(
        curve,
        specimen,
        settings,
        record.strain_source,
        record.flags,
        failure_seen=record.failure_seen,
        plausible=plausible,
        origin=strain_origin_of(record),
    )


def _reduce(
    branch: Branch,
    evidence: Evidence,
    specimen: Specimen,
    settings: ReductionSettings,
    strain_source: str,
) -> list[Property]:
    match specimen.test:
        case TestType.TENSION:
            return reduce_tension(branch, settings.tension(), evidence)
        case TestType.COMPRESSION:
            return reduce_compression(branch, settings.astm_d6641, evidence)
        case TestType.SHEAR:
            return reduce_shear(branch, settings.shear(), evidence)
        case TestType.FLEXURE:
            bar = specimen.bar
            assert bar is not None, "the sheet refuses a bending test without its span"
            return reduce_flexure(branch, settings.flexure(), bar, strain_source, evidence)
        case TestType.RUBBER_TENSION | TestType.RUBBER_EQUIBIAXIAL | TestType.RUBBER_PURE_SHEAR:
            return reduce_rubber(branch, settings.rubber(), evidence)
        case TestType.RUBBER_COMPRESSION:
            rules = settings.rubber_compression()
            return reduce_rubber_compression(branch.rows, rules, specimen.platens)
        case _:
            assert_never(specimen.test)
