"""Raw files of test machines and cameras made into one tidy curve per specimen.

The files of one specimen come in; its curve and a record of how it was made go out:
`ingest_specimen`. Files are read in `reading`, readings are made into a curve in `conditioning`;
properties belong to `nptcs.reduce`.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from nptcs.ingest.reading.profiles import load_profiles
    from nptcs.ingest.specimen import Ingested, ingest_or_record, ingest_specimen

__all__ = ["Ingested", "ingest_or_record", "ingest_specimen", "load_profiles"]

_HOMES = {
    "load_profiles": "nptcs.ingest.reading.profiles",
    "Ingested": "nptcs.ingest.specimen",
    "ingest_or_record": "nptcs.ingest.specimen",
    "ingest_specimen": "nptcs.ingest.specimen",
}


def __getattr__(name: str) -> Any:
    """Import a name on first use: the rules need only the names of files, not the readers."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
