"""What a test shows of failure: from the sheet, from the ingest record, from the curve."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

from nptcs.loading import judge_failure
from nptcs.tables.specimens import Specimen


@dataclass(frozen=True)
class Evidence:
    """Whether a specimen failed; `reason` says why what needs failure is not assessed."""

    failed: bool
    reason: str = ""
    remarks: tuple[str, ...] = ()


def evidence_of_failure(turned: pd.DataFrame, specimen: Specimen, failure_seen: bool) -> Evidence:
    """Judge whether the specimen failed: as the sheet states, else as the record shows.

    Parameters
    ----------
    turned : DataFrame
        The whole curve, load positive.
    specimen : Specimen
        Its row of the sheet, whose column ``failed`` decides where it is filled in.
    failure_seen : bool
        What the ingest found in the raw record, before it cut what follows failure.
    """
    if specimen.failed is True:
        return Evidence(True, remarks=("failure as the sheet states it",))
    if specimen.failed is False:
        return Evidence(False, "stopped before failure, as the sheet states")
    if failure_seen:
        return Evidence(True)
    stress, strain = (turned[name].to_numpy(dtype=float) for name in ("stress_mpa", "strain_axial"))
    found = judge_failure(stress, strain)
    if found.seen:
        return Evidence(True)
    return Evidence(False, f"no failure seen ({found.words})")
