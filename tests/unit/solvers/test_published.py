"""The archive answers for its own cases and for no other."""

from pathlib import Path

import pandas as pd
import pytest

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.solvers.contract import CaseInputs
from nptcs.solvers.published import SOLVER, PublishedOptions

TABLE = "raw_data/published/table5_plate_doe.csv"
ROWS = pd.read_csv(Path(__file__).parents[3] / TABLE).to_dict("records")


def solve(load_n=5000.0, **values):
    options = PublishedOptions(archive=TABLE)
    return SOLVER.solve(
        CaseInputs("c", values, load_n, TyreGeometry(), options, tables={"archive": ROWS})
    )


def test_case_32_of_table_5_is_the_fiducial_one():
    result = solve(spacing_mm=15, thickness_mm=1.8, angle_deg=45)
    assert result.status == "ok"
    assert result.vertical_stiffness_n_per_mm == 263.73
    assert result.displacement_mm == pytest.approx(5000 / 263.73)
    assert result.message == f"row 32 of {TABLE}"


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"spacing_mm": 15, "thickness_mm": 1.8, "angle_deg": 44}, "angle_deg = 44"),
        ({"spacing_mm": 15, "thickness_mm": 1.8}, "angle_deg = nan"),
        (
            {"spacing_mm": 15, "thickness_mm": 1.8, "angle_deg": 45, "load_n": 4000.0},
            "results at 5000 N, not at 4000 N",
        ),
    ],
)
def test_what_the_archive_does_not_contain_is_an_error_never_a_guess(values, message):
    result = solve(**values)
    assert result.status == "error"
    assert message in result.message
    assert result.vertical_stiffness_n_per_mm is None
