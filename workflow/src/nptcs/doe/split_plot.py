"""Split-plot designs: several cases on each value of the factors that are costly to change.

A spoke's energy table costs seconds, a ring on it milliseconds: each spoke (a whole plot) carries
rings with several rubbers of the band.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from nptcs.arrays import Array
from nptcs.doe.points import space_filling
from nptcs.errors import InputError

MOST_CORNERS = 64


def split_plot(
    hard: int, easy: int, whole_plots: int, cases_per_plot: int, corners: bool, seed: int
) -> Array:
    """Coded points of shape (whole_plots × cases_per_plot, hard + easy), hard factors first.

    Whole plots are the corners of the box, if `corners` is set, and an even Latin hypercube whose
    points are moved half-way to those of a cosine, which are denser near the faces: a surface is
    least sure there. A single easy factor takes the Chebyshev points of the second kind, both ends
    included, on every plot; several take a Latin hypercube, a different one on each plot. All
    plots' first cases come first, then their second ones: cases that are solved at the same time
    do not wait for the same spoke.

    Raises
    ------
    InputError
        If fewer than two whole plots remain besides the corners, or there are more than
        `MOST_CORNERS` of them.
    """
    plots = _whole_plots(hard, whole_plots, corners, seed)
    rows = [_on_plot(easy, cases_per_plot, seed + 1 + number) for number in range(len(plots))]
    return np.vstack(
        [
            np.hstack([plots, np.array([points[case] for points in rows])])
            for case in range(cases_per_plot)
        ]
    )


def _whole_plots(hard: int, whole_plots: int, corners: bool, seed: int) -> Array:
    ends = np.array(list(product([-1.0, 1.0], repeat=hard))) if corners else np.empty((0, hard))
    inner = whole_plots - len(ends)
    if inner < 2 or len(ends) > MOST_CORNERS:
        raise InputError(
            f"{hard} factors have {2**hard} corners",
            "ask for more whole plots, or for corners: false",
            column="design.whole_plots",
            value=whole_plots,
        )
    spread = space_filling("latin_hypercube", inner, hard, seed)
    return np.vstack([ends, 0.5 * (spread + np.sin(0.5 * np.pi * spread))])


def _on_plot(easy: int, cases: int, seed: int) -> Array:
    if easy == 1:
        return -np.cos(np.pi * np.arange(cases) / (cases - 1))[:, None]
    return space_filling("latin_hypercube", cases, easy, seed)
