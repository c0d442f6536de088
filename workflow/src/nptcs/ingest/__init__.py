"""Raw files of test machines and cameras made into one tidy curve per specimen.

The files of one specimen come in, its curve and a record of how it came about go out:
`ingest_specimen`. Files are read in `reading`, readings are made into a curve in `conditioning`;
properties belong to `nptcs.reduce`.
"""

from nptcs.ingest.reading.profiles import load_profiles
from nptcs.ingest.specimen import Ingested, ingest_specimen

__all__ = ["Ingested", "ingest_specimen", "load_profiles"]
