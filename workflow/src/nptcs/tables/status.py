"""The ways in which a case can end: one list for records and tables."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, assert_never

if TYPE_CHECKING:
    import pandas as pd


class Status(StrEnum):
    """How a case ended."""

    OK = "ok"
    DIVERGED = "diverged"
    TIMEOUT = "timeout"
    LICENCE = "licence"
    ERROR = "error"

    @property
    def solved(self) -> bool:
        """Tell whether the case has a result; any other end is a failure with a message."""
        match self:
            case Status.OK:
                return True
            case Status.DIVERGED | Status.TIMEOUT | Status.LICENCE | Status.ERROR:
                return False
            case _:
                assert_never(self)

    @property
    def from_outside(self) -> bool:
        """Tell whether the same case may end differently the next time it runs."""
        match self:
            case Status.TIMEOUT | Status.LICENCE:
                return True
            case Status.OK | Status.DIVERGED | Status.ERROR:
                return False
            case _:
                assert_never(self)


def has_result(statuses: pd.Series) -> pd.Series:
    """Tell for each row of a column ``status`` whether its case has a result."""
    return statuses.isin([status.value for status in Status if status.solved])
