"""The ways in which a case can end: one list for records and tables."""

from __future__ import annotations

from enum import StrEnum


class Status(StrEnum):
    """How a case ended."""

    OK = "ok"
    DIVERGED = "diverged"
    TIMEOUT = "timeout"
    LICENCE = "licence"
    ERROR = "error"
