"""Checks against physics: a wrong unit or area is an error, not a number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nptcs.config.materials.ingest import Plausible
from nptcs.errors import InputError
from nptcs.ingest.conditioning.signals import Signals
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.tables.laboratory.specimens import Specimen


def check_machine_area(
    signals: Signals, specimen: Specimen, table: RawFile, settings: Plausible
) -> None:
    """Compare the machine's stress with force over the measured area.

    Raises
    ------
    InputError
        If they differ by more than a factor 2: a unit must be wrong.
    """
    if "stress" not in signals.values or "force" not in table.values:
        return
    force, stress = np.abs(signals.values["force"]), np.abs(signals.values["stress"])
    loaded = (force > 0.2 * np.nanmax(force)) & (stress > 0)
    if not loaded.any():
        return
    area, ours = float(np.median(force[loaded] / stress[loaded])), specimen.force_per_stress_mm2
    ratio = area / ours
    if not 0.5 < ratio < 2:
        raise InputError(
            f"force ({table.units['force']}) and stress ({table.units['stress']}) of the file "
            f"give an area of {area:.4g} mm², the sheet {ours:.4g} mm²",
            "correct the area in the sheet, or the unit by a profile's wrong_units",
            table.path,
            column=table.columns["stress"],
            specimen=specimen.specimen,
        )
    if abs(ratio - 1) > settings.area_difference:
        signals.flags.append(
            f"machine area {area:.5g} mm² differs from the sheet's {ours:.5g} mm²; "
            "the sheet's was used"
        )


def check_labels(signals: Signals, specimen: Specimen, table: RawFile, settings: Plausible) -> None:
    """Flag dimensions in the file's header that differ from the sheet's."""
    sheet = {
        "width": specimen.mean_width_mm,
        "thickness": specimen.mean_thickness_mm,
        "area": specimen.area_mm2,
    }
    for name, ours in sheet.items():
        found = table.labels.get(name)
        if found is None or found.value is None or ours is None:
            continue
        if abs(found.value / ours - 1) > settings.area_difference:
            unit = "mm²" if name == "area" else "mm"
            signals.flags.append(
                f"{name} in {table.path.name} is {found.value:.5g} {unit}, "
                f"in the sheet {ours:.5g} {unit}; the sheet's was used"
            )


def check_physics(
    signals: Signals, specimen: Specimen, tables: Sequence[RawFile], settings: Plausible
) -> None:
    """Stop if the strain or the apparent modulus is physically impossible.

    Raises
    ------
    InputError
        With the units as read, since one of them is probably wrong.
    """
    rubber = specimen.test.is_rubber
    units = "; ".join(
        f"{table.path.name}: "
        + ", ".join(f"{name} in {unit}" for name, unit in table.units.items())
        for table in tables
    )
    remedy = (
        f"check units ({units}), width and thickness; state a wrong unit in a profile under "
        "wrong_units, other limits under ingest: plausible"
    )
    strain = float(np.nanmax(np.abs(signals.values["strain_axial"])))
    modulus = apparent_modulus(signals)
    _check_assumed_unit(signals, specimen, tables[-1], strain, modulus)
    limit = settings.strain_rubber if rubber else settings.strain_composite
    if strain > limit:
        raise InputError(
            f"largest strain {strain:.4g} is beyond {limit:g} (dimensionless)",
            remedy,
            tables[-1].path,
            specimen=specimen.specimen,
        )
    low, high = settings.modulus_rubber_mpa if rubber else settings.modulus_composite_mpa
    if modulus is not None and not low <= modulus <= high:
        raise InputError(
            f"apparent modulus {modulus:.4g} MPa is outside {low:g} to {high:g} MPa",
            remedy,
            tables[-1].path,
            specimen=specimen.specimen,
        )


MAY_BE_PERCENT = {False: (0.05, 1e4), True: (1.0, 0.2)}
"""Strain beyond which, and modulus in MPa below which, readings without a unit may as well be
percent (rubber: True): a hundred times that modulus is still plausible for such a material."""


def _check_assumed_unit(
    signals: Signals, specimen: Specimen, table: RawFile, largest: float, modulus: float | None
) -> None:
    """Flag a strain without a unit, and stop where it may be a strain or a percentage."""
    assumed = [name for name in ("strain", "strain_xx", "strain_yy") if name in table.assumed]
    if not assumed:
        _flag_large_strain(signals, specimen, largest, modulus)
        return
    beyond, below = MAY_BE_PERCENT[specimen.test.is_rubber]
    if largest > beyond and (modulus is None or modulus < below):
        raise InputError(
            f"no unit for strain, and its largest reading {largest:.4g} may be a strain or a "
            "percentage",
            "state the unit in a profile under 'units' ('1' or '%') and name the profile in the "
            "sheet",
            table.path,
            column=table.columns[assumed[0]],
            specimen=specimen.specimen,
        )
    signals.flags.append("strain without a unit in the file, taken as dimensionless")


LARGE_STRAIN = 0.1
"""Strain of a laminate beyond which its unit is worth a look, if the modulus is low as well, ..."""
STIFF_IF_PERCENT = (1e4, 3e5)
"""... and a hundred times the modulus would be that of a laminate (MPa)."""


def _flag_large_strain(
    signals: Signals, specimen: Specimen, largest: float, modulus: float | None
) -> None:
    """Flag a strain that its unit makes large, and that would be usual as a percentage."""
    if specimen.test.is_rubber:
        _flag_small_strain(signals, specimen, largest)
        return
    if modulus is None or largest <= LARGE_STRAIN:
        return
    if STIFF_IF_PERCENT[0] <= 100 * modulus <= STIFF_IF_PERCENT[1]:
        signals.flags.append(
            f"strain reaches {100 * largest:.3g} % at an apparent modulus of {modulus:.4g} MPa by "
            "the unit of the file; if the readings are in percent, state it in a profile under "
            "wrong_units"
        )


SMALL_STRAIN = 0.2
"""Strain below which few rubbers break."""


def _flag_small_strain(signals: Signals, specimen: Specimen, largest: float) -> None:
    """Flag a rubber that breaks at a strain that would be usual a hundred times larger."""
    if signals.failure_seen and specimen.test.load_sign > 0 and largest < SMALL_STRAIN:
        signals.flags.append(
            f"a rubber that breaks at a strain of {100 * largest:.3g} % by the unit of the file; "
            "if the readings are not in percent, state the unit in a profile under wrong_units"
        )


def apparent_modulus(signals: Signals) -> float | None:
    """Secant modulus between 10 and 50 % of the largest stress with a measured strain, in MPa."""
    stress, strain = np.abs(signals.values["stress"]), np.abs(signals.values["strain_axial"])
    measured = ~np.isnan(strain)
    stress, strain = stress[measured], strain[measured]
    if len(stress) < 2:
        return None
    peak = int(np.argmax(stress))
    low, high = (int(np.argmax(stress[: peak + 1] >= share * stress[peak])) for share in (0.1, 0.5))
    rise = strain[high] - strain[low]
    return float((stress[high] - stress[low]) / rise) if rise > 0 else None
