"""Goals of a decision as a user writes them: ``K=300±5@5000``, ``plate_mass``."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from enum import StrEnum
from math import inf, isfinite, nan
from typing import assert_never

from nptcs.config.studies.response import RESPONSE_KINDS, Taken
from nptcs.errors import InputError

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
GOAL = re.compile(
    rf"""^\s*(?P<name>[A-Za-z][A-Za-z0-9_]*)\s*
    (?:=\s*(?P<value>{NUMBER})\s*(?:(?:±|\+/-|\+-)\s*(?P<plus_minus>{NUMBER})\s*)?)?
    (?:@\s*(?P<at>{NUMBER})\s*(?P<unit>N|mm)?\s*)?
    (?:\*\s*(?P<weight>{NUMBER})\s*)?$""",
    re.VERBOSE,
)
ALIASES = {"K": "secant_stiffness"}
"""Short names of responses."""


class GoalKind(StrEnum):
    """What a goal requires of a response."""

    TARGET = "target"
    AT_LEAST = "at least"
    AT_MOST = "at most"
    MINIMISE = "minimise"
    MAXIMISE = "maximise"


EXAMPLES = {
    GoalKind.TARGET: "K=300±5@5000",
    GoalKind.AT_LEAST: "K=250@3000",
    GoalKind.AT_MOST: "plate_largest_mises=120",
    GoalKind.MINIMISE: "plate_mass",
    GoalKind.MAXIMISE: "K@3000",
}
NEEDS_VALUE = frozenset({GoalKind.TARGET, GoalKind.AT_LEAST, GoalKind.AT_MOST})


@dataclass(frozen=True)
class ResponseName:
    """A response of a tyre: its name, and the load or displacement if one was given."""

    name: str
    at: str = ""

    def __str__(self) -> str:
        return f"{self.name} at {self.at}" if self.at else self.name


@dataclass(frozen=True)
class Goal:
    """One goal.

    Parameters
    ----------
    kind : GoalKind
        Targets and bounds must hold; minimise and maximise order the designs that meet them.
    response : ResponseName
        The response that it concerns.
    value, plus_minus : float
        Target with its half width, or bound; not a number where the kind has none.
    weight : float
        In the desirability; 0 for a target or bound that must hold and counts no further.
    text : str
        As the user wrote it.
    """

    kind: GoalKind
    response: ResponseName
    value: float
    plus_minus: float
    weight: float
    text: str

    @property
    def must_hold(self) -> bool:
        """Whether a design must meet it to be acceptable."""
        return self.kind in NEEDS_VALUE

    @property
    def limits(self) -> tuple[float, float]:
        """Return the smallest and the largest acceptable value; infinite where there is none."""
        match self.kind:
            case GoalKind.TARGET:
                return self.value - self.plus_minus, self.value + self.plus_minus
            case GoalKind.AT_LEAST:
                return self.value, inf
            case GoalKind.AT_MOST:
                return -inf, self.value
            case GoalKind.MINIMISE | GoalKind.MAXIMISE:
                return -inf, inf
            case _:
                assert_never(self.kind)

    def __str__(self) -> str:
        match self.kind:
            case GoalKind.TARGET:
                return f"{self.response} = {self.value:g} ± {self.plus_minus:g}"
            case GoalKind.AT_LEAST | GoalKind.AT_MOST:
                return f"{self.response} {self.kind.value} {self.value:g}"
            case GoalKind.MINIMISE | GoalKind.MAXIMISE:
                return f"{self.kind.value} {self.response}"
            case _:
                assert_never(self.kind)


def read_goal(kind: GoalKind, text: str) -> Goal:
    """Read one goal.

    Parameters
    ----------
    kind : GoalKind
        Given by the key or the option under which the text is written.
    text : str
        ``NAME[=VALUE[±HALF_WIDTH]][@LOAD[N]|@DISPLACEMENTmm][*WEIGHT]``; ``+-`` and ``+/-`` are
        read as ±, ``K`` as ``secant_stiffness``.

    Raises
    ------
    InputError
        Naming what is missing or not allowed, with an example.

    Examples
    --------
    >>> print(read_goal(GoalKind.TARGET, "K=300+-5@5000"))
    secant_stiffness at 5000 N = 300 ± 5
    >>> read_goal(GoalKind.MINIMISE, "plate_mass").weight
    1.0
    """
    found = GOAL.match(text)
    if found is None:
        raise _fault(kind, text, "cannot be read")
    name = ALIASES.get(found["name"], found["name"])
    _check_response(name, found["at"] is not None, text)
    value, plus_minus, at, weight = (
        _number(found[part]) for part in ("value", "plus_minus", "at", "weight")
    )
    faults = _faults(kind, value, plus_minus, at, weight)
    if faults:
        raise _fault(kind, text, faults[0])
    default_weight = 0.0 if kind in NEEDS_VALUE else 1.0
    return Goal(
        kind=kind,
        response=ResponseName(name, "" if at is None else f"{at:g} {found['unit'] or 'N'}"),
        value=nan if value is None else value,
        plus_minus=nan if plus_minus is None else plus_minus,
        weight=default_weight if weight is None else weight,
        text=text.strip(),
    )


def _faults(
    kind: GoalKind,
    value: float | None,
    plus_minus: float | None,
    at: float | None,
    weight: float | None,
) -> list[str]:
    """List what a goal of this kind lacks, and what it must not have."""
    needs_value, is_target = kind in NEEDS_VALUE, kind is GoalKind.TARGET
    found = {
        "has no value": needs_value and value is None,
        "has a value, which a goal of this kind does not use": not needs_value
        and value is not None,
        "has no half width after ±": is_target and plus_minus is None,
        "has a half width, which only a target has": not is_target and plus_minus is not None,
        "has a half width that is not above zero": plus_minus is not None and not plus_minus > 0,
        "has a load or displacement that is not above zero": at is not None and not at > 0,
        "has a negative weight": weight is not None and weight < 0,
    }
    return [fault for fault, is_so in found.items() if is_so]


def read_goals(texts: Iterable[tuple[GoalKind, str]]) -> tuple[Goal, ...]:
    """Read all goals of a decision.

    Raises
    ------
    InputError
        For a text that cannot be read, for no goal at all, and for two goals of one kind for the
        same response.
    """
    goals = tuple(read_goal(kind, text) for kind, text in texts)
    if not goals:
        raise InputError(
            "a decision needs a goal",
            column="decisions",
            remedy=f"give a target, for example {EXAMPLES[GoalKind.TARGET]}",
        )
    seen: dict[tuple[GoalKind, ResponseName], str] = {}
    for goal in goals:
        key = (goal.kind, goal.response)
        if key in seen:
            raise InputError(
                f"two goals of the kind '{goal.kind.value}' for {goal.response}",
                column="decisions",
                value=f"{seen[key]}, {goal.text}",
                remedy="keep one of them",
            )
        seen[key] = goal.text
    return goals


def _check_response(name: str, placed: bool, text: str) -> None:
    """Refuse a response that no tyre has, or a load where it is not taken at any load."""
    kind = RESPONSE_KINDS.get(name)
    if kind is None:
        near = get_close_matches(name, [*RESPONSE_KINDS, *ALIASES], 1)
        guess = f"did you mean {near[0]}? " if near else ""
        raise InputError(
            f"unknown response {name!r}",
            column="decisions",
            value=text,
            remedy=f"{guess}known responses: K, {', '.join(RESPONSE_KINDS)}",
        )
    if placed and kind.taken is not Taken.ANYWHERE:
        raise InputError(
            f"{name} is taken {kind.taken.value}",
            column="decisions",
            value=text,
            remedy="leave out what follows @",
        )


def _number(text: str | None) -> float | None:
    if text is None:
        return None
    number = float(text)
    if not isfinite(number):
        raise InputError("this number is too large", column="decisions", value=text)
    return number


def _fault(kind: GoalKind, text: str, what: str) -> InputError:
    return InputError(
        f"this goal ({kind.value}) {what}",
        column="decisions",
        value=text,
        remedy=f"write it like {EXAMPLES[kind]}",
    )
