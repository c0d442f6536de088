"""What is uncertain: tests of the ply, rubbers and tolerances as independent standard inputs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, assert_never

import numpy as np

from nptcs.arrays import Array
from nptcs.config.studies.uncertainty import (
    CardUncertainty,
    RubberUncertainty,
    Tolerance,
    Uncertainty,
)
from nptcs.errors import InputError
from nptcs.tables.analysis.uncertainty import SourceKind
from nptcs.tables.laboratory.material_card import MaterialCard, PlyCard, RubberCard

RUBBERS = ("shear_band_c10_mpa", "spoke_c10_mpa")


@dataclass(frozen=True)
class UncertainInput:
    """Quantities that vary together: quantity j changes by Σ root_jk z_k.

    Parameters
    ----------
    name : str
        The quantities, in words.
    kind : SourceKind
    source : str
        Specimens, or the key of the configuration.
    quantities : tuple of str
        Factors, rubbers or constants of the ply.
    root : ndarray of shape (quantities, d)
        In the unit of each quantity. Normal z have the standard deviation 1, uniform z lie in
        [-1, 1].
    shape : str
        Distribution of each z.
    relative : bool
        Whether `root` is a share of the design's own value, for a rubber that is a factor.
    """

    name: str
    kind: SourceKind
    source: str
    quantities: tuple[str, ...]
    root: Array
    shape: Literal["normal", "uniform"] = "normal"
    relative: bool = False

    @property
    def standard_deviations(self) -> Array:
        """Standard deviation of each quantity, or its share of the value."""
        spread = np.sqrt((self.root**2).sum(axis=1))
        return spread if self.shape == "normal" else spread / np.sqrt(3.0)


@dataclass(frozen=True)
class Inputs:
    """All uncertain inputs of a design, and what is not assessed, with the reason."""

    inputs: tuple[UncertainInput, ...]
    not_assessed: Mapping[str, str]


def uncertain_inputs(
    settings: Uncertainty,
    card: MaterialCard,
    ply: PlyCard | None,
    values: Mapping[str, float],
    factors: Sequence[str],
) -> Inputs:
    """List what is uncertain about the designs of a study.

    Parameters
    ----------
    settings : Uncertainty
    card : MaterialCard
        For the tested rubbers.
    ply : PlyCard or None
        Ply of the plates; None where the solver does not use the constants of a ply.
    values : mapping of str to float
        Factors and fixed values of the study; of the factors only the names are used.
    factors : sequence of str
        Names of the factors: rubbers among them scatter in proportion to their value.

    Returns
    -------
    Inputs

    Raises
    ------
    InputError
        When the configuration names a rubber that has no card.
    """
    found = [*_tolerances(settings.tolerances, values)]
    missing = {
        name: "not a factor or fixed value of this study"
        for name in settings.tolerances
        if name not in values
    }
    if ply is not None:
        tests, untested = ply_inputs(ply, settings.card)
        found += tests
        missing |= untested
    for name in RUBBERS:
        if name not in values:
            continue
        if name in settings.rubbers:
            one = _rubber(name, settings.rubbers[name], card, settings.card)
            varied = name in factors
            root = one.root if varied else one.root * values[name]
            found.append(replace(one, root=root, relative=varied))
        else:
            missing[name] = f"no entry in uncertainty.rubbers for {name}"
    return Inputs(tuple(found), missing)


def ply_inputs(
    ply: PlyCard, choice: CardUncertainty
) -> tuple[list[UncertainInput], dict[str, str]]:
    """Group the measured constants by the specimens that they share; name the others.

    Constants of the same specimens vary together, by the card's covariance; a constant that is
    assumed equal to a measured one varies with it.

    Returns
    -------
    inputs : list of UncertainInput
    not_assessed : dict of str to str
        Assumed constants, and measured ones without a standard error, with the reason.
    """
    covariance = ply.covariance
    names = list(covariance.names) if covariance is not None else []
    matrix = np.array(covariance.matrix if covariance is not None else []).reshape(
        len(names), len(names)
    )
    counts = np.array([len(ply.constants[name].specimens) for name in names], dtype=float)
    if choice == "scatter":
        matrix = matrix * np.sqrt(np.outer(counts, counts))
    inputs = []
    for group in _sharing(names, {name: set(ply.constants[name].specimens) for name in names}):
        places = [names.index(name) for name in group]
        root = _root(matrix[np.ix_(places, places)])
        followers = [
            (name, group.index(str(quantity.equal_to)))
            for name, quantity in ply.constants.items()
            if quantity.equal_to in group
        ]
        specimens = ply.constants[group[0]].specimens
        inputs.append(
            UncertainInput(
                name=", ".join(group),
                kind=SourceKind.TEST,
                source=f"ply {ply.name}: {_listed(specimens)}",
                quantities=(*group, *(name for name, _ in followers)),
                root=np.vstack([root, *(root[[place]] for _, place in followers)]),
            )
        )
    known = {name for one in inputs for name in one.quantities}
    missing = {
        name: f"{quantity.rule}: no test states how uncertain it is"
        for name, quantity in ply.constants.items()
        if name not in known
    }
    return inputs, missing


def _tolerances(
    tolerances: Mapping[str, Tolerance], values: Mapping[str, float]
) -> Iterable[UncertainInput]:
    for name, tolerance in tolerances.items():
        if name not in values:
            continue
        shape: Literal["normal", "uniform"] = "normal" if tolerance.sd else "uniform"
        yield UncertainInput(
            name=name,
            kind=SourceKind.TOLERANCE,
            source="uncertainty.tolerances of the configuration",
            quantities=(name,),
            root=np.array([[tolerance.sd or tolerance.plus_minus or 0.0]]),
            shape=shape,
        )


def _rubber(
    name: str,
    given: RubberUncertainty,
    card: MaterialCard,
    choice: CardUncertainty,
) -> UncertainInput:
    """Return the input with its root as a share of C10."""
    if given.sd_percent is not None:
        return UncertainInput(
            name=name,
            kind=SourceKind.STATED,
            source=f"stated, not tested: {given.sd_percent:g} %",
            quantities=(name,),
            root=np.array([[given.sd_percent / 100]]),
        )
    rubber = card.rubbers.get(given.rubber or "")
    if rubber is None:
        raise InputError(
            "this rubber has no material card",
            column=f"uncertainty.rubbers.{name}.rubber",
            value=given.rubber,
            remedy=f"name one of {', '.join(card.rubbers) or 'none'}, or state sd_percent",
        )
    relative = _relative(rubber, choice)
    specimens = rubber.constants["c10_mpa"].specimens
    own = rubber.constants["c10_mpa"].value
    return UncertainInput(
        name=name,
        kind=SourceKind.TEST,
        source=f"{rubber.name} ({own:.4g} MPa): {_listed(specimens)}",
        quantities=(name,),
        root=np.array([[relative]]),
    )


def _relative(rubber: RubberCard, choice: CardUncertainty) -> float:
    quantity = rubber.constants.get("c10_mpa")
    if quantity is None or quantity.standard_error is None:
        raise InputError(
            "the card of this rubber has no standard error of C10",
            column="uncertainty.rubbers",
            value=rubber.name,
            remedy="test at least two specimens, or state sd_percent",
        )
    match choice:
        case "standard_error":
            factor = 1.0
        case "scatter":
            factor = float(np.sqrt(len(quantity.specimens)))
        case _:
            assert_never(choice)
    return factor * quantity.standard_error / quantity.value


def _sharing(names: Sequence[str], specimens: Mapping[str, set[str]]) -> list[list[str]]:
    """Group names that share specimens, directly or through others."""
    groups: list[list[str]] = []
    for name in names:
        joined = [group for group in groups if any(specimens[name] & specimens[o] for o in group)]
        for group in joined:
            groups.remove(group)
        groups.append([*(other for group in joined for other in group), name])
    return groups


def _root(covariance: Array) -> Array:
    """Return a matrix R with R Rᵀ = covariance, which may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    root: Array = vectors * np.sqrt(np.clip(values, 0.0, None))
    return root


def _listed(specimens: Sequence[str]) -> str:
    return f"specimens {', '.join(specimens)}"
