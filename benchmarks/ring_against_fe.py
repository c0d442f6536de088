"""The sandwich ring against the finite element tyre: same spokes, same ground, same rubbers.

    python benchmarks/ring_against_fe.py [--spokes results/5_solve/spokes] [--cases 26]
        [--along 2] [--across 1] [--picture ring_against_fe.png]

Eight designs that span tables 5 and 7, then `--cases` of their 78 cases (26: every third), at ten
loads.
Prints the difference of the displacement in per cent at each load, of the neutral line (in per cent
of the largest displacement), the peak pressures, the contact lengths √(12 Var p), and the CPU time
of both. The finite elements are refined along the circumference, where their contact needs it:
`--along 1` is the campaign's mesh. A folder of spokes saves the computation of their tables.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from nptcs.config.fe import FeModel, TyreMesh
from nptcs.config.ring import RingOptions
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.case import spoke_design, tyre_model
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.tyre.equilibrium import TyreError
from nptcs.ring.responses import contact_length_mm, responses
from nptcs.ring.solution import load
from nptcs.ring.tyre import ring_tyre
from nptcs.tables.material_card import PUBLISHED_PLY

TYRE = TyreGeometry()
FIDUCIAL = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
DESIGNS = [
    *({**FIDUCIAL, "spoke_c10_mpa": s, "band": t} for s in (1.0, 3.0, 5.0) for t in (4.0, 5.0)),
    {"spacing_mm": 10.0, "thickness_mm": 2.4, "angle_deg": 0.0, "spoke_c10_mpa": 1.04, "band": 5.0},
    {
        "spacing_mm": 20.0,
        "thickness_mm": 1.2,
        "angle_deg": 90.0,
        "spoke_c10_mpa": 1.04,
        "band": 5.0,
    },
]
DESIGN_LOADS = [1500.0, 3000.0, 4000.0, 5000.0, 6000.0]
CASE_LOADS = np.linspace(500.0, 5000.0, 10).tolist()


def cases() -> list[dict[str, float]]:
    """Designs of tables 5 and 7."""
    plates = [
        {"spacing_mm": s, "thickness_mm": t, "angle_deg": a, "spoke_c10_mpa": 1.04, "band": 5.0}
        for s, t, a in product((10.0, 15.0, 20.0), (1.2, 1.8, 2.4), range(0, 91, 15))
    ]
    rubbers = [
        {**FIDUCIAL, "spoke_c10_mpa": s, "band": t}
        for t, s in product((4.0, 4.5, 5.0), (1.0, 2.0, 3.0, 4.0, 5.0))
    ]
    return plates + rubbers


@dataclass
class Difference:
    """Differences of one design, per cent, at the loads that the finite elements reached."""

    loads_n: np.ndarray
    percent: np.ndarray
    text: str


def compare(
    design: dict[str, float], loads_n: list[float], mesh: TyreMesh, spokes: Path | None
) -> Difference:
    """Load one design by both models."""
    model = FeModel(tyre_mesh=mesh)
    table = shared_table(model, spoke_design(model, TYRE, PUBLISHED_PLY, design), spokes)
    return against(table, design["band"], loads_n, model)


def against(
    table: SpokeEnergyTable, band_c10_mpa: float, loads_n: list[float], model: FeModel
) -> Difference:
    """Load a tyre on these spokes by both models."""
    finite = tyre_model(model, TYRE, table, band_c10_mpa)
    start = time.process_time()
    state = None
    try:
        state = finite.load(loads_n)
        path = state.path
    except TyreError as error:
        path = error.path
    fe_s = time.process_time() - start
    rise = dict(zip(path.force_n, path.rise_mm, strict=True))
    reached = [force for force in loads_n if force in rise]
    options = RingOptions(axial=model.axial, contact=model.contact)
    ring = ring_tyre(TYRE, table, band_c10_mpa, options)
    load(ring, reached[:1])
    start = time.process_time()
    states = load(ring, reached)
    ring_s = time.process_time() - start
    percent = np.array(
        [100 * (own.rise_mm / rise[own.force_n] - 1) for own in states if own.force_n in rise]
    )
    text = f"{fe_s:6.1f} s {1000 * ring_s:5.0f} ms"
    if state is not None:
        text += _shapes(finite, state, ring, states[-1])
    return Difference(np.array(reached), percent, text)


def _shapes(finite, state, ring, own) -> str:
    """Neutral line, pressure and contact length at the last load."""
    line = finite.neutral_line(state.displacement) - finite.neutral_line(0 * state.displacement)
    theta = finite.mesh.theta
    outward = line[:, 0] * np.sin(theta) - line[:, 1] * np.cos(theta)
    along = line[:, 0] * np.cos(theta) + line[:, 1] * np.sin(theta)
    there = [
        np.interp(ring.nodes.theta, theta, part, period=2 * np.pi) for part in (outward, along)
    ]
    gap = np.hypot(*(a - b for a, b in zip(ring.neutral_line(own.u), there, strict=True))).max()
    place, pressure = finite.ground.pressure_profile(state.displacement, state.rise_mm)
    order = np.argsort(place)
    weight = np.gradient(place[order]) * pressure[order]
    found = responses(ring, own)
    return (
        f"  line {100 * gap / np.hypot(outward, along).max():.2f} %  peak {pressure.max():.3f}"
        f" {found['largest_pressure_mpa']:.3f} MPa  length"
        f" {contact_length_mm(place[order], weight):.1f} {found['contact_length_mm']:.1f} mm"
    )


def label(design: dict[str, float]) -> str:
    """Short name of a design."""
    return (
        f"S {design['spacing_mm']:g} T {design['thickness_mm']:g} A {design['angle_deg']:g} "
        f"S-C {design['spoke_c10_mpa']:g} T-C {design['band']:g}"
    )


def draw(differences: list[Difference], path: Path) -> None:
    """Draw the differences over the load."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.0), layout="constrained")
    axes = figure.add_subplot()
    for number, one in enumerate(differences):
        first = number < len(DESIGNS)
        axes.plot(
            one.loads_n / 1000,
            one.percent,
            color="tab:red" if first else "tab:blue",
            alpha=0.8 if first else 0.35,
            linewidth=1.2,
        )
    axes.axhspan(-0.5, 0.5, color="0.92", zorder=0)
    axes.set_xlabel("Load [kN]")
    axes.set_ylabel("Displacement of the ring against\nthe finite elements [%]")
    axes.set_title("Eight designs (red), cases of tables 5 and 7 (blue)", fontsize=10)
    figure.savefig(path, dpi=150)


def main() -> None:
    """Read the arguments and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--spokes", type=Path)
    parser.add_argument("--cases", type=int, default=26)
    parser.add_argument("--along", type=int, default=2)
    parser.add_argument("--across", type=int, default=1)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    along, across = arguments.along, arguments.across
    mesh = TyreMesh(foot_elements=along, gap_elements=along, tread_rows=across, band_rows=across)
    every = cases()[:: max(78 // max(arguments.cases, 1), 1)][: arguments.cases]
    print("ring - fe in % at " + ", ".join(f"{value:g}" for value in DESIGN_LOADS) + " N")
    differences = []
    for design, loads in [(d, DESIGN_LOADS) for d in DESIGNS] + [(d, CASE_LOADS) for d in every]:
        one = compare(design, loads, mesh, arguments.spokes)
        differences.append(one)
        numbers = " ".join(f"{value:+.2f}" for value in one.percent)
        print(f"{label(design):38s} {numbers}  {one.text}", flush=True)
    groups = (("designs", differences[: len(DESIGNS)]), ("cases", differences[len(DESIGNS) :]))
    for name, group in groups:
        if group:
            every_one = np.concatenate([one.percent for one in group])
            rms = np.sqrt(np.mean(every_one**2))
            print(f"{name}: rms {rms:.3f} %, largest {np.abs(every_one).max():.3f} %")
    if arguments.picture is not None:
        draw(differences, arguments.picture)


if __name__ == "__main__":
    main()
