"""The strain origin that the ingest found: what its correction did, and how sure it is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import pandas as pd

from nptcs.reduce.curve.branch import Branch
from nptcs.reduce.rows import NAN, Property
from nptcs.tables.laboratory.curves import IngestRecord

STEP = "strain origin"


@dataclass(frozen=True)
class StrainOrigin:
    """Shift of the strains, and the standard error of the origin.

    Parameters
    ----------
    added : mapping of str to float
        What was added to each strain column of the curve; empty where nothing was.
    random_error : float
        From the scatter of the readings: independent for each specimen. A shift that was found
        but not applied because it is not significant counts as an error.
    model_error : float
        From the parabola that replaces the curve above the toe: in the same direction for all
        specimens.
    """

    added: Mapping[str, float] = field(default_factory=dict)
    random_error: float = 0.0
    model_error: float = 0.0

    @property
    def error(self) -> float:
        """Both errors together."""
        return float(np.hypot(self.random_error, self.model_error))

    @property
    def axial(self) -> float:
        """What was added to the axial strain."""
        return self.added.get("strain_axial", 0.0)


def strain_origin_of(record: IngestRecord) -> StrainOrigin | None:
    """Read the origin from an ingest record; None where none was found."""
    for step in record.steps:
        numbers = step.numbers
        if step.name == STEP and step.on and "standard_error" in numbers:
            added = {
                name.removeprefix("shift_"): value
                for name, value in numbers.items()
                if name.startswith("shift_")
            }
            left = 0.0 if added else numbers.get("found", 0.0)
            random = float(np.hypot(numbers["standard_error"], left))
            return StrainOrigin(added, random, numbers.get("model_error", 0.0))
    return None


def strain_origins_of(records: Iterable[IngestRecord]) -> dict[str, StrainOrigin]:
    """Origins by specimen id, of those that have one."""
    found = {record.specimen: strain_origin_of(record) for record in records}
    return {name: origin for name, origin in found.items() if origin is not None}


def with_origin(
    rows: Sequence[Property],
    origin: StrainOrigin,
    branch: Branch,
    sign: int,
    reduce: Callable[[Branch], Sequence[Property]],
) -> list[Property]:
    """Add to each property what the correction did to it and what the origin's error is worth.

    Parameters
    ----------
    rows : sequence of Property
        As reduced.
    origin : StrainOrigin
        Of this specimen's strain.
    branch : Branch
        What they were reduced from, load positive.
    sign : int
        That of the test's load, by which the branch was turned.
    reduce : callable
        The reduction, which is repeated with the strains shifted.

    Returns
    -------
    list of Property
        ``origin_effect_percent``: value over the value without the correction, minus one. The
        standard error of a slope or stress includes half the difference between the values with
        the origin moved one error to either side, added in quadrature.
    """
    back = {name: -sign * value for name, value in origin.added.items()}
    before = _values(reduce(_shifted(branch, back))) if back else {}
    aside = [
        _values(reduce(_shifted(branch, {"strain_axial": step * origin.error})))
        for step in (1.0, -1.0)
    ]
    found = []
    for row in rows:
        half = abs(aside[0].get(row.name, NAN) - aside[1].get(row.name, NAN)) / 2
        raw = before.get(row.name, NAN)
        effect = 100 * (row.value / raw - 1) if raw and np.isfinite(raw) else NAN
        row = replace(row, origin_effect_percent=effect)
        if _has_error(row.name) and np.isfinite(half) and np.isfinite(row.value):
            own = row.standard_error if np.isfinite(row.standard_error) else 0.0
            row = replace(row, standard_error=float(np.hypot(own, half)))
        found.append(row)
    return found


def _has_error(name: str) -> bool:
    return "modulus" in name or name.startswith(("poisson", "stress_at"))


def _values(rows: Sequence[Property]) -> dict[str, float]:
    return {row.name: row.value for row in rows}


def _shifted(branch: Branch, added: Mapping[str, float]) -> Branch:
    def shift(table: pd.DataFrame) -> pd.DataFrame:
        return table.assign(**{name: table[name] + value for name, value in added.items()})

    return replace(
        branch,
        rows=shift(branch.rows),
        to_peak=shift(branch.to_peak),
        turned=shift(branch.turned),
    )
