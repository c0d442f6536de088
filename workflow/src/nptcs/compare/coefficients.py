"""Published coefficients of a response surface by the powers of their terms (tables 6 and 8)."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from nptcs.terms import parse


def by_powers(published: pd.DataFrame, factors: Sequence[str]) -> dict[tuple[int, ...], float]:
    """Map the powers of each published term (`PublishedCoefficients`) to its coefficient."""
    powers = parse(list(published["term"]), factors).exponents
    return dict(zip(powers, published["coefficient"], strict=True))
