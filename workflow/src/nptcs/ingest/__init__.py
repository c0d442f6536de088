"""Raw files of test machines and cameras into one tidy curve a specimen."""

from nptcs.ingest.reading.profiles import load_profiles
from nptcs.ingest.specimen import Ingested, ingest_specimen

__all__ = ["Ingested", "ingest_specimen", "load_profiles"]
