"""From the channels of a test to axial and transverse strain."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.ingest.conditioning.signals import Signals, largest, line_slope
from nptcs.ingest.reading.columns.names import OVER_LENGTH
from nptcs.ingest.reading.profiles import normalise
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.tables.laboratory.specimens import Specimen

AMBIGUOUS_RATIO = 0.9
"""Two in-plane strains closer than this cannot be told apart."""
NO_STRAIN = "none"
"""Strain source of a test that gives only its strength."""
NO_STRAIN_FLAG = "no strain: "
"""Beginning of the flag of such a test."""
NO_TRANSVERSE = "no transverse strain"
"""Beginning of the flags of a test whose transverse strain could not be read."""


def resolve_strains(
    signals: Signals,
    specimen: Specimen,
    columns: Mapping[str, str],
    source: str,
    compliance_mm_per_n: float | None,
    path: Path,
) -> str:
    """Replace the channels by ``strain_axial``, ``strain_transverse``, ``strain_axial_back``.

    Parameters
    ----------
    signals : Signals
        With ``force``; is changed.
    specimen : Specimen
        Its gauge length, test and stated axis.
    columns : mapping of str to str
        Quantity → column name.
    source : str
        Strain source by the profile, or ``unspecified``.
    compliance_mm_per_n : float or None
        Of machine and grips, for crosshead travel.
    path : Path
        Strain file, for messages.

    Returns
    -------
    str
        Strain source.
    """
    values = signals.values
    transverse: Array | None = values.get("strain_transverse")
    if "strain_xx" in values and "strain_yy" in values and "strain" not in values:
        axial, transverse = _axes(signals, specimen, columns, path)
        source = "dic" if source == "unspecified" else source
    else:
        if transverse is None and "extension_transverse" in values:
            transverse = _across(signals, specimen, columns["extension_transverse"])
        name, axial, source = _single(signals, specimen, columns, source, compliance_mm_per_n, path)
        signals.note("axial strain", f"column '{columns[name]}'" if source != NO_STRAIN else "none")
    empty = np.full(len(signals), np.nan)
    values["strain_axial"] = axial
    values["strain_transverse"] = empty if transverse is None else transverse
    values["strain_axial_back"] = values.pop("strain_back", empty)
    if source == "crosshead":
        signals.flags.append(
            "crosshead strain: modulus and strains include the compliance of machine and grips"
        )
    elif source == NO_STRAIN:
        why = (
            "gauge_length_mm is empty in the sheet, so crosshead travel cannot be converted to "
            "strain"
            if "displacement" in values
            else f"column '{columns['displacement']}' contains no travel in a unit of length"
        )
        left = (
            "a shear test needs axial and transverse strain"
            if specimen.test.strains_alike
            else "the strength is based on the force alone, and no modulus checks its unit"
        )
        signals.flags.append(f"{NO_STRAIN_FLAG}{why}; {left}")
    elif source == "unspecified":
        signals.flags.append("the file does not say what measured the strain")
    return source


def _across(signals: Signals, specimen: Specimen, name: str) -> Array | None:
    """Strain of a transverse extensometer in mm; None, and flagged, without its length."""
    if specimen.transverse_length_mm is None:
        signals.flags.append(
            f"{NO_TRANSVERSE}: column '{name}' is a length, and transverse_length_mm (usually the "
            "width of the specimen) is empty in the sheet"
        )
        return None
    readings = signals.values["extension_transverse"]
    known = readings[~np.isnan(readings)]
    first = known[0] if len(known) else np.nan
    signals.note("transverse strain", f"column '{name}' over {specimen.transverse_length_mm:g} mm")
    return (readings - first) / specimen.transverse_length_mm


_TRANSVERSE_WORD = re.compile(
    r"transv|lateral|quer(?!schnitt)|breiten|(?:change|delta|strain|variation).{0,12}width|width"
    r".{0,12}(?:change|strain)|trasvers|poprzecz|попереч|příčn|横向|横ひずみ|幅方向"
)
_STRAIN_WORD = re.compile(
    r"strain|dehnung|extensom|d[ée]formation|deformaci|deforma[cç]|odkszta|деформац|应变|歪|ひずみ|変形"
)


def flag_unread_strains(signals: Signals, table: RawFile, source: str) -> None:
    """Flag columns that may be a strain and were not read, where only travel was.

    A word in the name suggests it, or a unit of strain or length where the name is not that of a
    travel. A column named after a transverse strain is flagged where no transverse strain was read.
    """
    read = {name for quantity, name in table.columns.items() if quantity in table.values}
    if not {"strain_transverse", "extension_transverse", "strain_yy"} & set(table.values):
        across = [n for n in table.names if n not in read and _TRANSVERSE_WORD.search(n.casefold())]
        if across:
            names = ", ".join(map(repr, across))
            signals.flags.append(
                f"{NO_TRANSVERSE}: not read as one: {names} (a profile can name it)"
            )
    if source not in ("crosshead", NO_STRAIN):
        return
    named = [n for n in table.names if n not in read and _STRAIN_WORD.search(n.casefold())]
    unread = [repr(name) for name in named if not OVER_LENGTH.search(name.casefold())]
    unread += [words for words in table.unread if not words.startswith(tuple(unread))]
    if unread:
        signals.flags.append(f"not read as a strain: {', '.join(unread)} (a profile can name it)")


def _single(
    signals: Signals,
    specimen: Specimen,
    columns: Mapping[str, str],
    source: str,
    compliance: float | None,
    path: Path,
) -> tuple[str, Array, str]:
    """Take the best channel along the load that there is: its name, strain and source.

    A travel without a length leaves the strain empty where the strength needs none.
    """
    values = signals.values
    if "strain" in values:
        follows = _follows(values["strain"], values.get("displacement"))
        return "strain", values["strain"], "crosshead" if follows else source
    for name in ("strain_xx", "strain_yy"):
        if name in values:
            return name, values[name], "dic" if source == "unspecified" else source
    if "stretch" in values:
        return "stretch", values["stretch"] - 1.0, source
    return _of_length(signals, specimen, columns, source, compliance, path)


def _of_length(
    signals: Signals,
    specimen: Specimen,
    columns: Mapping[str, str],
    source: str,
    compliance: float | None,
    path: Path,
) -> tuple[str, Array, str]:
    """Strain from a change of length: that of an extensometer, else the crosshead's travel."""
    values = signals.values
    name = "extension" if "extension" in values else "displacement"
    # a ±45° test without a camera gives no strain, but that is not an error of its row
    may_lack = specimen.test.has_strength_without_strain or specimen.test.strains_alike
    if name not in values and name in columns and may_lack:
        return name, np.full(len(signals), np.nan), NO_STRAIN
    if name not in values:
        raise InputError(
            "no strain", "name a strain_file in the sheet", path, specimen=specimen.specimen
        )
    if specimen.gauge_length_mm is None and specimen.bar is None:
        if name == "displacement" and may_lack:
            return name, np.full(len(signals), np.nan), NO_STRAIN
        raise InputError(
            f"gauge_length_mm is empty: {name} cannot become strain",
            "give the gauge length (grip distance for crosshead travel) in the sheet",
            path,
            specimen=specimen.specimen,
        )
    length = values[name] - values[name][~np.isnan(values[name])][0]
    if name == "displacement" and compliance is not None:
        length = length - compliance * values["force"]
        signals.note("compliance", "travel - compliance × force", compliance_mm_per_n=compliance)
    if name == "extension":
        source = "extensometer" if source in ("unspecified", "crosshead") else source
    else:
        source = "crosshead"
    return name, length * specimen.strain_per_length(source == "crosshead"), source


def _follows(strain: Array, travel: Array | None) -> bool:
    """Tell whether a strain is nothing but the crosshead travel over a length."""
    if travel is None:
        return False
    moved = np.abs(travel - travel[0]) > 0.01 * np.nanmax(np.abs(travel - travel[0]))
    ratio = (strain[moved] - strain[0]) / (travel[moved] - travel[0])
    if not len(ratio) or np.isnan(ratio).all():
        return False
    middle = float(np.nanmedian(ratio))
    return bool(np.nanmax(np.abs(ratio - middle)) <= 1e-3 * abs(middle))


def _axes(
    signals: Signals, specimen: Specimen, columns: Mapping[str, str], path: Path
) -> tuple[Array, Array]:
    """Axial and transverse from exx and eyy: axial is the larger, or follows the load alone."""
    slopes = {name: slope_over_force(signals, name) for name in ("strain_xx", "strain_yy")}
    ordered = sorted(slopes, key=lambda name: abs(slopes[name]), reverse=True)
    stated = _stated_axis(specimen, columns)
    found = ", ".join(f"'{columns[name]}' {1e6 * slopes[name]:.4g} µε/N" for name in slopes)
    ratio = abs(slopes[ordered[1]] / slopes[ordered[0]]) if slopes[ordered[0]] else 1.0
    by_sign = _axis_by_sign(signals, specimen, slopes)
    if stated is None and ratio > AMBIGUOUS_RATIO and by_sign is None:
        raise InputError(
            f"the axial strain cannot be told from the data: {found}",
            "name the column as strain_axis in the sheet",
            path,
            specimen=specimen.specimen,
        )
    axial = stated or (by_sign if ratio > AMBIGUOUS_RATIO and by_sign else ordered[0])
    if axial != ordered[0] and ratio < AMBIGUOUS_RATIO:
        raise InputError(
            f"strain_axis is '{specimen.strain_axis}', but the other strain is larger: {found}",
            "correct strain_axis, or leave it empty",
            path,
            specimen=specimen.specimen,
        )
    other = "strain_yy" if axial == "strain_xx" else "strain_xx"
    how = "found: the larger one" if ratio <= AMBIGUOUS_RATIO else "found: it follows the load"
    how = "stated in the sheet" if stated else how
    signals.note("axial strain", f"column '{columns[axial]}', {how} ({found})")
    return signals.values[axial], signals.values[other]


def _axis_by_sign(signals: Signals, specimen: Specimen, slopes: Mapping[str, float]) -> str | None:
    """Strain of a ±45° laminate that grows with the load while the other one shrinks.

    Their size does not tell them apart there: its Poisson's ratio is near 1. Only where the force
    has the sign of the test: otherwise the load cell may be reversed.
    """
    if not specimen.test.strains_alike:
        return None
    growing = [name for name, slope in slopes.items() if slope > 0]
    as_tested = largest(signals.values["force"]) * specimen.test.load_sign > 0
    return growing[0] if len(growing) == 1 and as_tested else None


def slope_over_force(signals: Signals, name: str) -> float:
    """Least-squares slope of a strain over force, up to the largest force of either sign."""
    force = signals.values["force"]
    largest_of_each = [int(np.nanargmax(force)), int(np.nanargmin(force))]
    rows = np.arange(len(force)) <= max(
        row for row in largest_of_each if abs(force[row]) > 0.05 * np.nanmax(np.abs(force))
    )
    rows &= ~np.isnan(signals.values[name]) & ~np.isnan(force)
    if rows.sum() < 2 or np.ptp(force[rows]) == 0:
        return 0.0
    return line_slope(force[rows], signals.values[name][rows])


def _stated_axis(specimen: Specimen, columns: Mapping[str, str]) -> str | None:
    if not specimen.strain_axis:
        return None
    wanted = normalise(specimen.strain_axis)
    for name in ("strain_xx", "strain_yy"):
        short = name.replace("strain_", "e")
        if wanted in (short, name, normalise(columns[name])):
            return name
    raise InputError(
        "strain_axis is not a strain of the file",
        f"use '{columns['strain_xx']}' or '{columns['strain_yy']}'",
        specimen=specimen.specimen,
        column="strain_axis",
        value=specimen.strain_axis,
    )
