"""Whether a channel across the load measures a contraction, or is a second gauge along it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from nptcs.arrays import Array
from nptcs.ingest.conditioning.signals import Signals, line_slope
from nptcs.ingest.reading.profiles import normalise
from nptcs.tables.laboratory.specimens import Specimen

SMALLEST_RATIO = 0.05
"""Slope of one strain on the other below which its sign cannot be told from noise."""
OF_EQUAL_GAUGES = (0.5, 2.0)
"""Slope of one strain on the other where both are measured along the load."""
_SAYS_ACROSS = ("trans", "lat", "quer", "width", "y", "x", "поперечн", "poprzeczn", "横")


def settle_transverse(signals: Signals, specimen: Specimen, columns: Mapping[str, str]) -> None:
    """Keep a transverse strain only if it falls while the axial strain grows, or the reverse.

    A laminate contracts across the load. A channel that grows with the axial strain is a
    contraction written as positive (the sheet's ``transverse_factor`` -1 turns it), or another
    gauge along the load: one that is only numbered (``Strain 2``) and as large as the first is
    taken as the gauge on the other face. In both cases Poisson's ratio and the shear strain would
    be wrong.

    Parameters
    ----------
    signals : Signals
        With ``strain_axial``, ``strain_transverse`` and ``strain_axial_back``; is changed.
    specimen : Specimen
        With ``transverse_factor``.
    columns : mapping of str to str
        Quantity → column name.
    """
    values = signals.values
    factor = specimen.transverse_factor
    if factor != 1:
        values["strain_transverse"] = factor * values["strain_transverse"]
        signals.flags.append(f"transverse strain multiplied by {factor:g}, as the sheet states")
    ratio = _ratio(values["force"], values["strain_axial"], values["strain_transverse"])
    if ratio is None or ratio < SMALLEST_RATIO:
        return
    name = columns.get("strain_transverse", "across the load")
    low, high = OF_EQUAL_GAUGES
    empty = np.full(len(signals), np.nan)
    second = values["strain_transverse"]
    values["strain_transverse"] = empty
    numbered = not any(word in normalise(name) for word in _SAYS_ACROSS)
    if numbered and low <= ratio <= high and np.isnan(values["strain_axial_back"]).all():
        values["strain_axial_back"] = second
        signals.flags.append(
            f"column '{name}' grows with the axial strain ({ratio:.3g} times): taken as the gauge "
            "on the other face"
        )
        return
    signals.flags.append(
        f"column '{name}' was left out: it grows with the axial strain ({ratio:.3g} times), which "
        "no contraction does; if it is one written as positive, state transverse_factor -1 in "
        "the sheet"
    )


def _ratio(force: Array, axial: Array, transverse: Array) -> float | None:
    """Slope of the transverse on the axial strain; None if not measured.

    Taken up to half of the largest strain before the largest force: a gauge may come off later.
    """
    rows = np.arange(len(force)) <= int(np.nanargmax(np.abs(force)))
    rows &= np.isfinite(axial) & np.isfinite(transverse)
    rows &= np.abs(axial) <= 0.5 * np.abs(axial[rows]).max(initial=0.0)
    if rows.sum() < 3 or not np.ptp(axial[rows]):
        return None
    return line_slope(axial[rows], transverse[rows])
