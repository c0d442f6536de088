"""The sandwich ring against the finite element tyre: same spokes, same ground, same rubbers.

    python benchmarks/ring_against_fe.py [--cases 26] [--along 3] [--picture FILE.png]
        [--spokes results/5_solve/spokes [--section paper_mesh --card results/material_card.json]]

Eight designs that span tables 5 and 7, then every third (``--cases 78``: each) of their 78 cases at
ten loads, by the ring and by two finite element tyres: on the mesh of the campaign, and with
`--along` times as many elements along the circumference, where the contact needs them. Prints the
difference of the displacement in per cent at each load, of the neutral line (in per cent of the
largest displacement), of peak pressure and contact length √(12 Var p), and the CPU time of each.
Where the finite elements do not reach a load, only the loads before it are compared. A folder of
spokes saves the computation of their tables (some 5 s each). Those of a study that has solved
tables 5 and 7 by `fe_tyre_paper` have the section that was calibrated with the ring `paper_mesh`,
and the plies of its card; both models take any spokes.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from nptcs.config.solvers.fe import SECTIONS, FeModel, TyreMesh
from nptcs.config.solvers.ring import RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import spoke_design, tyre_model
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.tyre.equilibrium import TyreError, TyreModel, TyreState
from nptcs.fe.tyre.responses import contact_responses
from nptcs.files import read_model
from nptcs.ring.responses import responses
from nptcs.ring.solution import RingState, press_through_loads
from nptcs.ring.tyre import RingTyre, ring_tyre
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY, MaterialCard

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
        {
            "spacing_mm": s,
            "thickness_mm": t,
            "angle_deg": float(a),
            "spoke_c10_mpa": 1.04,
            "band": 5.0,
        }
        for s, t, a in product((10.0, 15.0, 20.0), (1.2, 1.8, 2.4), range(0, 91, 15))
    ]
    rubbers = [
        {**FIDUCIAL, "spoke_c10_mpa": s, "band": t}
        for t, s in product((4.0, 4.5, 5.0), (1.0, 2.0, 3.0, 4.0, 5.0))
    ]
    return plates + rubbers


@dataclass
class Difference:
    """Ring against finite elements for one design, at the loads that these reached.

    `percent` is that of the displacement; `line`, `peak` and `length` are per cent at the last load
    (NaN where it was not reached).
    """

    loads_n: np.ndarray
    percent: np.ndarray
    line: float
    peak: float
    length: float
    fe_s: float
    ring_s: float

    def __str__(self) -> str:
        """One line of the printed table."""
        numbers = " ".join(f"{value:+.2f}" for value in self.percent)
        return (
            f"{numbers}  line {self.line:.2f} peak {self.peak:+.1f} length {self.length:+.1f} %  "
            f"{self.fe_s:.1f} s {1000 * self.ring_s:.0f} ms"
        )


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
    press_through_loads(ring, reached[:1])
    start = time.process_time()
    states = press_through_loads(ring, reached)
    ring_s = time.process_time() - start
    percent = np.array(
        [100 * (own.rise_mm / rise[own.force_n] - 1) for own in states if own.force_n in rise]
    )
    shapes = (np.nan,) * 3 if state is None else _shapes(finite, state, ring, states[-1])
    return Difference(np.array(reached), percent, *shapes, fe_s, ring_s)


def _shapes(
    finite: TyreModel, state: TyreState, ring: RingTyre, own: RingState
) -> tuple[float, float, float]:
    """Per cent of neutral line, peak pressure and contact length at the last load."""
    line = finite.neutral_line(state.displacement) - finite.neutral_line(0 * state.displacement)
    theta = finite.mesh.theta
    outward = line[:, 0] * np.sin(theta) - line[:, 1] * np.cos(theta)
    along = line[:, 0] * np.cos(theta) + line[:, 1] * np.sin(theta)
    nodes = [
        np.interp(ring.nodes.theta, theta, part, period=2 * np.pi) for part in (outward, along)
    ]
    gap = np.hypot(*(a - b for a, b in zip(ring.neutral_line(own.u), nodes, strict=True))).max()
    there = contact_responses(finite.ground.cells(state.displacement, state.rise_mm))
    here = responses(ring, own)
    peak, length = (
        100 * (here.get(name, np.nan) / there.get(name, np.nan) - 1)
        for name in ("largest_pressure_mpa", "contact_length_mm")
    )
    return float(100 * gap / np.hypot(outward, along).max()), peak, length


def label(design: dict[str, float]) -> str:
    """Short name of a design."""
    return (
        f"S {design['spacing_mm']:g} T {design['thickness_mm']:g} A {design['angle_deg']:g} "
        f"S-C {design['spoke_c10_mpa']:g} T-C {design['band']:g}"
    )


def summed_up(group: list[Difference]) -> str:
    """Summarise the differences of a group."""
    every = np.concatenate([one.percent for one in group])
    shapes = {
        name: np.nanmax(np.abs([0.0, *(getattr(one, name) for one in group)]))
        for name in ("line", "peak", "length")
    }
    return (
        f"displacement rms {np.sqrt(np.mean(every**2)):.3f} %, largest {np.abs(every).max():.3f} % "
        f"({len(every)} loads); neutral line {shapes['line']:.2f} %, peak pressure "
        f"{shapes['peak']:.1f} %, contact length {shapes['length']:.1f} % at most"
    )


def draw(by_mesh: dict[str, list[Difference]], path: Path) -> None:
    """Draw the differences over the load, one panel per mesh of the finite elements."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 3.6), layout="constrained")
    panels = figure.subplots(1, len(by_mesh), sharey=True, squeeze=False)[0]
    for axes, (mesh, differences) in zip(panels, by_mesh.items(), strict=True):
        axes.axhspan(-0.5, 0.5, color="0.92", zorder=0)
        for number, one in enumerate(differences):
            first = number < len(DESIGNS)
            axes.plot(
                one.loads_n / 1000,
                one.percent,
                color="tab:red" if first else "tab:blue",
                alpha=0.8 if first else 0.35,
                linewidth=1.2,
            )
        axes.set_xlabel("Load [kN]")
        axes.set_title(mesh, fontsize=9)
    panels[0].set_ylabel("Displacement of the ring against\nthe finite elements [%]", fontsize=9)
    figure.suptitle("Eight designs (red), cases of tables 5 and 7 (blue)", fontsize=10)
    figure.savefig(path, dpi=150)


def meshes(along: int) -> dict[str, TyreMesh]:
    """Return the meshes of the finite element tyre, by name."""
    fine = TyreMesh(foot_elements=along, gap_elements=along)
    return {"mesh of the campaign": TyreMesh(), f"contact {along} times as fine": fine}


def main() -> None:
    """Read the arguments and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--spokes", type=Path)
    parser.add_argument("--section", choices=sorted(SECTIONS), default="converged")
    parser.add_argument("--card", type=Path)
    parser.add_argument("--cases", type=int, default=26)
    parser.add_argument("--along", type=int, default=3)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    every = cases()[:: max(78 // max(arguments.cases, 1), 1)][: arguments.cases]
    wanted = [(design, DESIGN_LOADS) for design in DESIGNS] + [(d, CASE_LOADS) for d in every]
    plain, ply = FeModel(ring=arguments.section), PUBLISHED_PLY
    if arguments.card is not None:
        (card,) = read_model(arguments.card, MaterialCard).plies.values()
        ply = {name: card.values()[name] for name in PUBLISHED_PLY}
    tables = [
        shared_table(plain, spoke_design(plain, TYRE, ply, design), arguments.spokes)
        for design, _ in wanted
    ]
    by_mesh = compare(wanted, tables, arguments.along)
    if arguments.picture is not None:
        draw(by_mesh, arguments.picture)


def compare(
    wanted: list[tuple[dict[str, float], list[float]]],
    tables: list[SpokeEnergyTable],
    along: int,
) -> dict[str, list[Difference]]:
    """Print the differences of all designs on both meshes."""
    by_mesh: dict[str, list[Difference]] = {}
    for name, mesh in meshes(along).items():
        print(f"\nring - finite elements in %, {name}; designs at {DESIGN_LOADS} N")
        model = FeModel(tyre_mesh=mesh)
        for (design, loads), table in zip(wanted, tables, strict=True):
            one = against(table, design["band"], loads, model)
            by_mesh.setdefault(name, []).append(one)
            print(f"{label(design):38s} {one}", flush=True)
    for name, found in by_mesh.items():
        print(f"\n{name}")
        print("  designs:", summed_up(found[: len(DESIGNS)]))
        if found[len(DESIGNS) :]:
            print("  cases:  ", summed_up(found[len(DESIGNS) :]))
    return by_mesh


if __name__ == "__main__":
    main()
