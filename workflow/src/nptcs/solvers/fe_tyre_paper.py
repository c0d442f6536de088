"""Solver ``fe_tyre_paper``: ``fe_tyre`` on the ring as the paper meshed it."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from pydantic import Field

from nptcs.solvers import fe_tyre
from nptcs.solvers.fe_tyre import FeTyreOptions


class FeTyrePaperOptions(FeTyreOptions):
    """Options of ``fe_tyre_paper``: those of ``fe_tyre`` with the paper's ring and its section."""

    ring: Literal["paper_mesh"] = Field(
        "paper_mesh",
        description="The ring with the element counts of table 4 of the paper, and the section of "
        "the spoke that was calibrated with it",
    )


SOLVER = replace(fe_tyre.SOLVER, name="fe_tyre_paper", version="2", options=FeTyrePaperOptions)
