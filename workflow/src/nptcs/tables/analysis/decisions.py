"""Contracts of decisions: outcome, designs, front and confirmation."""

from __future__ import annotations

from typing import Literal, get_args

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series

DecisionStatus = Literal["feasible", "infeasible", "refused"]
Confirmation = Literal["not asked", "inside", "outside", "not solved", ""]


class Decisions(pa.DataFrameModel):
    """``decisions.csv``: the goals and the outcome, one row per decision."""

    decision: Series[str] = pa.Field(unique=True)
    study: Series[str]
    solver: Series[str]
    goals: Series[str]
    with_probability: Series[float] = pa.Field(
        gt=0, lt=1, description="Probability that the decision requires"
    )
    status: Series[str] = pa.Field(
        isin=list(get_args(DecisionStatus)),
        description="refused: the question cannot be answered from these cases",
    )
    design: Series[str] = pa.Field(description="The chosen design; if infeasible, the nearest")
    plates: Series[pd.Int64Dtype] = pa.Field(
        ge=1, nullable=True, description="Plates of a leg of a spoke"
    )
    probability: Series[float] = pa.Field(
        ge=0,
        le=1,
        nullable=True,
        description="Sampled probability that all targets and bounds hold",
    )
    desirability: Series[float] = pa.Field(ge=0, le=1, nullable=True)
    feasible_percent: Series[float] = pa.Field(
        ge=0,
        le=100,
        nullable=True,
        description="Share of the candidates spread over the design space",
    )
    candidates: Series[pd.Int64Dtype] = pa.Field(ge=1, nullable=True)
    confirmation: Series[str] = pa.Field(
        isin=list(get_args(Confirmation)),
        description="Where the solved response is relative to the surface's prediction interval",
    )
    solved_designs: Series[int] = pa.Field(ge=0, description="Designs solved to confirm the choice")
    search_cpu_s: Series[float] = pa.Field(
        ge=0, nullable=True, description="Processor time of fit and search"
    )
    message: Series[str] = pa.Field(
        description="Why there is no acceptable design, if there is none"
    )

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class DecisionDesigns(pa.DataFrameModel):
    """``decision_designs.csv``: the best designs, all different, one row per design and goal."""

    decision: Series[str]
    rank: Series[int] = pa.Field(ge=1, description="By desirability")
    chosen: Series[bool]
    design: Series[str]
    plates: Series[pd.Int64Dtype] = pa.Field(ge=1, nullable=True)
    probability: Series[float] = pa.Field(
        ge=0, le=1, description="Sampled probability that all of them hold"
    )
    desirability: Series[float] = pa.Field(ge=0, le=1)
    goal: Series[str]
    response: Series[str]
    at: Series[str]
    unit: Series[str]
    mean: Series[float]
    sd: Series[float] = pa.Field(ge=0, description="Materials, tolerances and surface")
    low: Series[float] = pa.Field(description="Lower end of the interval, a quantile")
    high: Series[float]
    smallest_accepted: Series[float] = pa.Field(
        nullable=True, description="By the target or bound; empty where there is none"
    )
    largest_accepted: Series[float] = pa.Field(nullable=True)
    goal_probability: Series[float] = pa.Field(
        ge=0,
        le=1,
        nullable=True,
        description="Probability that this goal holds; empty for an objective",
    )

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class DecisionFront(pa.DataFrameModel):
    """``decision_front.csv``: acceptable designs that no other one betters in every objective."""

    decision: Series[str]
    point: Series[int] = pa.Field(ge=1)
    design: Series[str]
    probability: Series[float] = pa.Field(
        ge=0, le=1, description="Lower bound 1 - Σ (1 - p) of all targets and bounds"
    )
    goal: Series[str] = pa.Field(description="The objective")
    mean: Series[float]
    unit: Series[str]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class DecisionConfirmation(pa.DataFrameModel):
    """``decision_confirmation.csv``: chosen designs, solved; one row per round and response."""

    decision: Series[str]
    study: Series[str]
    solver: Series[str]
    round: Series[int] = pa.Field(ge=1)
    design: Series[str]
    response: Series[str]
    at: Series[str]
    unit: Series[str]
    predicted: Series[float] = pa.Field(nullable=True)
    low: Series[float] = pa.Field(nullable=True, description="Prediction interval of the surface")
    high: Series[float] = pa.Field(nullable=True)
    solved: Series[float] = pa.Field(nullable=True)
    difference: Series[float] = pa.Field(nullable=True, description="predicted - solved")
    result: Series[str] = pa.Field(isin=["inside", "outside", "not solved"])
    goal_met: Series[str] = pa.Field(
        isin=["yes", "no", ""], description="Whether the solved value meets the target or bound"
    )
    added: Series[bool] = pa.Field(
        description="Whether the case was added to the surfaces, which were fitted again"
    )
    wall_time_s: Series[float] = pa.Field(
        ge=0, description="Of the solver, when the case was solved"
    )
    message: Series[str]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
