"""How the factors of a study are written for a reader."""

from __future__ import annotations

from dataclasses import dataclass

from nptcs.config.studies.study import Study
from nptcs.language import tr
from nptcs.tables.result_table import Heading


@dataclass(frozen=True)
class FactorLabel:
    """Name and unit of a factor in figures."""

    label: str
    unit: str

    def __str__(self) -> str:
        return f"{self.label} [{self.unit}]"


SYMBOLS = {
    "spacing_mm": Heading("S", "mm"),
    "thickness_mm": Heading("T", "mm"),
    "angle_deg": Heading("A", "°"),
    "shear_band_c10_mpa": Heading("T-C", "MPa"),
    "spoke_c10_mpa": Heading("S-C", "MPa"),
}
"""The paper's symbols of the five design variables, for places without room for a label."""


def factor_labels(study: Study) -> dict[str, FactorLabel]:
    """Return how a study's factors are written, by the names of their columns."""
    return {
        factor.name: FactorLabel(tr(factor.label), "°" if factor.unit == "deg" else factor.unit)
        for factor in study.factors
    }
