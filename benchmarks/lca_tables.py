"""Tables of docs/methods/lca.md: table 11, table 7, and what the spokes' form changes.

OPENBLAS_NUM_THREADS=1 python benchmarks/lca_tables.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from nptcs import lca
from nptcs.compare.lca import lca_against_fem, lca_validation
from nptcs.config.solvers.tyre import TyreGeometry

PUBLISHED = Path(__file__).resolve().parents[1] / "raw_data" / "published"


def read(name: str) -> pd.DataFrame:
    """Read a published table."""
    return pd.read_csv(PUBLISHED / name)


def print_published(tyre: TyreGeometry) -> None:
    """Print tables 7 and 11 next to our results."""
    spokes = read("table10_spoke_stiffness.csv")
    rows = lca_validation(
        spokes, read("table11_lca_validation.csv"), read("figure15_load_errors.csv"), tyre
    )
    table_11 = rows[rows["load_n"] == 5000]
    print(
        table_11.filter(regex="^(section|spoke_c10_mpa|theta_._deg|disp.*mm|stiff.*mm|.*percent)$")
        .drop(columns="published_largest_error_percent")
        .round(3)
        .to_string(index=False)
    )
    print(f"largest balance residual {rows['balance_residual'].abs().max():.1e}")
    fem = lca_against_fem(spokes, read("table7_rubber_doe.csv"), tyre)
    print(
        fem.groupby("section")["fem_difference_percent"]
        .agg(["min", "max", lambda part: part.abs().mean()])
        .round(2)
        .to_string(header=False)
    )


def print_spokes(tyre: TyreGeometry) -> None:
    """Print the linear limit, the contact spokes' form and the ripple."""
    section, spokes = lca.ShearBandSection.from_tyre(tyre, 5.0), lca.LinearSpokes(30.2, 13.26)
    law = lca.SpokeLaw.linear(spokes, 60.0)
    for load in (500.0, 3000.0, 5000.0, 8000.0):
        exact = lca.solve(section, spokes, load_n=load).displacement_mm
        paper, local = (
            lca.solve_law(section, law, load_n=load, contact=form).displacement_mm
            for form in ("paper", "local")
        )
        print(
            f"{load:5.0f} N: exact {exact:.6f} mm, curve of two lines {paper - exact:+.1e} mm, "
            f"local contact spokes {local - exact:+.4f} mm"
        )
    for load in (1000.0, 5000.0):
        ripple = lca.stiffness_ripple(section, law, load, np.array([0.0, 1.5, 3.0]))
        stiffness = ripple["stiffness_n_per_mm"]
        values = ", ".join(f"{value:.2f}" for value in stiffness)
        print(f"{load:5.0f} N, 60 single spokes, hub at 0, 1.5, 3 degrees: {values} N/mm")


if __name__ == "__main__":
    print_published(TyreGeometry())
    print_spokes(TyreGeometry())
