"""Tension positive, compression negative: signs turned only where file, test and physics agree."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from nptcs.config.materials.ingest import Signs
from nptcs.errors import InputError
from nptcs.ingest.conditioning.signals import Signals, largest
from nptcs.ingest.conditioning.strains import slope_over_force
from nptcs.tables.laboratory.specimens import Specimen

BOTH = ("strain_axial", "strain_axial_back")


def orient(
    signals: Signals, specimen: Specimen, path: Path, settings: Signs, source: str = ""
) -> None:
    """Make tension positive and compression negative, and keep the loading of the test's sign.

    A gauge on the specimen shows whether it becomes longer or shorter; the sign of a crosshead's
    travel shows nothing. So in a tension test a negative force is turned only if a gauge
    lengthens under it. In a compression test a machine may call compression positive, and both
    are turned. A record that passes from compression to tension is split, and the part of the
    other sign is left out and named.

    Parameters
    ----------
    signals : Signals
        With ``force`` and the axial strains; is changed.
    specimen : Specimen
        Its test.
    path : Path
        For messages.
    settings : Signs
        Share from which a part of the other sign counts.
    source : str
        Strain source; ``crosshead`` has no sign of its own.

    Raises
    ------
    InputError
        If the signs contradict the test.
    """
    wanted = float(specimen.test.load_sign)
    if specimen.test.is_bending or wanted < 0:
        turned = _turn_pressing(signals, wanted, settings)
    else:
        turned = _turn_tension(signals, specimen, path, settings, source)
    signals.note("sign", f"turned: {', '.join(turned)}" if turned else "as recorded")
    _keep_one_sign(signals, wanted, settings)


def _parts(signals: Signals) -> tuple[float, float]:
    """Largest force to the positive and to the negative side, both as magnitudes."""
    force = signals.values["force"]
    return max(float(np.nanmax(force)), 0.0), max(-float(np.nanmin(force)), 0.0)


def _turn(signals: Signals, names: tuple[str, ...]) -> None:
    for name in names:
        signals.values[name] = -signals.values[name]


def _turn_tension(
    signals: Signals, specimen: Specimen, path: Path, settings: Signs, source: str
) -> list[str]:
    tensile, compressive = _parts(signals)
    slope = slope_over_force(signals, "strain_axial")
    mainly_negative = tensile < settings.clear_share * compressive
    if mainly_negative and (slope >= 0 or source == "crosshead"):
        raise InputError(
            f"force is negative (down to {-compressive:.5g} N): a {specimen.test} test that the "
            "file records as compression",
            "correct test in the sheet; if the machine writes tension as negative, state "
            "force_factor -1 in the sheet",
            path,
            specimen=specimen.specimen,
        )
    if mainly_negative:
        _turn(signals, ("force",))
        signals.flags.append(
            "force is recorded as negative while the gauge lengthens: its sign was turned"
        )
        return ["force"]
    if slope >= 0:
        return []
    if source == "crosshead":
        _turn(signals, BOTH)
        signals.flags.append("travel falls while the force grows: its sign was turned")
        return ["axial strain"]
    raise InputError(
        f"axial strain falls while a {specimen.test} test loads",
        "check test, strain_axis and the files of this specimen in the sheet; if the gauge writes "
        "a lengthening as negative, state strain_factor -1",
        path,
        specimen=specimen.specimen,
        value=f"{1e6 * slope:.3g} µε/N",
    )


def _turn_pressing(signals: Signals, wanted: float, settings: Signs) -> list[str]:
    """Turn what a machine writes with the other sign in a compression or bending test.

    Recorded signs count if both sides are large.
    """
    positive, negative = _parts(signals)
    clear = min(positive, negative) < settings.clear_share * max(positive, negative)
    force = np.sign(largest(signals.values["force"])) if clear else wanted
    strain = force * np.sign(slope_over_force(signals, "strain_axial"))
    turned = []
    if force * wanted < 0:
        _turn(signals, ("force",))
        turned.append("force")
    if strain * wanted < 0:
        _turn(signals, BOTH)
        turned.append("axial strain")
    return turned


def _keep_one_sign(signals: Signals, wanted: float, settings: Signs) -> None:
    """Leave out the readings of the other sign if they are more than a disturbance."""
    force = wanted * signals.values["force"]
    other = max(-float(np.nanmin(force)), 0.0)
    if other <= settings.smallest_share * float(np.nanmax(force)):
        return
    strain = wanted * signals.values["strain_axial"]
    kept = ~(force < 0)
    lowest = float(np.nanmin(strain[~kept])) if np.isfinite(strain[~kept]).any() else np.nan
    name = "compression" if wanted > 0 else "tension"
    signals.take(kept)
    signals.note(
        "loading of one sign",
        f"{int((~kept).sum())} readings in {name} left out",
        rows=int((~kept).sum()),
        largest_force_n=-wanted * other,
        strain=wanted * lowest,
    )
    signals.flags.append(
        f"recorded in {name}, too (to {-wanted * other:.5g} N, strain {wanted * lowest:.4g}); "
        "that part was left out"
    )
