"""The surfaces that a study fits next to its polynomial: ``studies[].surfaces``."""

from __future__ import annotations

from typing import Annotated, Literal, assert_never

from pydantic import Field

from nptcs.config.base import Strict

Link = Literal["identity", "log", "reciprocal"]
Choice = Literal["as_given", "aicc", "press"]
LaminationCoefficients = Literal[6, 7, 8]


class PolynomialModel(Strict):
    """A polynomial in the study's factors, fitted to the response or to a function of it."""

    kind: Literal["polynomial"]
    link: Link = Field(
        "identity",
        description="What the polynomial is fitted to: the response K (identity), log K, or 1/K "
        "(reciprocal)",
    )
    terms: tuple[str, ...] = Field((), description="Terms; empty: those of the study")
    choose: Choice = Field(
        "as_given",
        description="as_given: all terms; aicc, press: the subset of the terms, hierarchy kept, "
        "with the smallest corrected Akaike criterion or the smallest PRESS",
    )
    through_origin: bool = Field(
        False, description="No intercept: leave '1' out of `terms`; factors are scaled, not centred"
    )


class LaminationModel(Strict):
    """The lamination form: compliance of ring, rubber and plates, with [+A/-A] plates."""

    kind: Literal["lamination"]
    coefficients: LaminationCoefficients = Field(
        7,
        description="8: all; 7 or 6: one or two of the exponent m and the rubber's additions to "
        "A66 and D11 are left out, whichever gives the smallest sum of squares",
    )


MeanModel = Annotated[PolynomialModel | LaminationModel, Field(discriminator="kind")]


class GaussianProcessModel(Strict):
    """A Gaussian process (Matérn 5/2, one length scale for each factor) on a mean."""

    kind: Literal["gaussian_process"]
    mean: MeanModel | None = Field(
        None,
        description="Surface whose residuals the process models; null: the mean response of the "
        "cases",
    )


class SpokeProcessModel(Strict):
    """For studies in which each spoke is solved with several rings (design `split_plot`)."""

    kind: Literal["spoke_process"]
    degree: int = Field(
        3,
        ge=1,
        le=6,
        description="Degree of the polynomial in the logarithms of the ring's factors on one spoke",
    )


AnySurface = PolynomialModel | LaminationModel | GaussianProcessModel | SpokeProcessModel
SurfaceModel = Annotated[AnySurface, Field(discriminator="kind")]


def surface_name(model: AnySurface) -> str:
    """Return the name of a surface in tables, e.g. ``gaussian process on lamination 7``."""
    match model:
        case PolynomialModel():
            link = "" if model.link == "identity" else f" of {model.link}"
            origin = " through the origin" if model.through_origin else ""
            own = f" with {len(model.terms)} own terms" if model.terms else ""
            chosen = "" if model.choose == "as_given" else f", terms by {model.choose}"
            return f"polynomial{link}{origin}{own}{chosen}"
        case LaminationModel():
            return f"lamination {model.coefficients}"
        case GaussianProcessModel():
            return f"gaussian process on {surface_name(model.mean) if model.mean else 'the mean'}"
        case SpokeProcessModel():
            return "spoke process"
        case _:
            assert_never(model)


def needs_ply(model: AnySurface) -> bool:
    """Tell whether a surface uses the constants of the ply."""
    match model:
        case PolynomialModel():
            return False
        case LaminationModel():
            return True
        case GaussianProcessModel():
            return model.mean is not None and needs_ply(model.mean)
        case SpokeProcessModel():
            return True
        case _:
            assert_never(model)


def own_terms(
    model: AnySurface,
) -> tuple[tuple[str, ...], bool]:
    """Return the terms that a surface itself lists, and whether it goes through the origin."""
    match model:
        case PolynomialModel():
            return model.terms, model.through_origin
        case LaminationModel():
            return (), False
        case GaussianProcessModel():
            return own_terms(model.mean) if model.mean is not None else ((), False)
        case SpokeProcessModel():
            return (), False
        case _:
            assert_never(model)


def describes_stiffness_alone(model: AnySurface) -> bool:
    """Tell whether a surface is the form of a stiffness, which no other response follows."""
    match model:
        case PolynomialModel() | SpokeProcessModel():
            return False
        case LaminationModel():
            return True
        case GaussianProcessModel():
            return model.mean is not None and describes_stiffness_alone(model.mean)
        case _:
            assert_never(model)
