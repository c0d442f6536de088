"""The section ``decisions:`` of the configuration: what is required of a design."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from nptcs.config.base import Name, Strict
from nptcs.config.studies.goals import Goal, GoalKind, read_goals
from nptcs.errors import InputError


class Decision(Strict):
    """A question to a study: which of its designs meets these goals.

    Goals are written as on the command line of ``nptcs design``: ``K=300±5@5000`` is the secant
    stiffness at 5000 N, in N/mm; other names are those of the column `response` in
    ``tyre_responses.csv``. ``*2`` at the end is a weight in the desirability.
    """

    name: Name = Field(description="Name in tables and files")
    title: str = Field("", description="Heading in the report; empty: the goals in words")
    study: str = Field("", description="The study that the decision belongs to; may be left out")
    solver: Name = Field(description="Solver whose cases are used, and which confirms the design")
    surface: str | None = Field(
        None,
        description="Surface of the study through which the stiffness is predicted; empty: "
        "`uncertainty.surface`, or the best of the study as described there. Other responses are "
        "predicted by the surface of that name or the best that they have",
    )
    targets: tuple[str, ...] = Field((), description="Such as K=300±5@5000; must hold")
    at_least: tuple[str, ...] = Field((), description="Such as K=250@3000; must hold")
    at_most: tuple[str, ...] = Field((), description="Such as plate_largest_mises=120; must hold")
    minimise: tuple[str, ...] = Field(
        (), description="Such as plate_mass; orders the designs that meet all targets and bounds"
    )
    maximise: tuple[str, ...] = Field((), description="Such as K@3000, likewise")
    with_probability: float = Field(
        0.9,
        gt=0,
        lt=1,
        description="Probability with which all targets and bounds must hold together, over the "
        "uncertainty of materials, tolerances and surface",
    )
    hold: dict[str, float] = Field(
        default_factory=dict, description="Factors that are not free, with their value"
    )
    steps: dict[str, float] = Field(
        default_factory=dict,
        description="By factor, the step of values that can be made, for example "
        "{thickness_mm: 0.05}; a spacing always gives a whole number of plates where the solver "
        "uses whole numbers",
    )
    top: int = Field(5, ge=1, le=50, description="Designs that are listed, all different")
    confirm: bool = Field(
        False,
        description="Solve the chosen design and compare; a result outside the interval becomes "
        "a case of the surface, which is fitted again, and the choice is repeated",
    )
    rounds: int = Field(3, ge=1, le=20, description="Designs solved at most to confirm a choice")

    @model_validator(mode="after")
    def _goals_can_be_read(self) -> Self:
        try:
            self.goals()
        except InputError as error:
            raise ValueError(str(error)) from None
        if stray := [name for name, step in self.steps.items() if not step > 0]:
            raise ValueError(f"steps must be above zero: {', '.join(stray)}")
        if both := sorted(set(self.hold) & set(self.steps)):
            raise ValueError(f"both held and stepped: {', '.join(both)}")
        return self

    def goals(self) -> tuple[Goal, ...]:
        """Return all goals.

        Raises
        ------
        InputError
            For a goal that cannot be read.
        """
        given = {
            GoalKind.TARGET: self.targets,
            GoalKind.AT_LEAST: self.at_least,
            GoalKind.AT_MOST: self.at_most,
            GoalKind.MINIMISE: self.minimise,
            GoalKind.MAXIMISE: self.maximise,
        }
        return read_goals((kind, text) for kind, texts in given.items() for text in texts)
