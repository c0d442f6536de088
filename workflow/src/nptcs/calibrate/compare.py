"""Tables next to the card: other models on the same points, and C10 against the range."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import pandas as pd
import pandera.pandas as pa

from nptcs.calibrate.drucker import instabilities
from nptcs.calibrate.fit import HyperelasticModel, fit_model
from nptcs.calibrate.invariants import NEO_HOOKEAN
from nptcs.calibrate.models import model_named
from nptcs.calibrate.observations import (
    STRAIN_ENDS,
    Observation,
    observations,
    observe,
    specimens_in_fit,
)
from nptcs.calibrate.rubber import constant_unit
from nptcs.config.materials.calibration import CalibrationSettings, RubberSettings
from nptcs.errors import InputError
from nptcs.reduce.strain_origin import StrainOrigin
from nptcs.tables.laboratory.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.laboratory.specimens import Specimen

NAN = float("nan")
# a constant smaller than its standard error cannot be told from zero, nor its sign be known
UNCERTAIN = "standard error larger than the value: "


def compare_models(
    name: str,
    curves: Mapping[str, pd.DataFrame],
    specimens: Sequence[Specimen],
    settings: CalibrationSettings,
    origins: Mapping[str, StrainOrigin] | None = None,
) -> pd.DataFrame:
    """Fit each model of the settings to the same points of a rubber.

    Parameters
    ----------
    name, curves, specimens, settings, origins
        As for `nptcs.calibrate.rubber.calibrate_rubber`. ``comparison_range`` sets the strain
        range; without it, the range is the card's.

    Returns
    -------
    DataFrame
        `nptcs.tables.laboratory.hyperelastic.ModelComparison`.
    """
    rubber = settings.rubber
    low, high = rubber.comparison_range or rubber.strain_range
    data, remarks = observations(name, curves, specimens, rubber, (low, high), origins)
    rows = []
    for model_name in rubber.compare:
        model = model_named(model_name, rubber.ogden_terms)
        in_card = model_name == rubber.model and (low, high) == rubber.strain_range
        common = {
            "rubber": name,
            "model": model.name,
            "in_card": in_card,
            "strain_low": low,
            "strain_high": high,
            "weights": rubber.weights,
            "specimens": ", ".join(o.specimen for o in data),
        }
        rows += [{**common, **row} for row in _model_rows(model, data, high, rubber, remarks)]
    return ModelComparison.validate(_ordered(rows, ModelComparison))


def _model_rows(
    model: HyperelasticModel,
    data: Sequence[Observation],
    high: float,
    settings: RubberSettings,
    remarks: Sequence[str],
) -> list[dict[str, object]]:
    try:
        fit = fit_model(model, data, settings.relative_error_floor)
    except InputError as error:
        return [_not_determined(model, constant, str(error)) for constant in model.constants]
    unstable = instabilities(model, fit.constants, high)
    constants = list(zip(model.constants, fit.constants, fit.standard_errors, strict=True))
    uncertain = [constant for constant, value, error in constants if error > abs(value)]
    words = [
        *model.remarks(fit.constants),
        *([UNCERTAIN + ", ".join(uncertain)] if uncertain else []),
        *(f"not stable: {text}" for text in unstable),
        *remarks,
    ]
    return [
        {
            "constant": constant,
            "value": value,
            "unit": constant_unit(constant),
            "standard_error": error,
            "points": fit.points,
            "rmse_mpa": fit.rmse_mpa,
            "largest_error_percent": fit.largest_error_percent,
            "r_squared": fit.r_squared,
            "initial_shear_modulus_mpa": model.initial_shear_modulus(fit.constants),
            "drucker_stable": not unstable,
            "standard_error_rule": fit.covariance_rule,
            "remarks": "; ".join(words),
        }
        for constant, value, error in constants
    ]


def _not_determined(model: HyperelasticModel, constant: str, reason: str) -> dict[str, object]:
    empty = ("value", "standard_error", "rmse_mpa", "largest_error_percent", "r_squared")
    return {
        **dict.fromkeys((*empty, "initial_shear_modulus_mpa"), NAN),
        "constant": constant,
        "unit": constant_unit(constant),
        "points": 0,
        "drucker_stable": pd.NA,
        "standard_error_rule": "",
        "remarks": f"not fitted: {reason}",
    }


def c10_against_range(
    name: str,
    curves: Mapping[str, pd.DataFrame],
    specimens: Sequence[Specimen],
    settings: CalibrationSettings,
    origins: Mapping[str, StrainOrigin] | None = None,
) -> pd.DataFrame:
    """Neo-Hookean C10 for a sequence of strain ranges, of each specimen and of all together.

    Parameters
    ----------
    name, curves, specimens, settings, origins
        As for `nptcs.calibrate.rubber.calibrate_rubber`; ``range_highs`` are the upper ends,
        the card's own is added.

    Returns
    -------
    DataFrame
        `nptcs.tables.laboratory.hyperelastic.RangeTable`.
    """
    rubber = settings.rubber
    low, own = rubber.strain_range
    chosen = specimens_in_fit(name, specimens, rubber.only_specimen)
    rows = []
    for high in sorted({own, *(h for h in rubber.range_highs if h > low)}):
        common = {
            "rubber": name,
            "strain_low": low,
            "strain_high": high,
            "in_card": high == own,
        }
        rows += [
            {**common, **row}
            for row in _range_rows(curves, chosen, rubber, (low, high), origins or {})
        ]
    return RangeTable.validate(_ordered(rows, RangeTable))


def _range_rows(
    curves: Mapping[str, pd.DataFrame],
    specimens: Sequence[Specimen],
    settings: RubberSettings,
    strain_range: tuple[float, float],
    origins: Mapping[str, StrainOrigin],
) -> list[dict[str, object]]:
    """Rows of one range: one row per specimen, and one for those that reach its end."""
    rows, together = [], []
    for specimen in (s for s in specimens if s.specimen in curves):
        try:
            observation, remarks = observe(
                specimen, curves[specimen.specimen], settings, strain_range
            )
        except InputError as error:
            rows.append(_empty_range_row(specimen.specimen, error.message))
            continue
        observation = replace(observation, origin=origins.get(specimen.specimen, StrainOrigin()))
        if any(STRAIN_ENDS in text for text in remarks):
            rows.append(_empty_range_row(specimen.specimen, "; ".join(remarks)))
            continue
        together.append(observation)
        row = _range_row(specimen.specimen, [observation], settings)
        rows.append(row | {"remarks": "; ".join(remarks)})
    if not together:
        return [*rows, _empty_range_row("all", "no specimen covers this range")]
    return [*rows, _range_row("all", together, settings)]


def _range_row(
    label: str, data: Sequence[Observation], settings: RubberSettings
) -> dict[str, object]:
    fit = fit_model(NEO_HOOKEAN, data, settings.relative_error_floor)
    return {
        "specimen": label,
        "c10_mpa": fit.constants[0],
        "standard_error_mpa": fit.standard_errors[0],
        "points": fit.points,
        "rmse_mpa": fit.rmse_mpa,
        "largest_error_percent": fit.largest_error_percent,
        "remarks": f"{len(data)} specimens; {fit.covariance_rule}" if label == "all" else "",
    }


def _empty_range_row(label: str, reason: str) -> dict[str, object]:
    empty = ("c10_mpa", "standard_error_mpa", "rmse_mpa", "largest_error_percent")
    return {**dict.fromkeys(empty, NAN), "specimen": label, "points": 0, "remarks": reason}


def _ordered(rows: Sequence[Mapping[str, object]], table: type[pa.DataFrameModel]) -> pd.DataFrame:
    return pd.DataFrame(rows)[list(table.to_schema().columns)]
