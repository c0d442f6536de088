"""Draws of the constants of a card within their uncertainty, to propagate it to stiffness."""

from __future__ import annotations

import numpy as np
import pandas as pd

from nptcs.tables.laboratory.material_card import PlyCard, RubberCard


def sample_constants(card: PlyCard | RubberCard, draws: int, seed: int) -> pd.DataFrame:
    """Draw sets of constants from the normal distribution of the card's estimates.

    Measured constants follow the card's covariance (the uncertainty of the means, not the
    scatter of the material); constants assumed equal to another follow it; assumed numbers and
    constants without a standard error stay as they are.

    Parameters
    ----------
    card : PlyCard or RubberCard
        Card with ``covariance``.
    draws : int
        Number of sets.
    seed : int
        Seed of the generator: equal seeds give equal draws.

    Returns
    -------
    DataFrame
        `draws` rows, one column per constant in the order and the units of the card.

    Examples
    --------
    >>> from nptcs.tables.laboratory.material_card import CardConstant, Covariance, RubberCard
    >>> c10 = CardConstant(value=1.18, unit="MPa", standard_error=0.02, origin="measured", rule="")
    >>> scatter = Covariance(names=("c10_mpa",), units=("MPa",), rule="", matrix=((0.0004,),))
    >>> card = RubberCard(
    ...     name="rubber_75A",
    ...     synthetic=False,
    ...     constants={"c10_mpa": c10},
    ...     covariance=scatter,
    ...     strain_range=(0, 0.15),
    ...     fit_quality={},
    ... )
    >>> draws = sample_constants(card, draws=10_000, seed=1)["c10_mpa"]
    >>> round(float(draws.mean()), 2), round(float(draws.std()), 2)
    (1.18, 0.02)
    """
    table = {name: np.full(draws, quantity.value) for name, quantity in card.constants.items()}
    if card.covariance is not None:
        names = card.covariance.names
        mean = [card.constants[name].value for name in names]
        matrix = np.array(card.covariance.matrix)
        # drawn in standardised units: MPa and dimensionless constants differ by 1e6
        errors = np.sqrt(np.diag(matrix))
        scale = np.where(errors > 0, errors, 1.0)
        generator = np.random.default_rng(seed)
        standard = generator.multivariate_normal(
            np.zeros(len(names)), matrix / np.outer(scale, scale), size=draws, method="eigh"
        )
        table |= {name: mean[i] + standard[:, i] * errors[i] for i, name in enumerate(names)}
    for name, quantity in card.constants.items():
        if quantity.equal_to is not None:
            table[name] = table[quantity.equal_to]
    return pd.DataFrame(table)[list(card.constants)]
