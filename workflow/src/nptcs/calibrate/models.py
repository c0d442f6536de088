"""The hyperelastic models by name."""

from __future__ import annotations

from nptcs.calibrate.fit import Model
from nptcs.calibrate.invariants import MOONEY_RIVLIN, NEO_HOOKEAN, YEOH
from nptcs.calibrate.ogden import ogden
from nptcs.config.calibration import ModelName


def model_named(name: ModelName, ogden_terms: int) -> Model:
    """Return a hyperelastic model; `ogden_terms` is the number of terms of Ogden's.

    Examples
    --------
    >>> model_named("yeoh", ogden_terms=2).constants
    ('c10_mpa', 'c20_mpa', 'c30_mpa')
    """
    if name == "ogden":
        return ogden(ogden_terms)
    models: dict[str, Model] = {m.name: m for m in (NEO_HOOKEAN, MOONEY_RIVLIN, YEOH)}
    return models[name]
