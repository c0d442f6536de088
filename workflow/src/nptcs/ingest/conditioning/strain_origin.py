"""Preload and toe: put the origin of strain where the curve, extended, meets zero force."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from nptcs.arrays import Array, Rows
from nptcs.config.materials.ingest import OriginOfStrain
from nptcs.ingest.conditioning.signals import Signals, line_slope
from nptcs.ingest.conditioning.steps import STRAINS

_ITERATIONS = 20
_CONVERGED = 1e-7
_FEWEST_FOR_CUBIC = 12
LARGE_SHIFT = {False: 0.001, True: 0.05}
"""Shift (of a rubber: True) beyond which the correction itself is worth a look."""


@dataclass(frozen=True)
class StrainOriginFit:
    """Parabola strain = c0 + c1·σ + c2·σ² over the window; c0 is the shift."""

    coefficients: Array
    standard_error: float
    scatter: float
    r_squared: float
    rows: Rows
    slack: float = 0.0
    model_error: float = 0.0

    @property
    def error(self) -> float:
        """Scatter and model together."""
        return float(np.hypot(self.standard_error, self.model_error))


def correct_origin(signals: Signals, settings: OriginOfStrain, rubber: bool) -> None:
    """Shift each strain to its own origin and cut the toe.

    The toe compensation of ASTM D638 annex A1 extends the straight part to zero stress. Here
    the part above the toe is a parabola, strain = c0 + c1·σ + c2·σ² (least squares), which is
    the line where the material is linear and does not bias it where it is not (±45° and
    rubber). All strains are shifted by their c0. So a preload counts as a true force whose strain
    was lost when the strain was set to zero.

    A shift that is not clear of its error (`OriginOfStrain.significance`) is not applied: it
    would add the scatter of the readings to every value. Its error is kept in the record.

    Parameters
    ----------
    signals : Signals
        With ``stress`` (MPa) and the strains; is changed.
    settings : OriginOfStrain
        Window, fewest points, poorest fit.
    rubber : bool
        Whether to use the window for rubber.
    """
    if not settings.enabled:
        signals.skipped("strain origin")
        return
    window = settings.window_rubber if rubber else settings.window
    stress, strain = signals.values["stress"], signals.values["strain_axial"]
    sign = np.sign(stress[int(np.argmax(np.abs(stress)))])
    fit, why = _fit(sign * strain, sign * stress, window, settings.smallest_points, rubber)
    if fit is None or fit.r_squared < settings.worst_r_squared:
        why = why if fit is None else f"R² {fit.r_squared:.4f} is below the limit"
        signals.note("strain origin", f"not corrected: {why}")
        signals.flags.append(f"preload and toe not corrected: {why}")
        return
    errors = {"standard_error": fit.standard_error, "model_error": fit.model_error}
    found = float(fit.coefficients[0])
    if not fit.slack and abs(found) <= settings.significance * fit.error:
        signals.note(
            "strain origin",
            f"nothing shifted: {-sign * found:+.2e} ± {fit.error:.1e} is not significant",
            **errors,
            found=-sign * found,
            r_squared=fit.r_squared,
            points=len(fit.rows),
        )
        return
    shifts = _shift(signals, fit, sign)
    toe = _toe_end(sign * strain, sign * stress, fit)
    if fit.slack:
        signals.flags.append(f"slack or long toe: strain {fit.slack:.3g} before loading was cut")
    largest_shift = LARGE_SHIFT[rubber]
    if not fit.slack and abs(shifts["strain_axial"]) > largest_shift:
        by = f"{-sign * shifts['strain_axial']:+.2g}"
        signals.flags.append(f"strain origin shifted by {by}: look at the start of the curve")
    signals.take(np.arange(toe, len(signals)))
    signals.note(
        "strain origin",
        f"strain shifted by {-sign * shifts['strain_axial']:+.3e} ± {fit.error:.1e}, "
        f"{toe} toe rows cut",
        **errors,
        r_squared=fit.r_squared,
        points=len(fit.rows),
        toe_rows=toe,
        **{f"shift_{name}": -sign * shift for name, shift in shifts.items()},
    )


def _fit(
    strain: Array, stress: Array, window: tuple[float, float], fewest: int, rubber: bool
) -> tuple[StrainOriginFit | None, str]:
    """Fit, with the window counted from the origin that the fit itself finds."""
    measured = np.flatnonzero(~np.isnan(strain[: int(np.argmax(stress)) + 1]))
    if len(measured) < fewest:
        return None, f"{len(measured)} readings with strain before the largest force"
    begin, slack = _loading_begins(strain[measured], stress[measured], window[0], rubber)
    measured = measured[begin:]
    if len(measured) < fewest:
        return None, f"{len(measured)} readings after the slack is taken up"
    start = float(np.median(strain[measured[:3]]))
    low, high = window
    ultimate = float(strain[measured].max()) - start
    if ultimate < 2 * high:
        low, high = 0.1 * ultimate, 0.5 * ultimate
    origin, fit = start, None
    for _ in range(_ITERATIONS):
        rows = _rows_in_window(strain, measured, origin + low, origin + high)
        if len(rows) < fewest:
            # a slow record: as many readings as needed, up to half of the ultimate strain
            widest = _rows_in_window(strain, measured, origin + low, origin + 0.5 * ultimate)
            rows = widest[:fewest]
        if len(rows) < fewest:
            return None, f"{len(rows)} readings between strain {low:.2g} and {0.5 * ultimate:.2g}"
        fit = _parabola(strain, stress, rows)
        moved, origin = abs(fit.coefficients[0] - origin), float(fit.coefficients[0])
        if moved < _CONVERGED:
            break
    assert fit is not None
    return replace(fit, slack=slack, model_error=_model_error(strain, stress, fit)), ""


def _model_error(strain: Array, stress: Array, fit: StrainOriginFit) -> float:
    """How far the origin of a cubic lies from the parabola's, where noise does not explain it.

    The estimates are nested: the variance of their difference is that of their variances.
    """
    if len(fit.rows) < _FEWEST_FOR_CUBIC:
        return 0.0
    cubic = _polynomial(strain, stress, fit.rows, 3)
    apart = float(abs(cubic.coefficients[0] - fit.coefficients[0]))
    noise = max(cubic.standard_error**2 - fit.standard_error**2, 0.0) ** 0.5
    return apart if apart > 3 * noise else 0.0


def _loading_begins(
    strain: Array, stress: Array, smallest: float, rubber: bool
) -> tuple[int, float]:
    """Find the first reading of the straight part, after slack and a long toe.

    The slope between 20 and 50 % of the rise is what the straight part should have. Slack is
    strain that is passed below 2 % of the rise, beyond what that slope explains. A laminate's
    toe ends where the slope over 5 % of the rise first reaches 90 % of it; a rubber's own curve
    may steepen as much, so only its slack is found.

    Returns
    -------
    begin : int
        0 if slack and toe are shorter than `smallest` (a strain).
    slack : float
        Strain of slack and toe, beyond what the slope explains.
    """
    rise = np.maximum.accumulate(stress) - np.median(stress[:3])
    top = float(rise[-1])
    middle = (rise >= 0.2 * top) & (rise <= 0.5 * top)
    if middle.sum() < 3 or not np.ptp(strain[middle]):
        return 0, 0.0
    slope = line_slope(strain[middle], stress[middle])
    if slope <= 0:
        return 0, 0.0
    begin = int(np.searchsorted(rise, 0.02 * top))
    if not rubber:
        begin = _toe_passed(strain, rise, begin, slope, 0.05 * top)
    slack = float(strain[begin] - np.median(strain[:3]) - rise[begin] / slope)
    return (begin, slack) if slack > smallest else (0, 0.0)


def _toe_passed(strain: Array, rise: Array, begin: int, slope: float, step: float) -> int:
    """First reading from which the secant over `step` has 90 % of the slope."""
    half = int(np.searchsorted(rise, 0.5 * rise[-1]))
    for row in range(begin, half):
        ahead = int(np.searchsorted(rise, rise[row] + step))
        gain = strain[ahead] - strain[row]
        if ahead - row >= 2 and gain > 0 and (rise[ahead] - rise[row]) / gain >= 0.9 * slope:
            return row
    return begin


def _rows_in_window(strain: Array, measured: Rows, low: float, high: float) -> Rows:
    """Find the readings of the first passage through the window."""
    beyond = strain[measured] > high
    first_pass = measured[: int(np.argmax(beyond))] if beyond.any() else measured
    return first_pass[strain[first_pass] >= low]


def _parabola(strain: Array, stress: Array, rows: Rows) -> StrainOriginFit:
    return _polynomial(strain, stress, rows, 2)


def _polynomial(strain: Array, stress: Array, rows: Rows, degree: int) -> StrainOriginFit:
    scale = float(np.abs(stress[rows]).max()) or 1.0
    design = np.vander(stress[rows] / scale, degree + 1, increasing=True)
    scaled, *_ = np.linalg.lstsq(design, strain[rows])
    residuals = strain[rows] - design @ scaled
    variance = float(residuals @ residuals) / max(len(rows) - degree - 1, 1)
    error = float(np.sqrt(variance * np.linalg.pinv(design.T @ design)[0, 0]))
    total = float(((strain[rows] - strain[rows].mean()) ** 2).sum())
    r_squared = 1 - float(residuals @ residuals) / total if total else 0.0
    coefficients = scaled / scale ** np.arange(degree + 1)
    return StrainOriginFit(coefficients, error, variance**0.5, r_squared, rows)


def _shift(signals: Signals, fit: StrainOriginFit, sign: float) -> dict[str, float]:
    """Subtract each strain's own c0 over the same readings."""
    shifts = {}
    stress = sign * signals.values["stress"]
    for name in STRAINS:
        readings = sign * signals.values[name]
        rows = fit.rows[~np.isnan(readings[fit.rows])]
        if len(rows) < 4:
            continue
        shifts[name] = float(_parabola(readings, stress, rows).coefficients[0])
        signals.values[name] = sign * (readings - shifts[name])
    return shifts


def _toe_end(strain: Array, stress: Array, fit: StrainOriginFit) -> int:
    """First row after the last one below the window that is off the parabola."""
    before = np.arange(int(fit.rows[0]))
    predicted = np.polynomial.polynomial.polyval(stress[before], fit.coefficients)
    off = np.abs(strain[before] - predicted) > 4 * fit.scatter
    return int(np.flatnonzero(off)[-1]) + 1 if off.any() else 0
