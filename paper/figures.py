"""Draw the figures of the paper from the tables of a finished default study.

``python paper/figures.py results`` writes ``paper/parity.png`` and ``paper/surfaces.png``. Every
number comes from ``results/tables``; nothing is computed here but the axes.
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl

mpl.use("agg")
import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure
from PIL import Image

HERE = Path(__file__).parent
STUDIES = {"plate": ("plates", "#0072b2", "o"), "rubber": ("rubbers", "#d55e00", "s")}
SURFACES = {
    "polynomial": "polynomial (equation 21)",
    "lamination 7": "lamination form",
    "gaussian process on the mean": "Gaussian process\non a constant",
    "gaussian process on lamination 7": "Gaussian process\non the lamination form",
}
SOLVERS = {"published": "published cases", "fe_tyre_paper": "our finite elements"}


def parity(table: pd.DataFrame) -> None:
    """Draw the difference from the published stiffness; calibration cases are hollow."""
    figure, axes = plt.subplots(figsize=(5.4, 2.8), layout="constrained")
    rows = table.query("solver == 'fe_tyre_paper' and status == 'ok'")
    for study, (label, colour, mark) in STUDIES.items():
        for used, group in rows[rows["study"] == study].groupby("used_for_calibration"):
            axes.plot(
                group["published_stiffness_n_per_mm"],
                group["difference_percent"],
                mark,
                markersize=5,
                zorder=3 if used else 2,
                color=colour,
                markerfacecolor="white" if used else colour,
                label=f"{label}: calibrated on" if used else f"{label}: blind",
            )
    axes.axhline(0, color="0.5", linewidth=0.8, zorder=0)
    axes.set(xlabel="published stiffness, N/mm", ylabel="computed - published, %")
    axes.legend(frameon=False, fontsize="small")
    save(figure, "parity.png")


def surfaces(table: pd.DataFrame) -> None:
    """Draw the largest error at left-out cases, by surface and by the solver of the cases."""
    figure, axes = plt.subplots(figsize=(5.4, 2.6), layout="constrained")
    rows = table.query("study == 'plate'").set_index(["solver", "surface"])
    for place, (solver, label) in enumerate(SOLVERS.items()):
        errors = [rows.loc[(solver, name), "leave_one_out_largest"] for name in SURFACES]
        at = [position + 0.38 * (place - 0.5) for position in range(len(SURFACES))]
        bars = axes.barh(at, errors, 0.36, label=label, color=["#0072b2", "#e69f00"][place])
        axes.bar_label(bars, fmt="%.2f", padding=2, fontsize="small")
    axes.set_yticks(range(len(SURFACES)), list(SURFACES.values()), fontsize="small")
    axes.invert_yaxis()
    axes.set(xlabel="largest error at left-out cases, N/mm")
    axes.margins(x=0.1)
    axes.legend(frameon=False, fontsize="small", loc="lower right")
    save(figure, "surfaces.png")


def save(figure: Figure, name: str) -> None:
    """Write a figure of 64 colours, a third of the size of the full-colour one."""
    figure.savefig(HERE / name, dpi=200)
    with Image.open(HERE / name) as image:
        few = image.convert("RGB").quantize(64)
    few.save(HERE / name, optimize=True)


def main() -> int:
    """Draw both figures."""
    tables = Path(sys.argv[1]) / "tables"
    parity(pd.read_csv(tables / "stiffness_against_published.csv"))
    surfaces(pd.read_csv(tables / "surface_comparison.csv"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
