"""The least-squares core against NIST's certified regressions and exact small cases."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.calibrate.linear import robust_covariance, solve_linear
from nptcs.reduce.curve.chord import fit_line

NIST = Path(__file__).resolve().parents[3] / ".." / "shared" / "labdata" / "nist-regression"
# relative accuracy that double precision leaves at each set's conditioning; Longley, Wampler
# and Filip are in NIST's collection because they defeat careless programs
SETS = {
    "norris": 1e-11,
    "pontius": 1e-10,
    "noint1": 1e-12,
    "noint2": 1e-12,
    "longley": 1e-8,
    "wampler1": 1e-6,
    "wampler2": 1e-9,
    "wampler3": 1e-6,
    "wampler4": 1e-6,
    "wampler5": 1e-5,
    "filip": 1e-6,
}


POLYNOMIALS = {"pontius", "filip", *(f"wampler{i}" for i in range(1, 6))}


def nist(name: str) -> tuple[Any, Any, Any, float]:
    if not NIST.exists():
        pytest.skip("NIST's regression sets are not next to this repository (shared/labdata)")
    exact = pd.read_csv(NIST / "exact_rational_LS.csv")
    exact = exact[exact["set"] == name].set_index("param")["exact_LS_value"]
    deviation = float(exact.pop("resid_sd"))
    table = pd.read_csv(NIST / f"{name}.csv").astype(float)
    design = table.drop(columns="y").to_numpy()
    if name in POLYNOMIALS:
        design = design[:, :1] ** np.arange(1, len(exact))
    if not name.startswith("noint"):
        design = np.column_stack([np.ones(len(table)), design])
    return design, table["y"].to_numpy(), exact.to_numpy(), deviation


@pytest.mark.parametrize("name", SETS)
def test_nist_certified_regressions(name: str) -> None:
    design, y, exact, deviation = nist(name)
    coefficients, rank = solve_linear(design, y, np.ones(len(y)))
    assert rank == design.shape[1]
    assert coefficients == pytest.approx(exact, rel=SETS[name])
    residual = y - design @ coefficients
    seen = np.sqrt(residual @ residual / (len(y) - design.shape[1]))
    # an exact fit leaves rounding of the largest y
    assert seen == pytest.approx(deviation, rel=1e-8, abs=1e-9 * np.abs(y).max())


def test_line_against_norris_with_its_certified_errors() -> None:
    design, y, exact, deviation = nist("norris")
    line = fit_line(design[:, 1], y)
    assert [line.intercept, line.slope] == pytest.approx(exact, rel=1e-11)
    assert line.residual_deviation == pytest.approx(deviation, rel=1e-10)
    # certified: standard error of the slope 0.429796848199937e-3, R² 0.999993745883712
    assert line.slope_error == pytest.approx(0.429796848199937e-3, rel=1e-9)
    assert line.r_squared == pytest.approx(0.999993745883712, rel=1e-12)


def test_rank_is_reported_and_weights_count() -> None:
    x = np.arange(5.0)
    design = np.column_stack([x, 2 * x])
    assert solve_linear(design, x, np.ones(5))[1] == 1
    two = np.column_stack([np.ones(3)])
    mean, _ = solve_linear(two, np.array([1.0, 2.0, 9.0]), np.array([1.0, 1.0, 0.0]))
    assert mean == pytest.approx([1.5])


def test_robust_covariance_of_a_mean_is_s_squared_over_n() -> None:
    values = np.array([1.0, 2.0, 4.0, 9.0])
    covariance = robust_covariance(np.ones((4, 1)), values - 4.0, np.ones(4))
    assert covariance[0, 0] == pytest.approx(values.var(ddof=1) / 4)
    assert np.isnan(robust_covariance(np.ones((1, 1)), np.zeros(1), np.ones(1))).all()
