"""What a test shows of failure: from the sheet, from the ingest record, from the curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.loading import judge_failure
from nptcs.tables.specimens import Specimen

SLIPPED = "transducer of travel slipped"
TAKEN_OFF = (
    "the force record ends at its largest value; taken for failure, since the strain ends before, "
    "as where a gauge is taken off for the way to failure"
)
TAKEN_OFF_SHARE = 0.95


@dataclass(frozen=True)
class Evidence:
    """Whether a specimen failed; `reason` says why what needs failure is not assessed."""

    failed: bool
    reason: str = ""
    remarks: tuple[str, ...] = ()


def evidence_of_failure(
    turned: pd.DataFrame, specimen: Specimen, failure_seen: bool, flags: Sequence[str] = ()
) -> Evidence:
    """Judge whether the specimen failed: as the sheet states, else as the record shows.

    Parameters
    ----------
    turned : DataFrame
        The whole curve, load positive.
    specimen : Specimen
        Its row of the sheet, whose column ``failed`` decides where it is filled in.
    failure_seen : bool
        What the ingest found in the raw record, before it cut what follows failure.
    flags : sequence of str
        Flags of the ingest record.
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
    if _taken_off(stress, strain) and not any(flag.startswith(SLIPPED) for flag in flags):
        return Evidence(True, remarks=(TAKEN_OFF,))
    return Evidence(False, f"no failure seen ({found.words})")


def _taken_off(stress: Array, strain: Array) -> bool:
    """Whether the strain was measured, and ended well below a largest force at the very end."""
    seen = np.flatnonzero(np.isfinite(strain))
    if len(seen) < 3 or int(np.argmax(stress)) < len(stress) - 3:
        return False
    return bool(stress[: seen[-1] + 1].max() < TAKEN_OFF_SHARE * stress.max())
