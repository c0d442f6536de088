"""One specimen from its raw files to its tidy curve and the record of how it was made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.config.materials.ingest import IngestSettings
from nptcs.errors import InputError
from nptcs.ingest.conditioning.across import settle_transverse
from nptcs.ingest.conditioning.declared_test import require_declared_test
from nptcs.ingest.conditioning.excursions import empty_excursions, empty_in_table
from nptcs.ingest.conditioning.factors import apply_factors, refuse_scaled_names
from nptcs.ingest.conditioning.pairing import pair
from nptcs.ingest.conditioning.plausible import check_labels, check_machine_area, check_physics
from nptcs.ingest.conditioning.rescaled import cut_rescaled
from nptcs.ingest.conditioning.saturation import cut_saturated
from nptcs.ingest.conditioning.sensors import empty_after_removal, empty_lost_channels
from nptcs.ingest.conditioning.signals import Signals
from nptcs.ingest.conditioning.signs import orient
from nptcs.ingest.conditioning.steps import (
    cut_end,
    drop_empty_rows,
    empty_spikes,
    mark_dead,
    zero_force,
)
from nptcs.ingest.conditioning.strain_origin import correct_origin
from nptcs.ingest.conditioning.strains import NO_STRAIN, flag_unread_strains, resolve_strains
from nptcs.ingest.conditioning.tare import flag_tare
from nptcs.ingest.read_tables import read_specimen_tables
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.repeats import data_digest
from nptcs.ingest.sketch import data_sketch
from nptcs.tables.io import empty_table
from nptcs.tables.laboratory.curves import (
    CURVE_COLUMNS,
    Curve,
    FileRecord,
    Geometry,
    IngestRecord,
    Role,
)
from nptcs.tables.laboratory.specimens import Specimen

FEWEST_ROWS = 5


@dataclass(frozen=True)
class Ingested:
    """The curve of a specimen (`nptcs.tables.laboratory.curves.Curve`) and its record."""

    curve: pd.DataFrame
    record: IngestRecord


def ingest_or_record(
    specimen: Specimen,
    folder: str | Path,
    settings: IngestSettings,
    profiles: Mapping[str, FormatProfile],
) -> Ingested:
    """Ingest a specimen, or record why that failed: an empty curve and the error's message.

    Parameters and result are those of `ingest_specimen`.
    """
    try:
        return ingest_specimen(specimen, folder, settings, profiles)
    except InputError as error:
        return Ingested(empty_table(Curve), IngestRecord.failed(specimen.specimen, error))


def ingest_specimen(
    specimen: Specimen,
    folder: str | Path,
    settings: IngestSettings,
    profiles: Mapping[str, FormatProfile],
) -> Ingested:
    """Read, pair and condition the raw files of one specimen.

    Parameters
    ----------
    specimen : Specimen
        Its row of the sheet.
    folder : str or Path
        Folder of the sheet, to which the file names are relative.
    settings : IngestSettings
        Conditioning steps.
    profiles : mapping of str to FormatProfile
        All known formats (`nptcs.ingest.reading.profiles.load_profiles`).

    Returns
    -------
    Ingested
        ``curve`` with the columns of `nptcs.tables.laboratory.curves.Curve`, tension positive (the
        contract is checked where it is written), and ``record``.

    Raises
    ------
    InputError
        If a file cannot be read with certainty, or physics contradicts it.
    """
    tables = read_specimen_tables(specimen, Path(folder), profiles, settings.limits)
    load, strain = tables[0], tables[-1]
    refuse_scaled_names(tables, specimen)
    digest, sketch = data_digest(tables), data_sketch(tables)
    factors = apply_factors(tables, specimen)
    signals = _pair(tables, specimen, settings)
    signals.flags += [*factors, *(doubt for table in tables for doubt in table.doubts)]
    for table, name in zip(tables, (specimen.force_file, specimen.strain_file), strict=False):
        require_declared_test(signals, specimen, table, name)
    mark_dead(signals, settings.missing_values)
    empty_spikes(signals, settings.missing_values)
    empty_excursions(signals, settings.missing_values)
    _flag_time(signals)
    _require_force(signals, specimen, load)
    check_machine_area(signals, specimen, load, settings.plausible)
    empty_lost_channels(
        signals, settings.extensometer, specimen.test.is_rubber, specimen.gauge_length_mm
    )
    specimen = _with_gauge_length(specimen, tables, signals)
    source = resolve_strains(
        signals,
        specimen,
        strain.columns,
        strain.strain_source,
        settings.compliance.compliance_mm_per_n,
        strain.path,
    )
    flag_unread_strains(signals, strain, source)
    drop_empty_rows(signals, settings.missing_values)
    _require_rows(signals, specimen, strain, source)
    orient(signals, specimen, strain.path, settings.signs, source)
    settle_transverse(signals, specimen, strain.columns)
    flag_tare(signals)
    cut_saturated(signals)
    cut_rescaled(signals, source)
    zero_force(signals, settings.force_zero)
    signals.values["stress"] = signals.values["force"] / specimen.force_per_stress_mm2
    cut_end(signals, settings.end_of_test)
    _require_rows(signals, specimen, strain, source)
    if source != NO_STRAIN:
        empty_after_removal(signals, settings.extensometer, specimen.test.is_rubber, source)
        correct_origin(signals, settings.strain_origin, specimen.test.is_rubber)
        check_physics(signals, specimen, tables, settings.plausible)
    for table in tables:
        check_labels(signals, specimen, table, settings.plausible)
    return Ingested(_curve(signals), _record(specimen, tables, signals, source, digest, sketch))


def _with_gauge_length(
    specimen: Specimen, tables: tuple[RawFile, ...], signals: Signals
) -> Specimen:
    """Take the gauge length of the file's head where the sheet has none and it is needed."""
    needed = not {"strain", "strain_xx", "strain_yy", "stretch"} & set(signals.values)
    found = next((t.labels["gauge_length"] for t in tables if "gauge_length" in t.labels), None)
    if specimen.gauge_length_mm is not None or not needed or found is None or not found.value:
        return specimen
    signals.flags.append(f"gauge length {found.value:g} mm from the file's head, none in the sheet")
    return specimen.model_copy(update={"gauge_length_mm": found.value})


def _pair(tables: tuple[RawFile, ...], specimen: Specimen, settings: IngestSettings) -> Signals:
    if len(tables) == 1:
        return Signals(dict(tables[0].values))
    # before pairing, which adds the row of the largest force and interpolates
    words = [flag for table in tables for flag in empty_in_table(table, settings.missing_values)]
    paired = pair(
        tables[0],
        tables[1],
        specimen.time_offset_s,
        settings.pairing,
        specimen.specimen,
        settings.end_of_test.force_drop,
    )
    paired.flags += words
    return paired


def _require_force(signals: Signals, specimen: Specimen, table: RawFile) -> None:
    """Make sure that there is a force: the file's own, or its stress times the sheet's area."""
    if "force" not in signals.values:
        signals.values["force"] = signals.values["stress"] * specimen.force_per_stress_mm2
        signals.flags.append("stress as the file gives it; its area could not be checked")
    force = signals.values["force"]
    if np.isnan(force).all() or not np.nanmax(np.abs(force)):
        raise InputError(
            "force is empty or zero throughout",
            "check the force column in the file",
            table.path,
            column=table.columns.get("force"),
            specimen=specimen.specimen,
        )


def _flag_time(signals: Signals) -> None:
    """Flag a time that goes back; it pairs files, but no property of a single file needs it."""
    time = signals.values.get("time")
    if time is not None and not (np.diff(time[~np.isnan(time)]) > 0).all():
        signals.flags.append("time does not increase throughout")


def _require_rows(signals: Signals, specimen: Specimen, table: RawFile, source: str) -> None:
    needed = "force" if source == NO_STRAIN else "strain_axial"
    measured = int((~np.isnan(signals.values[needed])).sum())
    if measured < FEWEST_ROWS:
        raise InputError(
            f"only {measured} rows hold force{' and strain' if source != NO_STRAIN else ''}",
            "check the columns of the files (nptcs inspect FILE)",
            table.path,
            specimen=specimen.specimen,
        )


def _curve(signals: Signals) -> pd.DataFrame:
    values = signals.values
    nothing = np.full(len(signals), np.nan)
    return pd.DataFrame(
        {
            "time_s": values.get("time", nothing),
            "force_n": values["force"],
            "stress_mpa": values["stress"],
            **{name: values[name] for name in CURVE_COLUMNS[3:]},
        }
    )


def _record(
    specimen: Specimen,
    tables: tuple[RawFile, ...],
    signals: Signals,
    source: str,
    digest: str,
    sketch: tuple[int, ...],
) -> IngestRecord:
    roles: tuple[Role, ...] = ("force", "strain") if len(tables) > 1 else ("force and strain",)
    names = (specimen.force_file, specimen.strain_file)
    return IngestRecord(
        specimen=specimen.specimen,
        status="ok",
        files=tuple(
            FileRecord(
                path=name,
                sha256=table.sha256,
                role=role,
                format=table.profile.name,
                detected=table.detected,
                encoding=table.encoding,
                delimiter=table.delimiter,
                decimal=table.decimal,
                header_line=table.header_line,
                first_line=table.first_line,
                rows=table.rows,
                units=table.units,
                columns=table.columns,
                notes=table.notes,
            )
            for name, table, role in zip(names, tables, roles, strict=False)
        ),
        geometry=Geometry(
            mean_width_mm=specimen.mean_width_mm,
            mean_thickness_mm=specimen.mean_thickness_mm,
            area_mm2=specimen.area_mm2,
            area_rule=specimen.area_rule,
            width_stations=len(specimen.width_mm),
            thickness_stations=len(specimen.thickness_mm),
        ),
        data_sha256=digest,
        data_sketch=sketch,
        strain_source=source,
        failure_seen=signals.failure_seen,
        steps=tuple(signals.steps),
        flags=tuple(dict.fromkeys(signals.flags)),
    )
