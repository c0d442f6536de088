from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from nptcs.arrays import Array
from nptcs.config.materials.ingest import IngestSettings
from nptcs.ingest import Ingested, ingest_specimen
from nptcs.ingest.reading.profiles import FormatProfile, load_profiles
from nptcs.ingest.reading.raw_file import RawFile, read_raw
from nptcs.tables.laboratory.specimens import Specimen

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


class Lab:
    """Ingests small invented files as a laboratory would, and measures the results."""

    cases = ROOT / "tests" / "unit" / "labcases"

    def __init__(self, profiles: Mapping[str, FormatProfile]) -> None:
        self.profiles = profiles

    def ingest(self, folder: Path, force_file: str, **fields: Any) -> Ingested:
        """Ingest a file as a coupon of 10 mm², unless the fields say otherwise."""
        standard: dict[str, Any] = {
            "specimen": "S",
            "test": "tension",
            "material": "m",
            "orientation_deg": 0,
            "width_mm": (10.0,),
            "thickness_mm": (1.0,),
            "force_file": force_file,
        }
        specimen = Specimen(**(standard | fields))
        return ingest_specimen(specimen, folder, IngestSettings(), self.profiles)

    @staticmethod
    def modulus(done: Ingested, low: float = 0.001, high: float = 0.003) -> float:
        """Least-squares slope of stress over strain, independent of the reduction."""
        strain, stress = done.curve["strain_axial"], done.curve["stress_mpa"]
        used = (strain.abs() >= low) & (strain.abs() <= high)
        return float(np.polyfit(strain[used], stress[used], 1)[0])

    @staticmethod
    def last_strain(done: Ingested) -> float:
        """Strain in the row of the largest force; NaN if none was measured there."""
        row = done.curve["stress_mpa"].abs().idxmax()
        return float(done.curve.loc[row, "strain_axial"])

    @staticmethod
    def flagged(done: Ingested, text: str) -> bool:
        """Tell whether a flag of the record contains a text."""
        return any(text in flag for flag in done.record.flags)

    @staticmethod
    def write(
        path: Path,
        columns: Mapping[str, Sequence[float] | Array],
        delimiter: str = ",",
        decimal: str = ".",
        head: Sequence[str] = (),
        encoding: str = "utf-8",
    ) -> Path:
        """Write columns of numbers under their names."""
        lines = [*head, delimiter.join(columns)]
        for row in zip(*columns.values(), strict=True):
            lines.append(delimiter.join(f"{value:.9g}".replace(".", decimal) for value in row))
        path.write_text("\n".join(lines) + "\n", encoding=encoding)
        return path


@pytest.fixture(scope="session")
def lab(profiles: Mapping[str, FormatProfile]) -> Lab:
    return Lab(profiles)
