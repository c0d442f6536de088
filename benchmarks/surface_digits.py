"""Digits of the least-squares fit on NIST's linear regression sets.

    python benchmarks/surface_digits.py FOLDER

FOLDER has a CSV per set (norris.csv, …) and ``exact_rational_LS.csv`` with the columns set, param
and exact_LS_value, the least-squares solution in exact fractions. Prints the digits that agree in
the worst coefficient, with the long double of this machine and where long double is double.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.surface import least_squares
from nptcs.surface.fit import Surface, fit

SETS = ["norris", "pontius", "noint1", "noint2", "filip", "longley"]
SETS += [f"wampler{number}" for number in range(1, 6)]


def fit_set(folder: Path, name: str) -> tuple[Surface, pd.Series]:
    """Fit a set; return the surface and the exact values by parameter, ``resid_sd`` among them."""
    exact = pd.read_csv(folder / "exact_rational_LS.csv")
    certified = exact[exact["set"] == name].set_index("param")["exact_LS_value"]
    data = pd.read_csv(folder / f"{name}.csv", encoding="utf-8-sig")
    through_origin = name.startswith("noint")
    columns = [str(column) for column in data]
    factors = columns[1:] if name == "longley" else ["x1" if "x1" in columns else "x"]
    terms = factors if len(factors) > 1 or through_origin else []
    terms = terms or [f"{factors[0]}^{power}" for power in range(1, len(certified) - 1)]
    terms = terms if through_origin else ["1", *terms]
    return fit(data, data["y"], factors, terms, through_origin), certified


def digits(folder: Path, name: str) -> float:
    """Digits that agree in the worst coefficient of a set."""
    surface, certified = fit_set(folder, name)
    wanted = certified[certified.index != "resid_sd"].to_numpy()
    found = surface.coefficients_natural
    return float(-np.log10(max(np.abs((found - wanted) / wanted).max(), 1e-17)))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    wide = [digits(folder, name) for name in SETS]
    vars(least_squares)["np"].longdouble = np.float64
    fractions = [digits(folder, name) for name in SETS]
    print("| set | long double | exact fractions |\n|---|---|---|")
    for name, first, second in zip(SETS, wide, fractions, strict=True):
        print(f"| {name} | {first:.1f} | {second:.1f} |")


if __name__ == "__main__":
    main()
