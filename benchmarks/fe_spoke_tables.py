"""The default tables of spokes against strict ones, and the time of each stage of a case.

    python benchmarks/fe_spoke_tables.py [--designs N]

Strict tables have 165 states (ten levels of the elongation, five of β and of φ, of which those with
β < 0 follow by symmetry), each found by Newton's method with a new matrix for each step until the
work that is left is 1e-12 of the energy, and polynomials of degree 13 and 8. For designs that span
the published studies it prints, for the default and the strict table, processor time of the table,
the tyre and the stress of its plates, matrices and cheap steps, and by how much the default changes
the stiffness at a fifth, half and all of the load, and the responses. The last line multiplies the
mean times by the numbers of spokes and tyres of the default study.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from nptcs.arrays import Array
from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import energy_table, loaded_tyre, spoke_design, tyre_model
from nptcs.fe.matrices.block_tridiagonal import BlockCholesky
from nptcs.fe.output.loaded_spokes import loaded_spokes
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.tyre.responses import contact_responses, spoke_forces
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

TYRE = TyreGeometry()
NAMES = ("spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa")
DESIGNS = (
    (15.0, 1.8, 45.0, 5.0),
    (15.0, 1.8, 45.0, 1.0),
    (10.0, 2.4, 0.0, 1.04),
    (20.0, 1.2, 90.0, 1.04),
    (10.0, 1.2, 0.0, 1.04),
    (20.0, 2.4, 45.0, 1.04),
)
BAND_C10_MPA, LOAD_N = 5.0, 5000.0
# distinct spokes and tyres of tables 5 and 7 with the paper's ring
SPOKES, TYRES = 68, 78
STRICT = {
    "side_states": "every",
    "accepted_work": 1e-12,
    "samples": (10, 5, 5),
    "degrees": (13, 8),
}
COUNTS: Counter[str] = Counter()


@dataclass
class Case:
    """Stiffness (N/mm) at parts of the load, responses, and processor time (s) of each stage."""

    stiffness: Array
    responses: dict[str, float]
    seconds: dict[str, float]


def solve(values: tuple[float, ...], options: dict[str, object]) -> Case:
    """Compute table, tyre and stress of one design."""
    model = FeModel.model_validate({"ring": "paper_mesh", "table": options})
    design = spoke_design(model, TYRE, PUBLISHED_PLY, dict(zip(NAMES, values, strict=True)))
    marks = [time.process_time()]
    table = energy_table(model, design)
    marks.append(time.process_time())
    tyre = tyre_model(model, TYRE, table, BAND_C10_MPA)
    state = loaded_tyre(tyre, model, LOAD_N)
    marks.append(time.process_time())
    _, stress = loaded_spokes(SpokeModel(design), table, state.motion)
    marks.append(time.process_time())
    cells = tyre.ground.cells(state.displacement, state.rise_mm)
    loads = LOAD_N * np.array([0.2, 0.5, 1.0])
    return Case(
        loads / np.interp(loads, state.path.force_n, state.path.rise_mm),
        {
            **contact_responses(cells),
            **spoke_forces(table, state.motion),
            **stress,
        },
        dict(zip(("table", "tyre", "stress"), np.diff(marks).tolist(), strict=True)),
    )


def scale(responses: dict[str, float], name: str) -> float:
    """Give what a difference is a part of: of a plate's stress the largest von Mises stress."""
    return abs(responses["plate_largest_mises_mpa" if name.startswith("plate_") else name])


@contextmanager
def a_matrix_for_each_step() -> Iterator[None]:
    """Give Newton's method a new matrix for each step."""
    followed = SpokeModel._followed

    def one_step(
        self: SpokeModel,
        displacement: Array,
        factor: BlockCholesky,
        step: Array,
        work: float,
    ) -> Array:
        for group in self.mixed:
            group.follow(step)
        return displacement + step

    SpokeModel._followed = one_step  # type: ignore[method-assign]
    try:
        yield
    finally:
        SpokeModel._followed = followed  # type: ignore[method-assign]


def count(name: str) -> None:
    """Count the calls of a method of the spoke."""
    method: Callable[[SpokeModel, Array], object] = getattr(SpokeModel, name)

    def counted(self: SpokeModel, displacement: Array) -> object:
        COUNTS[name] += 1
        return method(self, displacement)

    setattr(SpokeModel, name, counted)


def compile_kernels() -> float:
    """Move a spoke a little, so that no design pays for compiling; processor time in s."""
    start = time.process_time()
    model = FeModel.model_validate({"ring": "paper_mesh"})
    design = spoke_design(model, TYRE, PUBLISHED_PLY, dict(zip(NAMES, DESIGNS[0], strict=True)))
    spoke = SpokeModel(design)
    spoke.move(spoke.rest(), np.array([-0.5, 0.0, 0.0]))
    return time.process_time() - start


def text(case: Case) -> str:
    """Write times and counts of a case."""
    times = ", ".join(f"{stage} {seconds:.1f} s" for stage, seconds in case.seconds.items())
    counts = f"{COUNTS['_respond']} matrices, {COUNTS['_forces']} cheap steps"
    COUNTS.clear()
    return f"{times} ({counts})"


@threadpool_limits.wrap(limits=1)
def main(designs: int) -> None:
    """Compare the designs one after the other."""
    print(f"compiled, or read from numba's copies on disk: {compile_kernels():.1f} s")
    for name in ("_respond", "_forces"):
        count(name)
    seconds: Counter[str] = Counter()
    for values in DESIGNS[:designs]:
        default = solve(values, {})
        seconds.update(default.seconds)
        print("S {:g} T {:g} A {:g} C10 {:g}".format(*values), "default:", text(default))
        with a_matrix_for_each_step():
            strict = solve(values, STRICT)
        change = 100.0 * (default.stiffness / strict.stiffness - 1.0)
        worst, name = max(
            (100.0 * abs(value - strict.responses[name]) / scale(strict.responses, name), name)
            for name, value in default.responses.items()
        )
        print(f"    strict: {text(strict)}")
        print(
            f"    default against strict: K {np.array2string(change, precision=4, sign='+')} % at "
            f"a fifth, half and all of the load; responses at most {worst:.3f} % ({name})",
            flush=True,
        )
    mean = {stage: total / designs for stage, total in seconds.items()}
    total = SPOKES * mean["table"] + TYRES * (mean["tyre"] + mean["stress"])
    print(f"{SPOKES} spokes and {TYRES} tyres at these means: {total:.0f} s of one processor")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=len(DESIGNS), help="how many of the six")
    main(parser.parse_args().designs)
