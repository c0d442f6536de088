"""Scale factors that the sheet states for the channels of a specimen."""

from __future__ import annotations

from collections.abc import Sequence

from nptcs.errors import InputError
from nptcs.ingest.conditioning.signals import STRAIN_CHANNELS
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.reading.unit_in_name import factor_in_name
from nptcs.tables.laboratory.specimens import Specimen


def apply_factors(tables: Sequence[RawFile], specimen: Specimen) -> list[str]:
    """Multiply force and strain channels by the sheet's factors, and say so.

    Parameters
    ----------
    tables : sequence of RawFile
        The specimen's files; their values are replaced. The force channel of a strain file (the
        camera's copy of the machine's) is scaled, too.
    specimen : Specimen
        With ``force_factor`` and ``strain_factor``; a stretch is scaled as its strain.

    Returns
    -------
    list of str
        A flag for each factor that is not 1.
    """
    words = []
    channels = (
        ("force", specimen.force_factor, ("force", "stress")),
        ("strain", specimen.strain_factor, STRAIN_CHANNELS),
    )
    for what, factor, names in channels:
        if factor == 1:
            continue
        words.append(f"{what} multiplied by {factor:g}, as the sheet states")
        for table in tables:
            for name in names:
                if name in table.values:
                    origin = 1.0 if name == "stretch" else 0.0
                    table.values[name] = origin + factor * (table.values[name] - origin)
    return words


def refuse_scaled_names(tables: Sequence[RawFile], specimen: Specimen) -> None:
    """Refuse a column whose name contains a factor (``Load x10``), unless the sheet settles it.

    No name tells whether the readings are still to be multiplied, or already were. A factor in the
    sheet settles it, even a factor of 1, and so does a profile that the sheet names.

    Raises
    ------
    InputError
        With the file, the column and the sheet's column that settles it.
    """
    channels = (("force_factor", ("force", "stress")), ("strain_factor", STRAIN_CHANNELS))
    for table in tables:
        for key, quantities in channels:
            for name in (table.columns[one] for one in quantities if one in table.values):
                found = factor_in_name(name)
                if not found or key in specimen.model_fields_set or not table.detected:
                    continue
                raise InputError(
                    f"the column's name contains a factor, '{found}': whether the readings still "
                    "have to be multiplied by it cannot be told",
                    f"write the factor of the readings as {key} in the sheet, 1 if they are right "
                    "as they are",
                    table.path,
                    column=name,
                    specimen=specimen.specimen,
                )
