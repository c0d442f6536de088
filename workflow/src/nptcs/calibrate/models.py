"""The hyperelastic models by name."""

from __future__ import annotations

from typing import assert_never

from nptcs.calibrate.fit import HyperelasticModel
from nptcs.calibrate.invariants import MOONEY_RIVLIN, NEO_HOOKEAN, YEOH
from nptcs.calibrate.ogden import ogden
from nptcs.config.materials.calibration import ModelName


def model_named(name: ModelName, ogden_terms: int) -> HyperelasticModel:
    """Return a hyperelastic model; `ogden_terms` is the number of terms of Ogden's model."""
    match name:
        case "neo_hookean":
            return NEO_HOOKEAN
        case "mooney_rivlin":
            return MOONEY_RIVLIN
        case "yeoh":
            return YEOH
        case "ogden":
            return ogden(ogden_terms)
        case _:
            assert_never(name)
