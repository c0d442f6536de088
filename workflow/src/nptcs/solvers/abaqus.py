"""Solver ``abaqus``: the paper's whole tyre, solved by the user's own Abaqus."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import floor
from pathlib import Path
from typing import ClassVar

from pydantic import Field, field_validator

from nptcs.config.solvers.abaqus import AbaqusModel
from nptcs.decks.abaqus.deck import tyre_deck
from nptcs.solvers.abaqus_history import load_curve
from nptcs.solvers.abaqus_messages import COMPLETED, NOT_CONVERGED, licence_denial, read_messages
from nptcs.solvers.abaqus_watch import JobWatch, text_of
from nptcs.solvers.contract import (
    CASE_MEMORY,
    CASE_S,
    CaseInputs,
    Solver,
    SolverOptions,
    SolverResult,
    Status,
)
from nptcs.solvers.external import CommandStopped, Ended, run_command, time_for_command
from nptcs.solvers.fe_inputs import TYRE_FACTORS, checked_values, ply_constants

JOB = "tyre"
LOAD_TOLERANCE = 0.01


class AbaqusOptions(SolverOptions, AbaqusModel):
    """Options of ``abaqus``: the model, the command, and the licence."""

    without_effect: ClassVar[frozenset[str]] = SolverOptions.without_effect | {
        "cpus",
        "licence_tokens",
        "licence_wait_s",
        "keep_files",
    }

    timeout_s: float = Field(
        14400.0,
        gt=0,
        description="Wall time after which a case is stopped and recorded as timeout; waiting for "
        "a licence counts",
    )
    case_s: float = Field(3600.0, gt=0, description=CASE_S)
    case_memory_mb: float = Field(8000.0, gt=0, description=CASE_MEMORY)
    command: tuple[str, ...] = Field(("abaqus",), min_length=1, description="Command")
    arguments: tuple[str, ...] = Field(
        ("job={job}", "input={job}.inp", "cpus={cpus}", "interactive", "ask_delete=OFF"),
        description="Its arguments; {job} and {cpus} are filled in",
    )
    cpus: int = Field(1, ge=1, description="Cores of one case")
    licence_tokens: int | None = Field(
        None, ge=0, description="Tokens that one case takes; null: floor(5 cpus^0.422)"
    )
    licence_wait_s: float = Field(
        600.0,
        ge=0,
        description="Time that a case may queue for its tokens; after it the status is `licence`",
    )
    accepted_warnings: tuple[str, ...] = Field(
        (),
        description="Regular expressions of warnings that are kept as text although they look as "
        "if Abaqus had changed the model",
    )
    keep_files: Path | None = Field(
        None, description="Folder in which decks and Abaqus' files are kept; null: deleted"
    )

    @field_validator("accepted_warnings")
    @classmethod
    def _are_patterns(cls, patterns: tuple[str, ...]) -> tuple[str, ...]:
        for pattern in patterns:
            try:
                re.compile(pattern)
            except re.error as error:
                raise ValueError(f"{pattern!r} is not a regular expression: {error}") from None
        return patterns

    def cores_per_case(self) -> int:
        """Return the cores that Abaqus takes for a case."""
        return self.cpus

    def tokens_per_case(self) -> int:
        """Return the licence tokens of a case: as given, or floor(5 n^0.422) for n cores."""
        if self.licence_tokens is not None:
            return self.licence_tokens
        return floor(5.0 * self.cpus**0.422)


def solve(inputs: CaseInputs) -> SolverResult:
    """Return the load–displacement curve and the secant stiffness at the load of the case.

    Raises
    ------
    InputError
        If a value of the case is missing or has no meaning.
    """
    options: AbaqusOptions = inputs.options
    values = checked_values(inputs, TYRE_FACTORS)
    ply = ply_constants(inputs)
    deck = tyre_deck(options, inputs.tyre, ply, values, inputs.load_n, inputs.case_id)
    with _folder(options.keep_files, inputs.case_id) as folder:
        (folder / f"{JOB}.inp").write_text(deck, encoding="ascii")
        try:
            ended = run_command(
                [*options.command, *_arguments(options)],
                folder,
                time_for_command(options.timeout_s),
                JobWatch(folder / JOB, options.licence_wait_s, options.accepted_warnings),
            )
        except CommandStopped as stopped:
            curve = _curve(*load_curve(text_of(folder / JOB, "dat")))
            return SolverResult(status=stopped.status, message=str(stopped), curve=curve)
        return judge(folder, ended, inputs.load_n, options.accepted_warnings)


def judge(
    folder: Path, ended: Ended, load_n: float, accepted_warnings: Sequence[str] = ()
) -> SolverResult:
    """Make a result from the files that Abaqus left in a folder."""
    log, dat, msg, sta = (text_of(folder / JOB, kind) for kind in ("log", "dat", "msg", "sta"))
    displacement, force = load_curve(dat)
    messages = read_messages([dat, msg], accepted_warnings)
    if messages.fatal:
        return SolverResult(status=Status.ERROR, message=" | ".join(messages.fatal))
    if COMPLETED in sta:
        return _completed(displacement, force, load_n, messages.kept())
    if not messages.errors and (denial := licence_denial(ended.output + log)):
        return SolverResult(status=Status.LICENCE, message=denial)
    why = " | ".join((*messages.errors, *([messages.kept()] if messages.warnings else [])))
    if NOT_CONVERGED.search(msg):
        return SolverResult(
            status=Status.DIVERGED,
            message=f"last converged at {force[-1]:.6g} of {load_n:g} N: {why}",
            curve=_curve(displacement, force),
        )
    return SolverResult(
        status=Status.ERROR,
        message=why or f"Abaqus ended with code {ended.code}: {ended.output.strip()[-500:]}",
        curve=_curve(displacement, force),
    )


def _completed(
    displacement: list[float], force: list[float], load_n: float, kept: str
) -> SolverResult:
    if abs(force[-1] - load_n) > LOAD_TOLERANCE * load_n:
        return SolverResult(
            status=Status.ERROR,
            message=f"Abaqus completed, but the road carries {force[-1]:.6g} of {load_n:g} N "
            "in the .dat file",
            curve=_curve(displacement, force),
        )
    return SolverResult(
        status=Status.OK,
        message=kept,
        vertical_stiffness_n_per_mm=load_n / displacement[-1],
        displacement_mm=displacement[-1],
        curve=_curve(displacement, force),
    )


def _curve(displacement: list[float], force: list[float]) -> dict[str, list[float]] | None:
    if len(force) == 1:
        return None
    return {"displacement_mm": displacement, "force_n": force}


def _arguments(options: AbaqusOptions) -> list[str]:
    filled = {"{job}": JOB, "{cpus}": str(options.cpus)}
    arguments = list(options.arguments)
    for mark, value in filled.items():
        arguments = [argument.replace(mark, value) for argument in arguments]
    return arguments


@contextmanager
def _folder(keep: Path | None, case_id: str) -> Iterator[Path]:
    """Give a folder to work in: a temporary one, or a separate one in `keep`."""
    if keep is None:
        with tempfile.TemporaryDirectory(prefix="nptcs-abaqus-") as name:
            yield Path(name)
        return
    keep.mkdir(parents=True, exist_ok=True)
    yield Path(tempfile.mkdtemp(prefix=f"{case_id}-", dir=keep.resolve()))


SOLVER = Solver(
    name="abaqus",
    version="1",
    solve=solve,
    factors=TYRE_FACTORS,
    about="the paper's whole tyre, solved by the user's own Abaqus",
    required=TYRE_FACTORS,
    options=AbaqusOptions,
    needs_ply=True,
)
