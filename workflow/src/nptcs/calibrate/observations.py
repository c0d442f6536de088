"""The points that a hyperelastic fit sees: loading branches inside the strain range."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import assert_never

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.materials.calibration import RubberSettings
from nptcs.errors import InputError
from nptcs.mechanical_tests import HYPERELASTIC_FIT
from nptcs.reduce.curve.branch import loading_branch
from nptcs.reduce.rows import finite_pair
from nptcs.reduce.standards.rubber_compression import disc_barrels
from nptcs.reduce.strain_origin import StrainOrigin
from nptcs.tables.laboratory.specimens import Specimen

SMALLEST_NUMBER_OF_POINTS = 3
STRAIN_ENDS = "strain ends at"


@dataclass(frozen=True)
class Observation:
    """One specimen's points in the range, with the weight of each.

    Parameters
    ----------
    specimen, mode : str
        Id and test type.
    stretch, stress : ndarray, shape (n,)
        λ and nominal stress (MPa).
    weight : ndarray, shape (n,)
        Factor of each squared residual.
    origin : StrainOrigin
        What was added to the strain before the fit, and the error of the strain's origin.
    """

    specimen: str
    mode: str
    stretch: Array
    stress: Array
    weight: Array
    origin: StrainOrigin = StrainOrigin()

    def moved(self, strain: float) -> Observation:
        """Return the same points with a strain added, positive in tension."""
        return replace(self, stretch=self.stretch + strain)


def undetermined(model: str, constants: int, rank: int, data: Sequence[Observation]) -> InputError:
    """Error for data that cannot tell the constants of a model apart."""
    return InputError(
        f"{model}: {constants} constants, the data determine {rank}",
        "widen the strain range, add another mode of deformation, or use a simpler model",
        specimen=", ".join(o.specimen for o in data),
        column="strain_axial",
    )


def observations(
    name: str,
    curves: Mapping[str, pd.DataFrame],
    specimens: Sequence[Specimen],
    settings: RubberSettings,
    strain_range: tuple[float, float],
    origins: Mapping[str, StrainOrigin] | None = None,
) -> tuple[list[Observation], list[str]]:
    """Points of the included specimens of a rubber, and remarks on what is missing.

    Parameters
    ----------
    name : str
        Material in the sheet.
    curves : mapping of str to DataFrame
        Curves by specimen id.
    specimens : sequence of Specimen
        The sheet.
    settings : RubberSettings
        Weights, and whether one specimen alone is fitted.
    strain_range : (float, float)
        Nominal strain, from and to.
    origins : mapping of str to StrainOrigin, optional
        Strain origins by specimen id, as the ingest found them.

    Raises
    ------
    InputError
        If no specimen is left, or one has fewer than three points in the range.
    """
    chosen = specimens_in_fit(name, specimens, settings.only_specimen)
    remarks = [
        f"{s.specimen}: no curve, not in the fit" for s in chosen if s.specimen not in curves
    ]
    remarks += [*_platen_words(name, specimens), *_run_words(chosen)]
    found = []
    for specimen in chosen:
        if specimen.specimen in curves:
            observation, words = observe(
                specimen, curves[specimen.specimen], settings, strain_range
            )
            origin = (origins or {}).get(specimen.specimen, StrainOrigin())
            observation = replace(observation, origin=origin)
            found.append(observation)
            remarks += words
    if not found:
        raise InputError(
            f"material {name}: no curve to fit",
            "ingest at least one included rubber specimen of this material",
            column="material",
            value=name,
        )
    return found, remarks


def specimens_in_fit(name: str, specimens: Sequence[Specimen], only: str | None) -> list[Specimen]:
    """Specimens of a rubber that the sheet includes in the fit, or the one that is fitted alone.

    A disc between dry or bonded platens barrels: its curve is not that of a uniform stress, and
    it is left out.

    Raises
    ------
    InputError
        If the one specimen is not among them.
    """
    chosen = [s for s in specimens if s.material == name and s.test.is_rubber]
    chosen = [s for s in chosen if not disc_barrels(s.platens)]
    chosen = [s for s in chosen if s.gives(HYPERELASTIC_FIT)]
    if only is None:
        return chosen
    alone = [s for s in chosen if s.specimen == only]
    if not alone:
        raise InputError(
            f"material {name} has no included specimen of this name",
            "correct calibration.rubber.only_specimen or set it to null",
            column="calibration.rubber.only_specimen",
            value=only,
        )
    return alone


def _platen_words(name: str, specimens: Sequence[Specimen]) -> list[str]:
    """Say which discs are not in the fit, and which may carry friction."""
    included = [s for s in specimens if s.material == name and s.include and s.test.is_rubber]
    discs = [s for s in included if s.test.load_sign < 0]
    barrelled = [s.specimen for s in discs if disc_barrels(s.platens)]
    unknown = [s.specimen for s in discs if disc_barrels(s.platens) is None]
    words = []
    if barrelled:
        words.append(f"not in the fit, dry or bonded platens: {', '.join(barrelled)}")
    if unknown:
        words.append(f"warning: lubrication of the platens not stated: {', '.join(unknown)}")
    return words


def _run_words(chosen: Sequence[Specimen]) -> list[str]:
    """Say which pieces are in the fit with several runs, as if they were several specimens."""
    counts = Counter(s.tested_piece for s in chosen)
    return [
        f"warning: {count} runs of {piece} are in the fit and count as specimens; let the sheet "
        f"take {HYPERELASTIC_FIT} from one of them"
        for piece, count in counts.items()
        if count > 1
    ]


def observe(
    specimen: Specimen,
    curve: pd.DataFrame,
    settings: RubberSettings,
    strain_range: tuple[float, float],
) -> tuple[Observation, list[str]]:
    """Points of one specimen in the range, and a remark if its strain ends before it does.

    Raises
    ------
    InputError
        If fewer than three points lie in the range, or none has a stress in the direction of the
        test.
    """
    low, high = strain_range
    branch = loading_branch(curve, specimen)
    strain, stress = finite_pair(branch.rows, "strain_axial", "stress_mpa")
    inside = (strain >= low) & (strain <= high)
    if inside.sum() < SMALLEST_NUMBER_OF_POINTS:
        raise InputError(
            f"{int(inside.sum())} points in the strain range {low:g} to {high:g}",
            "widen calibration.rubber.strain_range or leave the specimen out",
            specimen=specimen.specimen,
            column="strain_axial",
        )
    if not stress[inside].max() > 0:
        raise InputError(
            f"no stress in the direction of the test in the strain range {low:g} to {high:g}",
            "check the curve's strain origin, or leave the specimen out",
            specimen=specimen.specimen,
            column="stress_mpa",
            value=float(stress[inside].max()),
        )
    words = [f"{specimen.specimen}: {text}" for text in branch.words]
    if strain.max() < high:
        words.append(f"{specimen.specimen}: {STRAIN_ENDS} {strain.max():.4g}, before {high:g}")
    sign = specimen.test.load_sign
    stretch, stress = 1.0 + sign * strain[inside], sign * stress[inside]
    weight = _weight(stress, settings)
    return Observation(specimen.specimen, specimen.test.value, stretch, stress, weight), words


def _weight(stress: Array, settings: RubberSettings) -> Array:
    match settings.weights:
        case "points":
            return np.ones_like(stress)
        case "specimens":
            return np.full_like(stress, 1.0 / len(stress))
        case "relative":
            # below the floor a relative residual is noise over nearly nothing
            floor = settings.relative_error_floor * np.abs(stress).max()
            return 1.0 / (len(stress) * np.maximum(np.abs(stress), floor) ** 2)
        case _:
            assert_never(settings.weights)
