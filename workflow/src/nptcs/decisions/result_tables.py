"""All tables of decisions and of their uncertainty, by the output that holds them."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pandera.pandas as pa

from nptcs.decisions.run import SolvedStudies, answer_all
from nptcs.decisions.tables import decision_tables
from nptcs.tables.analysis.decisions import (
    DecisionConfirmation,
    DecisionDesigns,
    DecisionFront,
    Decisions,
)
from nptcs.tables.analysis.uncertainty import ResponseUncertainty, UncertaintyShares
from nptcs.tables.problems import Problems
from nptcs.uncertainty.tables import uncertainty_tables

Tables = dict[str, tuple[pd.DataFrame, type[pa.DataFrameModel]]]
"""Table and contract by the name of the output."""


def result_tables(run: SolvedStudies, store: Path, cores: int) -> Tables:
    """Answer the decisions of a run and return everything that is known about them as tables.

    Parameters
    ----------
    run : SolvedStudies
    store : Path
        Folder of solved cases; designs that are solved to confirm a choice are kept there.
    cores : int
    """
    done = answer_all(run, store, cores)
    assessed = uncertainty_tables(done.designs, run.errors)
    found = decision_tables(done.answers)
    return {
        "uncertainty": (assessed.responses, ResponseUncertainty),
        "shares": (assessed.shares, UncertaintyShares),
        "decisions": (found.decisions, Decisions),
        "designs": (found.designs, DecisionDesigns),
        "front": (found.front, DecisionFront),
        "confirmation": (found.confirmation, DecisionConfirmation),
        "problems": (done.problems, Problems),
    }
