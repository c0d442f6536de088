"""The ply card: measured constants from the property table, the others as stated assumptions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from nptcs.calibrate.covariance import covariance_of_means
from nptcs.calibrate.orthotropic import check_ply, check_reciprocity
from nptcs.config.materials.calibration import CalibrationSettings, ConstantSource, PlyAssumptions
from nptcs.errors import InputError
from nptcs.mechanical_tests import COMPOSITE_TESTS
from nptcs.reduce.deviations import CROSSHEAD, with_crosshead_strain
from nptcs.reduce.groups.counted import TRAVEL_NEXT_TO_SENSORS, counted, of_sensors, why_not
from nptcs.reduce.standards.tension import ANOTHER_RANGE
from nptcs.tables.laboratory.material_card import PLY_CONSTANTS, CardConstant, PlyCard
from nptcs.tables.laboratory.specimens import Specimen

MEASURED = ("e1_mpa", "e2_mpa", "nu12", "g12_mpa")
UNITS = {name: "MPa" if name.endswith("_mpa") else "1" for name in PLY_CONSTANTS}


def calibrate_ply(
    properties: pd.DataFrame,
    specimens: Sequence[Specimen],
    settings: CalibrationSettings,
    material: str | None = None,
) -> PlyCard:
    """Make the card of an orthotropic ply.

    Each measured constant is the mean over the included specimens of its source, with the
    standard error of that mean, s/√n.

    Parameters
    ----------
    properties : DataFrame
        `nptcs.tables.laboratory.properties.PropertiesTable`.
    specimens : sequence of Specimen
        The sheet; specimens with include = no do not enter.
    settings : CalibrationSettings
        Sources and assumptions.
    material : str, optional
        Name of the ply in the sheet; needed only where the sheet contains several.

    Returns
    -------
    PlyCard
        Nine constants, the covariance of the measured ones, and the checks in words.

    Raises
    ------
    InputError
        If a source has no value, or the constants are thermodynamically impossible.
    """
    material = material or only_ply(specimens)
    sheet = {s.specimen: s for s in specimens if s.material == material}
    table = counted(properties[properties["specimen"].isin(list(sheet))], sheet)
    sources: dict[str, ConstantSource] = {name: getattr(settings.ply, name) for name in MEASURED}
    samples = {
        name: specimen_values(table, source, name, material) for name, source in sources.items()
    }
    constants = {
        name: measured_quantity(name, samples[name], table, sources[name]) for name in MEASURED
    }
    constants |= assumed_quantities(settings.ply.assumptions, constants)
    constants = {name: constants[name] for name in PLY_CONSTANTS}
    used = {specimen for values in samples.values() for specimen in values.index}
    values = {name: quantity.value for name, quantity in constants.items()}
    across = settings.ply.e2_mpa.model_copy(update={"property": "poisson_ratio"})
    nu21 = rows_of(table, across)["value"].dropna()
    return PlyCard(
        name=material,
        synthetic=any(s.origin == "synthetic" for s in specimens if s.tested_piece in used),
        constants=constants,
        covariance=covariance_of_means(samples, UNITS),
        checks=(
            *check_ply(values, material, settings.ply.isotropy_tolerance_percent),
            check_reciprocity(constants, nu21),
            *_few_specimens(samples),
            *_ranges(samples, sources, table),
            *_origin_words(samples, sources, table),
            *_crosshead(samples, sources, table),
        ),
    )


def only_ply(specimens: Sequence[Specimen]) -> str:
    """Name of the one ply of the sheet.

    Raises
    ------
    InputError
        If the sheet names no composite, or several.
    """
    names = sorted({s.material for s in specimens if s.test in COMPOSITE_TESTS})
    if len(names) != 1:
        raise InputError(
            f"the sheet contains {len(names)} composites",
            "name the one that the card is for",
            column="material",
            value=", ".join(names),
        )
    return names[0]


def specimen_values(
    table: pd.DataFrame, source: ConstantSource, constant: str, material: str
) -> pd.Series:
    """Values of a source by specimen id, those that were not assessed left out.

    Raises
    ------
    InputError
        If no specimen of the source gives a value.
    """
    rows = rows_of(table, source)
    values = rows.dropna(subset=["value"]).set_index("specimen")["value"]
    if values.empty:
        flags = "; ".join(rows["flags"].unique())
        raise InputError(
            f"material {material}: no {source.property} from {' or '.join(source.tests)} at "
            f"{source.orientation_deg:g} degrees for {constant}" + (f" ({flags})" if flags else ""),
            "add such specimens, include them, or name another source in the configuration",
            column=f"calibration.ply.{constant}",
        )
    return values


def rows_of(table: pd.DataFrame, source: ConstantSource) -> pd.DataFrame:
    """Rows of the property table that a source names; the angle's sign does not count.

    A value from crosshead travel is emptied where another test of the source has a sensor.
    """
    rows = table[
        table["test"].isin(source.tests)
        & (table["orientation_deg"].abs() == abs(source.orientation_deg))
        & (table["property"] == source.property)
    ]
    return of_sensors(rows, ["property"])


def measured_quantity(
    name: str, values: pd.Series, table: pd.DataFrame, source: ConstantSource
) -> CardConstant:
    """Mean and standard error of a measured constant, with rule and specimens."""
    rows = rows_of(table, source)
    rows = rows[rows["specimen"].isin(values.index)]
    rules = " | ".join(dict.fromkeys(rows["rule"] + ", " + rows["range"]))
    n = len(values)
    return CardConstant(
        value=float(values.mean()),
        unit=UNITS[name],
        standard_error=float(values.std(ddof=1) / np.sqrt(n)) if n > 1 else None,
        origin="measured",
        rule=f"{rules}; mean of {n}, {'+'.join(source.tests)} {source.orientation_deg:g} degrees",
        specimens=tuple(values.index),
    )


def assumed_quantities(
    assumptions: PlyAssumptions, measured: dict[str, CardConstant]
) -> dict[str, CardConstant]:
    """Quantities that are assumed: a number, or equal to a measured constant."""
    quantities = {}
    for name, assumption in assumptions:
        if isinstance(assumption, str):
            quantities[name] = CardConstant(
                value=measured[assumption].value,
                unit=UNITS[name],
                origin="assumed",
                rule=f"assumed equal to {assumption}",
                equal_to=assumption,
            )
        else:
            quantities[name] = CardConstant(
                value=assumption, unit=UNITS[name], origin="assumed", rule="assumed value"
            )
    return quantities


def _crosshead(
    samples: dict[str, pd.Series], sources: dict[str, ConstantSource], table: pd.DataFrame
) -> list[str]:
    words = []
    for name, source in sources.items():
        rows = rows_of(table, source)
        found = with_crosshead_strain(rows[rows["specimen"].isin(samples[name].index)])
        if found:
            words.append(f"warning: {name} is based on {CROSSHEAD}: {', '.join(found)}")
        out = rows.loc[rows["flags"].str.startswith(TRAVEL_NEXT_TO_SENSORS), "specimen"]
        if len(out):
            reason = why_not(TRAVEL_NEXT_TO_SENSORS)
            words.append(f"{name}: left out for {reason}: {', '.join(out)}")
    return words


def _origin_words(
    samples: dict[str, pd.Series], sources: dict[str, ConstantSource], table: pd.DataFrame
) -> list[str]:
    """Say what the correction of the strain origin did to the values that each constant is from."""
    words = []
    for name, source in sources.items():
        rows = rows_of(table, source)
        effect = rows.loc[rows["specimen"].isin(samples[name].index), "origin_effect_percent"]
        if not effect.isna().all():
            low, high = effect.min(), effect.max()
            words.append(
                f"{name}: the strain origin was corrected in {effect.notna().sum()} of "
                f"{len(effect)} specimens, which changed the values by {low:+.2g} to {high:+.2g} %"
            )
    return words


def _ranges(
    samples: dict[str, pd.Series], sources: dict[str, ConstantSource], table: pd.DataFrame
) -> list[str]:
    """Warn of a constant whose specimens were reduced over several ranges, or not the rule's."""
    words = []
    for name, source in sources.items():
        rows = rows_of(table, source)
        rows = rows[rows["specimen"].isin(samples[name].index)]
        other = rows.loc[rows["flags"].str.contains(ANOTHER_RANGE, regex=False), "specimen"]
        ranges = " | ".join(dict.fromkeys(rows["range"]))
        if len(other):
            words.append(f"warning: {name}: {ANOTHER_RANGE} ({ranges}): {', '.join(other)}")
        elif len(set(rows["range"])) > 1:
            words.append(f"warning: {name}: ranges differ between specimens ({ranges})")
    return words


def _few_specimens(samples: dict[str, pd.Series]) -> list[str]:
    return [
        f"{name}: one specimen, no standard error" for name, v in samples.items() if len(v) == 1
    ]
