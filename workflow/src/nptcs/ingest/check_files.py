"""What a run would find wrong with the files of a sheet, reported before it begins."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from nptcs.config.materials.ingest import IngestSettings
from nptcs.errors import InputError
from nptcs.ingest.conditioning.strains import NO_STRAIN_FLAG, NO_TRANSVERSE
from nptcs.ingest.folder import is_there
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.repeats import repeated_specimens
from nptcs.ingest.specimen import ingest_specimen
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.specimens import Specimen

_SAID = (NO_STRAIN_FLAG, NO_TRANSVERSE)


def check_files(
    specimens: Sequence[Specimen],
    sheet: Path,
    settings: IngestSettings,
    profiles: Mapping[str, FormatProfile],
) -> tuple[list[InputError], list[str]]:
    """Ingest the included specimens of a sheet, and keep only their faults and notes.

    Parameters
    ----------
    specimens : sequence of Specimen
        The good rows of the sheet.
    sheet : Path
        The sheet, next to its files.
    settings : IngestSettings
        As in a run.
    profiles : mapping of str to FormatProfile
        All known formats.

    Returns
    -------
    faults : list of InputError
        A file that is missing or cannot be read, a missing length without which travel cannot
        be converted to strain, anything else that stops a specimen, and data that repeat those
        of another specimen.
    notes : list of str
        What specimens that can be reduced will lack because a length is missing: one line for
        each reason, with the specimens.
    """
    faults = [
        InputError(
            "this raw file does not exist",
            file=sheet.parent / name,
            specimen=specimen.specimen,
            remedy="correct the file name in the specimen sheet, or copy the file into its folder",
        )
        for specimen in specimens
        for name in specimen.files
        if not is_there(sheet.parent, name)
    ]
    missing = {fault.specimen for fault in faults}
    records: list[IngestRecord] = []
    for specimen in specimens:
        if specimen.include and specimen.specimen not in missing:
            try:
                records.append(ingest_specimen(specimen, sheet.parent, settings, profiles).record)
            except InputError as error:
                error.specimen = error.specimen or specimen.specimen
                faults.append(error)
    faults += [
        InputError(
            f"the same data as specimen {first}",
            "name the right file, or set include to no; it is not counted twice",
            sheet,
            specimen=name,
        )
        for name, first in repeated_specimens(specimens, records).items()
    ]
    return faults, _notes(records)


def _notes(records: Sequence[IngestRecord]) -> list[str]:
    """Collect the flags that say which strain is missing, each once with its specimens."""
    found: dict[str, list[str]] = {}
    for record in records:
        for flag in record.flags:
            if flag.startswith(_SAID):
                found.setdefault(flag, []).append(record.specimen)
    return [f"{', '.join(names)}: {flag}" for flag, names in found.items()]
