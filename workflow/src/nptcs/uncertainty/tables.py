"""Uncertainty of the responses of named designs, and its sources, as tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.studies.goals import ResponseName
from nptcs.tables.analysis.uncertainty import ResponseUncertainty, UncertaintyShares
from nptcs.tables.published.stiffness import StiffnessErrors
from nptcs.uncertainty.fitted import FittedResponse
from nptcs.uncertainty.inputs import Inputs, UncertainInput
from nptcs.uncertainty.propagate import (
    SURFACE,
    Moments,
    assessed,
    distribution,
    moments,
    shares_percent,
)
from nptcs.uncertainty.source import Source


@dataclass(frozen=True)
class NamedDesign:
    """A design whose responses are assessed.

    Parameters
    ----------
    name : str
        ``reference``, or the name of a decision.
    source : Source
    point : ndarray of shape (n,)
        Factors of the study, as the solver uses them.
    fitted : tuple of FittedResponse
    """

    name: str
    source: Source
    point: Array
    fitted: tuple[FittedResponse, ...]


@dataclass(frozen=True)
class UncertaintyTables:
    """`ResponseUncertainty` and `UncertaintyShares`."""

    responses: pd.DataFrame
    shares: pd.DataFrame


def uncertainty_tables(designs: Sequence[NamedDesign], errors: pd.DataFrame) -> UncertaintyTables:
    """Propagate the uncertainties of each design to each of its responses.

    Parameters
    ----------
    designs : sequence of NamedDesign
    errors : DataFrame
        `nptcs.tables.published.stiffness.StiffnessErrors`: the solvers' bias, shown next to the
        interval.
    """
    errors = errors[list(StiffnessErrors.to_schema().columns)]
    responses: list[dict[str, object]] = []
    shares: list[dict[str, object]] = []
    for design in designs:
        inputs = design.source.inputs()
        bias = _bias(design, errors)
        for fitted in design.fitted:
            row, parts = _assess(design, fitted, inputs)
            compared = fitted.response == _published_response(design)
            responses.append({**row, **(bias if compared else NO_BIAS)})
            shares += parts
    return UncertaintyTables(
        pd.DataFrame(responses, columns=list(ResponseUncertainty.to_schema().columns)),
        pd.DataFrame(shares, columns=list(UncertaintyShares.to_schema().columns)),
    )


def design_text(point: Array, factors: Sequence[str], plates: int | None = None) -> str:
    """Write a design for a reader: ``15 plates, spacing_mm 14.33, thickness_mm 1.8``."""
    values = [f"{name} {value:.5g}" for name, value in zip(factors, point, strict=True)]
    return ", ".join([*([f"{plates} plates"] if plates else []), *values])


NO_BIAS: Mapping[str, object] = {
    "bias_mean_percent": np.nan,
    "bias_largest_percent": np.nan,
    "blind_cases": pd.NA,
}


def _published_response(design: NamedDesign) -> ResponseName:
    """Return the only response with published values: secant stiffness at the study's load."""
    return ResponseName("secant_stiffness", f"{design.source.results.study.load_n:g} N")


def _bias(design: NamedDesign, errors: pd.DataFrame) -> Mapping[str, object]:
    """Difference of the solver from the published stiffness at blind cases of the same study."""
    results = design.source.results
    rows = errors[
        (errors["study"] == results.study.name)
        & (errors["solver"] == results.solver)
        & (errors["group"] == "blind")
        & (errors["compared"] > 0)
    ]
    if rows.empty:
        return NO_BIAS
    row = rows.iloc[0]
    return {
        "bias_mean_percent": row["mean_percent"],
        "bias_largest_percent": row["largest_percent"],
        "blind_cases": row["compared"],
    }


def _assess(
    design: NamedDesign, fitted: FittedResponse, inputs: Inputs
) -> tuple[dict[str, object], list[dict[str, object]]]:
    """Return the row of one response and the rows of its sources."""
    source, settings = design.source, design.source.settings
    followed, not_followed = assessed(fitted.model, inputs.inputs)
    found = moments(fitted.model, followed, design.point[None, :])
    samples = distribution([fitted.model], followed, design.point, settings.samples, settings.seed)[
        :, 0
    ]
    low, high = np.quantile(samples, [0.5 - settings.confidence / 2, 0.5 + settings.confidence / 2])
    variance = float(samples.var(ddof=1))
    total = float(found.variances.sum())
    about = {
        "study": source.results.study.name,
        "solver": source.results.solver,
        "design": design.name,
        "response": fitted.response.name,
        "at": fitted.response.at,
        "unit": fitted.unit,
    }
    row = {
        **about,
        "factors": design_text(design.point, fitted.model.factors),
        "nominal": found.nominal[0],
        "mean": samples.mean(),
        "sd": np.sqrt(variance),
        "low": low,
        "high": high,
        "confidence_percent": 100 * settings.confidence,
        "interaction_percent": 100 * (variance - total) / variance if variance else 0.0,
        "surface": fitted.surface,
        "cases": fitted.cases,
        "card": settings.card,
        "note": "; ".join([*fitted.notes, *_unassessed_words(not_followed, inputs)]),
    }
    return row, [{**about, **part} for part in _shares(fitted, followed, found, design.point)] + [
        {**about, **part} for part in _not_assessed(not_followed, inputs)
    ]


def _shares(
    fitted: FittedResponse, followed: Sequence[UncertainInput], found: Moments, point: Array
) -> Iterator[dict[str, object]]:
    """One row per source, the largest first."""  # noqa: D401
    variances = found.variances[0]
    percent = shares_percent(variances)
    sources = [*followed, SURFACE]
    for place in np.argsort(-variances, kind="stable"):
        one = sources[place]
        if variances[place] == 0.0 and not one.quantities:
            continue
        yield {
            "kind": one.kind.value,
            "quantities": _quantities(one, fitted.model.factors, point),
            "source": one.source,
            "effect_sd": np.sqrt(variances[place]),
            "share_percent": percent[place],
        }


def _quantities(one: UncertainInput, factors: Sequence[str], point: Array) -> str:
    if not one.quantities:
        return "the surface's own error"
    parts = []
    for name, sd in zip(one.quantities, one.standard_deviations, strict=True):
        scale = point[list(factors).index(name)] if one.relative else 1.0
        parts.append(f"{name} ± {scale * sd:.3g}")
    return ", ".join(parts)


def _not_assessed(
    not_followed: Sequence[UncertainInput], inputs: Inputs
) -> Iterator[dict[str, object]]:
    reasons = {one.name: "no model of this response shows its effect" for one in not_followed}
    for name, reason in {**reasons, **inputs.not_assessed}.items():
        yield {
            "kind": "not assessed",
            "quantities": name,
            "source": reason,
            "effect_sd": np.nan,
            "share_percent": np.nan,
        }


def _unassessed_words(not_followed: Sequence[UncertainInput], inputs: Inputs) -> list[str]:
    names = [*(one.name for one in not_followed), *inputs.not_assessed]
    return [f"not assessed: {', '.join(names)}"] if names else []
