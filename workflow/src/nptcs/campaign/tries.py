"""Which failed cases the next run tries again: a number next to each batch file decides.

Snakemake solves a batch again when its parameters change. One of them is the number in the file
next to the batch: it grows when cases ended for a reason outside them, and with ``nptcs retry``.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from nptcs.files import write_text

if TYPE_CHECKING:
    from nptcs.campaign.record import CaseRecord


def ended_from_outside(record: CaseRecord) -> bool:
    """Tell whether a case was killed, ran out of memory or time, or did not get a licence.

    Such a case is tried again by the next run; one that a solver gave up on is not.
    """
    return record.result.died or record.result.status.from_outside


def tries_file(batch: str | Path) -> Path:
    """Return the file next to a batch file that counts its tries."""
    return Path(batch).with_suffix(".tries")


def read_tries(batch: str | Path) -> int:
    """Return how often a batch has been marked to be tried again; 0 without a readable file."""
    try:
        return int(tries_file(batch).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return 0


def try_again(batch: str | Path) -> None:
    """Let the next run solve the failed cases of a batch again."""
    write_text(tries_file(batch), f"{read_tries(batch) + 1}\n")


def note_ends(batch: str | Path, records: Sequence[CaseRecord]) -> None:
    """Let the next run try again if cases of a batch ended for a reason outside them."""
    if any(map(ended_from_outside, records)):
        try_again(batch)
