"""What a solver is: a function from one case to one result, and what it says about itself.

A solver is a module with a constant ``SOLVER`` of class `Solver`. To add one, write the module
and name it in `nptcs.solvers.registry` (or name its file in the configuration).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BaseModel, ConfigDict, Field, field_validator

from nptcs.arrays import Array
from nptcs.config.base import Strict
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.tables.status import Status as Status

if TYPE_CHECKING:
    import pandas as pd

CASE_S = "Wall time that a case usually takes; decides the size and the time limit of a job"
CASE_MEMORY = "Memory that a case may need; a job of a queue requests it"


class SolverOptions(Strict):
    """Base of a solver's own section ``solvers: NAME:`` in the configuration."""

    without_effect: ClassVar[frozenset[str]] = frozenset({"timeout_s", "case_s", "case_memory_mb"})
    """Options that cannot change a result; they are not part of the key of a solved case."""

    timeout_s: float = Field(
        600.0, gt=0, description="Wall time after which a case is stopped and recorded as timeout"
    )
    case_s: float = Field(1.0, gt=0, description=CASE_S)
    case_memory_mb: float = Field(150.0, gt=0, description=CASE_MEMORY)

    def tables(self) -> Mapping[str, str]:
        """Name the CSV files that the solver reads: a key for the solver → path."""
        return {}

    def load_fault(self, load_n: float) -> str:
        """Say why no case can be solved at this load; empty if cases can."""
        return ""

    def cores_per_case(self) -> int:
        """Return the cores that the solver of one case keeps busy."""
        return 1

    def tokens_per_case(self) -> int:
        """Return the licence tokens that one case takes; 0 for a solver without a licence."""
        return 0


@dataclass(frozen=True)
class CaseInputs:
    """Everything that a solver may look at.

    Parameters
    ----------
    case_id : str
        For messages only; results must not depend on it.
    values : mapping of str to float
        Factor values of the case and the study's fixed values, e.g. ``spacing_mm``,
        ``thickness_mm``, ``angle_deg``, ``shear_band_c10_mpa``, ``spoke_c10_mpa``.
    load_n : float
        Vertical load at which the secant stiffness is taken; NaN for a solver that loads
        no tyre.
    tyre : TyreGeometry
        Dimensions of the tyre.
    ply : mapping of str to float or None
        The nine ply constants (`nptcs.tables.laboratory.material_card.PLY_CONSTANTS`), if the
        solver needs them.
    options : SolverOptions
        The solver's own options.
    tables : mapping of str to a sequence of rows
        Content of ``options.tables()``; a row is a mapping of column name to value.
    """

    case_id: str
    values: Mapping[str, float]
    load_n: float
    tyre: TyreGeometry
    options: Any
    ply: Mapping[str, float] | None = None
    tables: Mapping[str, Sequence[Mapping[str, Any]]] = field(default_factory=dict)


@dataclass(frozen=True)
class TableInputs:
    """What a solver may look at when it solves a whole table of cases at once.

    Parameters
    ----------
    cases : DataFrame
        ``case_id``, for messages only, and a column for each value, as `CaseInputs.values`.
    load_n, tyre, options, ply, tables
        As in `CaseInputs`; they are the same for all cases.
    """

    cases: pd.DataFrame
    load_n: float
    tyre: TyreGeometry
    options: Any
    ply: Mapping[str, float] | None = None
    tables: Mapping[str, Sequence[Mapping[str, Any]]] = field(default_factory=dict)

    def case(self, row: int) -> CaseInputs:
        """Return the inputs of one case, by its place in the table."""
        values = {str(name): value for name, value in self.cases.iloc[row].items()}
        case_id = str(values.pop("case_id"))
        numbers = {name: float(value) for name, value in values.items()}
        return CaseInputs(
            case_id, numbers, self.load_n, self.tyre, self.options, self.ply, self.tables
        )

    def rows(self, start: int, stop: int) -> TableInputs:
        """Return the same inputs with some of the cases."""
        return replace(self, cases=self.cases.iloc[start:stop].reset_index(drop=True))


class SolverResult(BaseModel):
    """What a solver returns: a status with a message, and the responses if it has any."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    status: Status
    message: str = ""
    vertical_stiffness_n_per_mm: float | None = Field(None, description="Secant F/δ at the load")
    displacement_mm: float | None = Field(None, description="Vertical displacement δ at the load")
    extra: dict[str, float] = Field(
        default_factory=dict, description="Further scalars, unit in the name (theta_c_deg, …)"
    )
    realised: dict[str, float] = Field(
        default_factory=dict,
        description="Values actually used for factors of which the solver can use only some "
        "values (a whole number of plates); a factor that is not named was used as given",
    )
    curve: dict[str, list[float]] | None = Field(
        None, description="Columns of equal length, e.g. displacement_mm and force_n"
    )
    neutral_line: dict[str, list[float]] | None = Field(
        None,
        description="Displacement of the band's neutral line at the load, as "
        "`neutral_line_columns` makes it: theta_deg, radial_mm, tangential_mm",
    )
    died: bool = Field(
        False, description="The case ended for a reason outside it: killed, or out of memory"
    )

    plate_stress: dict[str, list[float]] | None = Field(
        None,
        description="Stress at the faces of the most loaded spokes' plates at the load: spoke, "
        "leg, face, height_mm, ply_deg, along_mpa, across_mpa, shear_mpa, mises_mpa, "
        "mean_mises_mpa",
    )

    @field_validator("curve", "neutral_line", "plate_stress")
    @classmethod
    def _equally_long(cls, columns: dict[str, list[float]] | None) -> dict[str, list[float]] | None:
        lengths = {name: len(column) for name, column in (columns or {}).items()}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"columns must be equally long, got {lengths}")
        return columns


NEUTRAL_LINE_DIGITS = 6
"""Significant digits of a neutral line: a case keeps hundreds of points."""


def neutral_line_columns(
    theta_deg: ArrayLike, radial_mm: ArrayLike, tangential_mm: ArrayLike
) -> dict[str, list[float]]:
    """Write the displacement of the band's neutral line for `SolverResult.neutral_line`.

    Parameters
    ----------
    theta_deg : array-like
        Angle of each point before the load, 0 at the middle of the contact, positive
        anticlockwise.
    radial_mm, tangential_mm : array-like
        Displacement of the point relative to the rim, outward and towards larger angles.

    Returns
    -------
    dict of str to list of float
        Columns in the order of the angle, between -180° and 180°, to six significant digits.
    """
    angle = np.asarray(theta_deg, dtype=float)
    wrapped = np.where(np.abs(angle) > 180.0, (angle + 180.0) % 360.0 - 180.0, angle)
    order = np.argsort(wrapped, kind="stable")
    columns = {"theta_deg": wrapped, "radial_mm": radial_mm, "tangential_mm": tangential_mm}
    return {name: _rounded(np.asarray(column)[order]) for name, column in columns.items()}


def _rounded(values: Array) -> list[float]:
    return [float(f"{value + 0.0:.{NEUTRAL_LINE_DIGITS}g}") for value in values]


TYRE_RESPONSES = ("vertical_stiffness_n_per_mm", "displacement_mm")
"""What a solver of tyres gives for every case that is ok."""

SPOKE_RESPONSES = tuple(
    f"{direction}_{quantity}"
    for direction in ("tension", "compression")
    for quantity in ("stiffness_n_per_mm", "r2_uncentred", "r2_centred")
)
"""What a solver of single spokes gives in `SolverResult.extra`: the lines through the origin."""


@dataclass(frozen=True)
class Solver:
    """A solver and what it says about itself.

    Parameters
    ----------
    name : str
        Name in the configuration and in every table.
    version : str
        Version of its physics: change it with any change that may alter a result. It is part
        of the key under which results are kept.
    solve : callable
        ``CaseInputs → SolverResult``. It may raise: the campaign records the exception.
    factors : frozenset of str
        The factors that it uses. A study that varies any other is refused.
    about : str
        What it is, in a few words without a full stop; the report prints them after its name.
    required : frozenset of str
        Values that must be given for each case, as factor or as fixed value.
    options : type of SolverOptions
        Its section of the configuration.
    needs_ply : bool
        Whether the ply constants are handed to it (and are part of the key).
    loads_tyre : bool
        Whether it loads a tyre: the study's load is handed to it (and is part of the key) and
        it gives `TYRE_RESPONSES`. A solver of single spokes does not; it gives `SPOKE_RESPONSES`.
    realise : callable, optional
        ``(values, tyre) → values`` that the solver really uses for the factors of which it can
        use only some values; the campaign records them with each solved case.
    solve_table : callable, optional
        ``TableInputs → DataFrame``, one row per case in their order: ``status``, ``message``,
        `TYRE_RESPONSES` and further scalars, units in the names; ``realised_FACTOR`` for each
        factor of which it used another value. The same numbers as `solve`, without curves. It may
        raise: the campaign then divides the table until it has found the cases at fault.
    table_cases : int
        Most cases that the table function is given at once; the time limit is for all of them.
    preload : tuple of str, optional
        Modules that take long to import; the process that all cases are forked from has them.
    table_case_s : float, optional
        Wall time that a case of a table usually takes; by default that of a single case.
    shares : frozenset of str
        Factors that decide a part that cases share, as designs with equal spokes share a table;
        `SolverOptions.case_s` is the time of a case that has to compute this part.
    shared_case_s : float
        Wall time that a case usually takes if the shared part is already there.
    """

    name: str
    version: str
    solve: Callable[[CaseInputs], SolverResult]
    factors: frozenset[str]
    about: str = field(kw_only=True)
    required: frozenset[str] = frozenset()
    options: type[SolverOptions] = SolverOptions
    needs_ply: bool = False
    loads_tyre: bool = True
    realise: Callable[[Mapping[str, float], TyreGeometry], dict[str, float]] | None = None
    solve_table: Callable[[TableInputs], pd.DataFrame] | None = None
    table_cases: int = 5000
    table_case_s: float | None = None
    shares: frozenset[str] = frozenset()
    shared_case_s: float = 0.0
    preload: tuple[str, ...] = ()

    def missing_responses(self, result: SolverResult) -> list[str]:
        """Name the responses that a result with status ``ok`` must have and lacks."""
        return missing_responses(result, self.loads_tyre)


def missing_responses(result: SolverResult, loads_tyre: bool) -> list[str]:
    """Name the responses that an ``ok`` result of a tyre or a single spoke lacks."""
    if not result.status.solved:
        return []
    given = {**result.model_dump(include=set(TYRE_RESPONSES)), **result.extra}
    promised = TYRE_RESPONSES if loads_tyre else SPOKE_RESPONSES
    return [name for name in promised if given.get(name) is None]
