"""How the factors of a study are written for a reader."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from nptcs.config.study import Study
from nptcs.language import tr
from nptcs.report.text import number_text


@dataclass(frozen=True)
class FactorLabel:
    """Name and unit of a factor in figures."""

    label: str
    unit: str

    def __str__(self) -> str:
        return f"{self.label} [{self.unit}]"


def factor_labels(study: Study) -> dict[str, FactorLabel]:
    """Return how a study's factors are written, by the names of their columns."""
    return {
        factor.name: FactorLabel(tr(factor.label), "°" if factor.unit == "deg" else factor.unit)
        for factor in study.factors
    }


def all_labels(studies: Iterable[Study]) -> dict[str, FactorLabel]:
    """Return how the factors of several studies are written; the first study's label counts."""
    found: dict[str, FactorLabel] = {}
    for study in studies:
        found = factor_labels(study) | found
    return found


def in_words(text: str, labels: Mapping[str, FactorLabel]) -> str:
    """Write a design such as ``spacing_mm 14.333, angle_deg 0`` with the names that people use.

    Examples
    --------
    >>> in_words("22 plates, spacing_mm 14.333", {"spacing_mm": FactorLabel("spacing S", "mm")})
    '22 plates, spacing S 14.33 mm'
    """
    text = re.sub(r"\b(\d+) plates\b", lambda found: tr("{plates} plates", plates=found[1]), text)
    for name, label in labels.items():
        value = re.compile(rf"\b{re.escape(name)} ([-+]?[\d.]+(?:e[-+]?\d+)?)")
        text = value.sub(lambda found, label=label: _with_value(label, found[1]), text)
        text = re.sub(rf"\b{re.escape(name)}\b", label.label, text)
    return text


def _with_value(label: FactorLabel, number: str) -> str:
    gap = "" if label.unit == "°" else "\u00a0"
    return f"{label.label}\u00a0{number_text(float(number), 4)}{gap}{label.unit}"
