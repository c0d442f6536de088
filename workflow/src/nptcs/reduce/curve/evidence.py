"""What a test shows of failure: from the sheet, from the ingest record, from the curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.loading import judge_failure
from nptcs.tables.laboratory.specimens import Specimen

NOT_BY_HAND = ("transducer of travel slipped", "stands still", "moves back")
"""Flags of strains that end because the sensor failed, not because somebody took it off."""
UNRECORDED = "failure not recorded"
TAKEN_OFF = (
    f"{UNRECORDED}: the force record ends at its largest value, long after the gauge was taken "
    "off (counts only if the sheet states failed: yes)"
)
TAKEN_OFF_SHARE = 0.8
"""Share of the largest force: a gauge that comes off above it is no sign of a test to failure."""
FULL_RATE = 0.5
"""Share of the usual rate at which the force must still grow at the end of such a record."""


@dataclass(frozen=True)
class Evidence:
    """Whether a specimen failed; `reason` says why values that need failure are not assessed.

    A failure that is not `recorded` is likely, but no reading shows it: the largest stress is
    given and flagged, and enters no mean.
    """

    failed: bool
    reason: str = ""
    remarks: tuple[str, ...] = ()
    recorded: bool = True

    @property
    def not_seen(self) -> str:
        """Reason why values at failure are not assessed; empty where failure was recorded."""
        return self.reason if not self.failed else "" if self.recorded else UNRECORDED


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
    if not np.isfinite(strain).any():
        # without a strain a quick return of the machine looks like a break
        return Evidence(False, "no failure seen in force and travel")
    found = judge_failure(stress, strain, turned["time_s"].to_numpy(dtype=float))
    if found.seen:
        return Evidence(True)
    by_hand = not any(word in flag for flag in flags for word in NOT_BY_HAND)
    if by_hand and _taken_off(stress, strain):
        return Evidence(True, remarks=(TAKEN_OFF,), recorded=False)
    return Evidence(False, f"no failure seen ({found.words})")


def _taken_off(stress: Array, strain: Array) -> bool:
    """Whether the strain ends well below a largest force that is reached at full rate, at the end.

    A test that is stopped slows down, holds or unloads; its gauge stays on, or is taken off there.
    """
    seen = np.flatnonzero(np.isfinite(strain))
    peak = int(np.argmax(stress))
    if len(seen) < 3 or peak < len(stress) - 3:
        return False
    if stress[: seen[-1] + 1].max() >= TAKEN_OFF_SHARE * stress[peak]:
        return False
    climb = stress[seen[-1] : peak + 1]
    last = max(len(climb) // 10, 2)
    usual = (climb[-1] - climb[0]) / max(len(climb) - 1, 1)
    return bool(climb[-1] - climb[-last] >= FULL_RATE * usual * (last - 1))
