"""How a case ends: the one list of it, for records and tables alike."""

from __future__ import annotations

from enum import StrEnum


class Status(StrEnum):
    """How a case ended."""

    OK = "ok"
    DIVERGED = "diverged"
    TIMEOUT = "timeout"
    LICENCE = "licence"
    ERROR = "error"
