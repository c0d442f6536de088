"""The rubber card: hyperelastic constants within a strain range."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from nptcs.calibrate.drucker import instabilities
from nptcs.calibrate.fit import HyperelasticModel, ModelFit, fit_model
from nptcs.calibrate.models import model_named
from nptcs.calibrate.observations import Observation, observations
from nptcs.calibrate.toe import toe_bias
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.reduce.deviations import CROSSHEAD
from nptcs.reduce.strain_origin import StrainOrigin
from nptcs.tables.laboratory.material_card import CardConstant, Covariance, RubberCard
from nptcs.tables.laboratory.specimens import Specimen


def calibrate_rubber(
    name: str,
    curves: Mapping[str, pd.DataFrame],
    specimens: Sequence[Specimen],
    settings: CalibrationSettings,
    strain_sources: Mapping[str, str] | None = None,
    origins: Mapping[str, StrainOrigin] | None = None,
) -> RubberCard:
    """Fit the card's model to the included specimens of a rubber.

    Parameters
    ----------
    name : str
        Material in the sheet, e.g. rubber_75A.
    curves : mapping of str to DataFrame
        Tidy curves by specimen id (strain_axial nominal, stress_mpa nominal).
    specimens : sequence of Specimen
        The sheet; specimens with include = no do not enter.
    settings : CalibrationSettings
        Model, strain range and weights; neo-Hookean within 15 % by default, as in the study.
    strain_sources : mapping of str to str, optional
        Where each specimen's strain came from, as the ingest records say; the card says which
        specimens have crosshead strain.
    origins : mapping of str to StrainOrigin, optional
        Strain origins as the ingest found them: their errors enter those of the constants, and
        the card says what their correction did.

    Returns
    -------
    RubberCard
        Constants with standard errors and covariance, quality of the fit, and remarks.

    Raises
    ------
    InputError
        If there is no curve, too few points in the range, or the data cannot tell the
        constants apart.
    """
    rubber = settings.rubber
    model = model_named(rubber.model, rubber.ogden_terms)
    data, remarks = observations(name, curves, specimens, rubber, rubber.strain_range, origins)
    fit = fit_model(model, data, rubber.relative_error_floor)
    unstable = instabilities(model, fit.constants, rubber.strain_range[1])
    used = tuple(o.specimen for o in data)
    synthetic = {s.specimen for s in specimens if s.origin == "synthetic"}
    sources = strain_sources or {}
    crosshead = [
        f"warning: {name}: {CROSSHEAD}" for name in used if sources.get(name) == "crosshead"
    ]
    low, high = rubber.strain_range
    rule = (
        f"{model.name}, least squares on nominal stress, strain {low:g} to {high:g}, "
        f"weights: {rubber.weights}, {fit.points} points of {len(used)} specimens; "
        f"standard error: {fit.covariance_rule}"
    )
    return RubberCard(
        name=name,
        synthetic=not synthetic.isdisjoint(used),
        model=model.name,
        constants=_quantities(model.constants, fit, rule, used),
        covariance=_covariance(model.constants, fit, used),
        strain_range=rubber.strain_range,
        fit_quality={
            "rmse_mpa": fit.rmse_mpa,
            "largest_error_percent": fit.largest_error_percent,
            "r_squared": fit.r_squared,
            "drucker_stable": float(not unstable),
            "initial_shear_modulus_mpa": model.initial_shear_modulus(fit.constants),
        },
        checks=(
            *model.remarks(fit.constants),
            *_stability_words(unstable, high),
            *toe_bias(data),
            *_origin_words(model, data, fit),
            *crosshead,
            *remarks,
        ),
    )


def _origin_words(
    model: HyperelasticModel, data: Sequence[Observation], fit: ModelFit
) -> list[str]:
    """Say what the correction of the strain origin did to the first constant."""
    shifted = [o for o in data if o.origin.axial]
    if not shifted:
        return []
    raw = model.solve([o.moved(-o.origin.axial) for o in data], start=fit.constants)
    largest = max(shifted, key=lambda o: abs(o.origin.axial)).origin
    return [
        f"strain origin: corrected in {len(shifted)} of {len(data)} specimens, by up to "
        f"{100 * largest.axial:+.3g} % ± {100 * largest.error:.2g} %; without it "
        f"{model.constants[0]} would be {raw[0]:.4g}, not {fit.constants[0]:.4g}"
    ]


def constant_unit(constant: str) -> str:
    """Return the unit of a constant, from its name."""
    return "MPa" if constant.endswith("_mpa") else "1"


def _quantities(
    names: Sequence[str], fit: ModelFit, rule: str, used: tuple[str, ...]
) -> dict[str, CardConstant]:
    return {
        name: CardConstant(
            value=float(value),
            unit=constant_unit(name),
            standard_error=float(error) if np.isfinite(error) else None,
            origin="measured",
            rule=rule,
            specimens=used,
        )
        for name, value, error in zip(names, fit.constants, fit.standard_errors, strict=True)
    }


def _covariance(names: Sequence[str], fit: ModelFit, used: tuple[str, ...]) -> Covariance | None:
    if not np.isfinite(fit.covariance).all():
        return None
    return Covariance(
        names=tuple(names),
        units=tuple(constant_unit(name) for name in names),
        rule=fit.covariance_rule,
        specimens=used,
        matrix=tuple(tuple(float(x) for x in row) for row in fit.covariance),
    )


def _stability_words(unstable: list[str], high: float) -> list[str]:
    if unstable:
        return ["warning: not stable in Drucker's sense: " + "; ".join(unstable)]
    return [f"stable in Drucker's sense in all modes up to strain {high:g}"]
