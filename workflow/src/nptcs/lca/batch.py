"""A table of designs in, a table of results out, without a Python loop over the designs."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import assert_never

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nptcs.arrays import Floating, Rows
from nptcs.errors import InputError
from nptcs.lca.linear.contact import LARGEST_KAPPA_ANGLE, hardness
from nptcs.lca.linear.diagnosis import LARGEST_RESIDUAL, diagnose, doubts
from nptcs.lca.linear.newton import Target, by_brackets, is_solution, newton, start_angle
from nptcs.lca.linear.scaling import ScaledRing
from nptcs.lca.linear.system import Arcs, Joined, join_regions

CHUNK = 2048
"""Designs solved at once; more than this no longer fits the processor's cache."""
DESIGN_COLUMNS = (
    "axial_stiffness_n",
    "shear_stiffness_n",
    "bending_stiffness_n_mm2",
    "radius_mm",
    "width_mm",
    "tension_n_per_mm",
    "compression_n_per_mm",
    "spoke_count",
)
"""What a design needs: the fields of `ShearBandSection` and of `LinearSpokes`."""
RESULT_COLUMNS = (
    "displacement_mm",
    "load_n",
    "theta_c_deg",
    "theta_t_deg",
    "stiffness_n_per_mm",
    "tangent_stiffness_n_per_mm",
    "contact_force_n",
    "ring_force_n",
    "mean_pressure_mpa",
    "lowest_pressure_mpa",
    "balance_residual",
)
TARGETS: dict[str, Target] = {
    "load_n": "force",
    "displacement_mm": "sinking",
    "theta_c_deg": "contact_angle",
}
STATUSES = ("ok", "doubtful", "beyond_model", "bad_input", "no_convergence")
"""``doubtful``: solved, but one of the model's assumptions does not hold; the message says which.
``beyond_model``: no solution below the largest displacement. Only the first two have numbers."""


@dataclass(frozen=True)
class Batch:
    """Results of n designs: numbers by column (NaN where there are none), status and message."""

    columns: dict[str, Floating]
    status: NDArray[np.str_]
    message: list[str]


def solve_batch(
    designs: Mapping[str, ArrayLike],
    *,
    load_n: ArrayLike | None = None,
    displacement_mm: ArrayLike | None = None,
    theta_c_deg: ArrayLike | None = None,
    largest_displacement_mm: ArrayLike | None = None,
    workers: int = 1,
) -> Batch:
    """Solve the linear model for a table of designs.

    Parameters
    ----------
    designs : mapping of str to array-like
        Columns `DESIGN_COLUMNS`, each a number or n numbers (units in the names).
    load_n, displacement_mm, theta_c_deg : array-like
        Exactly one of them: what is given for each design.
    largest_displacement_mm : array-like, optional
        Displacement at which the band meets the rim; by default the radius R.
    workers : int
        Threads among which the table is divided.

    Returns
    -------
    Batch
        Columns `RESULT_COLUMNS`. A row that cannot be solved is marked; the others are solved.

    Raises
    ------
    InputError
        A column is missing, or not exactly one target is given.

    Examples
    --------
    >>> designs = {
    ...     "axial_stiffness_n": 2.711e7,
    ...     "shear_stiffness_n": 30100,
    ...     "bending_stiffness_n_mm2": 1.0554e9,
    ...     "radius_mm": 303.875,
    ...     "width_mm": 215,
    ...     "tension_n_per_mm": [30.2, -1],
    ...     "compression_n_per_mm": 13.26,
    ...     "spoke_count": 60,
    ... }
    >>> batch = solve_batch(designs, load_n=5000)
    >>> batch.status.tolist(), batch.columns["stiffness_n_per_mm"].round(1).tolist()
    (['ok', 'bad_input'], [241.1, nan])
    >>> batch.message[1]
    'tension_n_per_mm must be a finite number above zero, got -1'
    """
    name, value = only_target(load_n, displacement_mm, theta_c_deg)
    table = columns(designs, value, largest_displacement_mm)
    bad = bad_rows(table, name)
    status = np.where(bad != "", "bad_input", "").astype(object)
    message = list(bad)
    good = _by_hardness(table, name, np.flatnonzero(bad == ""))
    results = {column: np.full(len(bad), np.nan) for column in RESULT_COLUMNS}
    chunks = [good[start : start + CHUNK] for start in range(0, len(good), CHUNK)]

    def run(rows: Rows) -> None:
        part = {column: values[rows] for column, values in table.items()}
        for piece in solve_rows(part, name):
            where = rows[piece.rows]
            for column, values in piece.numbers.items():
                results[column][where] = values
            status[where] = piece.status
            for row, text in zip(where, piece.message, strict=True):
                message[row] = text

    if workers == 1:
        for rows in chunks:
            run(rows)
    else:
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(run, chunks))
    return Batch(results, status.astype(str), message)


def only_target(
    load_n: ArrayLike | None, displacement_mm: ArrayLike | None, theta_c_deg: ArrayLike | None
) -> tuple[str, ArrayLike]:
    """Return the name and value of the single target that is given.

    Raises
    ------
    InputError
        If none or more than one target is given.
    """
    given = {"load_n": load_n, "displacement_mm": displacement_mm, "theta_c_deg": theta_c_deg}
    present = [(name, value) for name, value in given.items() if value is not None]
    if len(present) != 1:
        raise InputError(
            "exactly one of load_n, displacement_mm and theta_c_deg must be given",
            remedy="give one of them",
            value=[name for name, _ in present],
        )
    return present[0]


def columns(
    designs: Mapping[str, ArrayLike], target: ArrayLike, largest: ArrayLike | None
) -> dict[str, Floating]:
    """All columns as float arrays of one length.

    Raises
    ------
    InputError
        If a column is missing.
    """
    for column in DESIGN_COLUMNS:
        if column not in designs:
            raise InputError("column is missing", remedy=f"give {column}", column=column)
    raw = {column: np.asarray(designs[column], dtype=float) for column in DESIGN_COLUMNS}
    raw["target"] = np.asarray(target, dtype=float)
    raw["largest"] = raw["radius_mm"] if largest is None else np.asarray(largest, dtype=float)
    broadcast = np.broadcast_arrays(*(np.atleast_1d(values) for values in raw.values()))
    return dict(zip(raw, broadcast, strict=True))


def bad_rows(table: dict[str, Floating], target: str) -> NDArray[np.object_]:
    """Return what is wrong with each row, or an empty text."""
    texts = np.full(len(table["target"]), "", dtype=object)
    for column, values in table.items():
        name = {"target": target, "largest": "largest_displacement_mm"}.get(column, column)
        wrong = ~(np.isfinite(values) & (values > 0)) & (texts == "")
        for row in np.flatnonzero(wrong):
            value = "nothing" if np.isnan(values[row]) else f"{values[row]:g}"
            texts[row] = f"{name} must be a finite number above zero, got {value}"
    count = table["spoke_count"]
    for row in np.flatnonzero(((count < 3) | (count % 1 != 0)) & (texts == "")):
        texts[row] = f"spoke_count must be a whole number from 3, got {count[row]:g}"
    if target == "theta_c_deg":
        for row in np.flatnonzero((table["target"] >= 85) & (texts == "")):
            texts[row] = f"theta_c_deg must be below 85, got {table['target'][row]:g}"
    return texts


def scaled(table: Mapping[str, Floating]) -> ScaledRing:
    """Return the dimensionless designs of a table with `DESIGN_COLUMNS`."""
    shear, radius = table["shear_stiffness_n"], table["radius_mm"]
    # R² k/GA with k = k_t N/(2πR)
    foundation = radius * table["spoke_count"] / (2 * np.pi * shear)
    return ScaledRing(
        shear / table["axial_stiffness_n"],
        shear * radius**2 / table["bending_stiffness_n_mm2"],
        foundation * table["compression_n_per_mm"],
        foundation * table["tension_n_per_mm"],
    )


def _scaled_target(table: dict[str, Floating], target: str) -> Floating:
    """Return F/GA, δ/R or θc in radians."""
    kind = TARGETS[target]
    match kind:
        case "force":
            return table["target"] / table["shear_stiffness_n"]
        case "sinking":
            return table["target"] / table["radius_mm"]
        case "contact_angle":
            return np.radians(table["target"])
        case _:
            assert_never(kind)


def _by_hardness(table: dict[str, Floating], target: str, rows: Rows) -> Rows:
    """Put rows in the order of their contact regions' difficulty, the easy ones first."""
    part = {column: values[rows] for column, values in table.items()}
    ring = scaled(part)
    angle = start_angle(ring, TARGETS[target], _scaled_target(part, target))
    return rows[np.argsort(hardness(ring.kappa2, angle), kind="stable")]


@dataclass(frozen=True)
class Piece:
    """Solved rows of a table.

    Parameters
    ----------
    rows : array of int
        Their places in the table.
    numbers : dict of str to array
        Columns `RESULT_COLUMNS`.
    status, message : array of str, list of str
        One per row.
    ring, arcs, joined : ScaledRing, Arcs, Joined
        The scaled designs and their solutions.
    """

    rows: Rows
    numbers: dict[str, Floating]
    status: NDArray[np.str_]
    message: list[str]
    ring: ScaledRing
    arcs: Arcs
    joined: Joined


def solve_rows(table: dict[str, Floating], name: str) -> list[Piece]:
    """Solve well-formed rows; those for which Newton's method fails form a second piece.

    Parameters
    ----------
    table : dict of str to array
        `DESIGN_COLUMNS`, ``target`` and ``largest`` (largest displacement in mm).
    name : str
        What the target is: ``load_n``, ``displacement_mm`` or ``theta_c_deg``.
    """
    ring, target = scaled(table), TARGETS[name]
    arcs, value = Arcs.of(ring), _scaled_target(table, name)
    angles = newton(ring, arcs, target, value, start_angle(ring, target, value))
    quick, rest = np.flatnonzero(angles.found), np.flatnonzero(~angles.found)
    pieces = []
    if len(quick):
        found = angles.contact[quick], angles.transition[quick]
        pieces.append(_finish(table, ring, arcs, target, value, quick, found))
    if len(rest):
        slow = by_brackets(ring.take(rest), arcs.take(rest), target, value[rest])
        pieces.append(_finish(table, ring, arcs, target, value, rest, slow))
    return pieces


def _finish(
    table: dict[str, Floating],
    ring: ScaledRing,
    arcs: Arcs,
    target: Target,
    value: Floating,
    rows: Rows,
    angles: tuple[Floating, Floating],
) -> Piece:
    """Turn angles into numbers, a status and a message."""
    if len(rows) < len(value):
        table = {column: values[rows] for column, values in table.items()}
        ring, arcs, value = ring.take(rows), arcs.take(rows), value[rows]
    joined = join_regions(ring, arcs, *angles)
    diagnosis = diagnose(ring, arcs, joined)
    numbers = _numbers(table, ring, joined)
    numbers["balance_residual"] = diagnosis.balance_residual
    numbers["lowest_pressure_mpa"] = diagnosis.lowest_pressure * numbers["mean_pressure_mpa"]
    solved = is_solution(joined, target, value)
    solved &= np.abs(diagnosis.balance_residual) <= LARGEST_RESIDUAL
    solved &= np.sqrt(ring.kappa2) * joined.contact_angle <= LARGEST_KAPPA_ANGLE
    beyond = solved & (numbers["displacement_mm"] > table["largest"])
    message = doubts(diagnosis)
    doubtful = np.array([text != "" for text in message])
    status = np.select(
        [~solved, beyond, doubtful], ["no_convergence", "beyond_model", "doubtful"], "ok"
    )
    for row in np.flatnonzero(beyond):
        message[row] = (
            f"needs a displacement of {numbers['displacement_mm'][row]:.4g} mm, more than the "
            f"{table['largest'][row]:.4g} mm that the wheel allows"
        )
    for row in np.flatnonzero(~solved):
        message[row] = "no contact and transition angle meet the conditions to rounding"
    for values in numbers.values():
        values[~solved | beyond] = np.nan
    return Piece(rows, numbers, status, message, ring, arcs, joined)


def _numbers(table: dict[str, Floating], ring: ScaledRing, joined: Joined) -> dict[str, Floating]:
    """Return the result columns in N, mm, MPa and degrees."""
    shear, radius = table["shear_stiffness_n"], table["radius_mm"]
    displacement, load = joined.sinking[:, 0] * radius, joined.force[:, 0] * shear
    spokes = 2 * ring.compression * joined.sinking[:, 0] * joined.contact_angle * shear
    return {
        "displacement_mm": displacement,
        "load_n": load,
        "theta_c_deg": np.degrees(joined.contact_angle),
        "theta_t_deg": np.degrees(joined.transition_angle),
        "stiffness_n_per_mm": load / displacement,
        "tangent_stiffness_n_per_mm": _tangent(joined) * shear / radius,
        "contact_force_n": spokes,
        "ring_force_n": load - spokes,
        "mean_pressure_mpa": load / (2 * radius * joined.contact_angle * table["width_mm"]),
    }


def _tangent(joined: Joined) -> Floating:
    """dF/dδ along the solutions, on which u(θt) = 0 fixes dθt/dθc."""
    by_c = -joined.transition[:, 1] / joined.transition[:, 2]
    force = joined.force[:, 1] + joined.force[:, 2] * by_c
    return np.asarray(force / (joined.sinking[:, 1] + joined.sinking[:, 2] * by_c))
