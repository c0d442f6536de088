from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from nptcs.ingest.reading.profiles import FormatProfile, load_profiles
from nptcs.ingest.reading.raw_file import RawFile, read_raw
from nptcs.tables.specimens import Specimen

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def profiles() -> Mapping[str, FormatProfile]:
    return load_profiles(ROOT / "config" / "formats")


@pytest.fixture
def read(tmp_path: Path, profiles: Mapping[str, FormatProfile]) -> Callable[..., RawFile]:
    """Write content to a file and read it back as a raw table."""

    def read(content: str | bytes, name: str = "test.csv", **options: Any) -> RawFile:
        path = tmp_path / name
        path.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)
        return read_raw(path, profiles, **options)

    return read


@pytest.fixture
def coupon() -> Callable[..., Specimen]:
    """A 0° tension coupon of 10 mm²; fields can be replaced."""

    def coupon(**fields: Any) -> Specimen:
        standard: dict[str, Any] = {
            "specimen": "A-1",
            "test": "tension",
            "material": "cfrp",
            "orientation_deg": 0,
            "width_mm": (10.0,),
            "thickness_mm": (1.0,),
            "gauge_length_mm": 50.0,
            "force_file": "test.csv",
        }
        return Specimen(**(standard | fields))

    return coupon
