"""The raw tables of one specimen, as its row of the sheet names them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.folder import find_file
from nptcs.ingest.reading.profiles import FormatProfile, choose
from nptcs.ingest.reading.raw_file import RawFile, read_raw
from nptcs.ingest.strain_fields import read_strain_fields
from nptcs.tables.laboratory.curves import Role
from nptcs.tables.laboratory.specimens import Specimen


def read_specimen_tables(
    specimen: Specimen,
    folder: Path,
    profiles: Mapping[str, FormatProfile],
    limits: FileLimits,
) -> tuple[RawFile, ...]:
    """Read the force file, and the strain file if there is one.

    Raises
    ------
    InputError
        With the specimen's id, if a file is missing or cannot be read with certainty.
    """
    wanted: list[tuple[str, str, str, Role]] = [
        (specimen.force_file, specimen.force_format, specimen.force_part, "force")
    ]
    if specimen.strain_file:
        wanted.append(
            (specimen.strain_file, specimen.strain_format, specimen.strain_part, "strain")
        )
    tables = []
    for name, format_name, part, role in wanted:
        declared = choose(format_name, profiles, specimen.specimen) if format_name else None
        try:
            if role == "strain" and (folder / name).is_dir():
                tables.append(read_strain_fields(folder / name, profiles, declared, limits))
                continue
            table = read_raw(
                find_file(folder, name),
                profiles,
                declared=declared,
                part=part,
                specimen=specimen.specimen,
                role=role if len(wanted) > 1 else "force and strain",
                limits=limits,
            )
        except InputError as error:
            error.specimen = specimen.specimen
            raise
        tables.append(table)
    return tuple(tables)
