"""Scale factors that the sheet states for the channels of a specimen."""

from __future__ import annotations

from collections.abc import Sequence

from nptcs.ingest.conditioning.signals import STRAIN_CHANNELS
from nptcs.ingest.reading.raw_file import RawFile
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
