from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.ingest import Ingested, ingest_specimen, load_profiles
from nptcs.reduce import reduce_record
from nptcs.tables.laboratory.specimens import Specimen

ROOT = Path(__file__).resolve().parents[3]


def specimen(name: str = "T0-1", test: str = "tension", **changes: Any) -> Specimen:
    rubber = test.startswith("rubber")
    fields: dict[str, Any] = {
        "specimen": name,
        "test": test,
        "material": "rubber_75A" if rubber else "cfrp",
        "orientation_deg": None if rubber else {"shear": 45.0}.get(test, 0.0),
        "width_mm": (6.0,) if rubber else (15.0, 15.0, 15.0),
        "thickness_mm": (2.0,) if rubber else (1.0, 1.0, 1.0),
        "gauge_length_mm": 25.0 if rubber else None,
        "force_file": f"{name}.csv",
    }
    return Specimen(**(fields | changes))


def curve(strain: Any, stress: Any, transverse: Any = np.nan, **columns: Any) -> pd.DataFrame:
    """A tidy curve of one square millimetre, 120 s long unless times are given."""
    strain = np.asarray(strain, dtype=float)
    table = {
        "time_s": np.linspace(0.0, 120.0, len(strain)),
        "force_n": stress,
        "stress_mpa": stress,
        "strain_axial": strain,
        "strain_transverse": transverse,
        "strain_axial_back": np.nan,
    }
    return pd.DataFrame(table | columns).astype(float)


class Bench:
    """Invented exports, and what the tests of whole specimens share."""

    labcases = ROOT / "tests" / "unit" / "labcases"
    settings = ReductionSettings()
    need_failure = ("strength", "ultimate_strain", "time_to_failure")

    @staticmethod
    def export(folder: Path, time: Any, force: Any, strain: Any, name: str = "raw.csv") -> str:
        """Write a plain export: time in s, force in N, strain in %."""
        table = {"Time (s)": time, "Load (N)": force, "Axial strain (%)": 100 * np.asarray(strain)}
        pd.DataFrame(table).to_csv(folder / name, index=False, float_format="%.8g")
        return name

    @staticmethod
    def laminate(strain: Any, modulus: float = 125000.0, area: float = 15.0) -> Any:
        return modulus * np.asarray(strain) * area

    @staticmethod
    def assert_not_assessed(table: pd.DataFrame, names: Sequence[str], words: str) -> None:
        for name in names:
            assert np.isnan(table.loc[name, "value"]), name
            assert "not assessed: " in table.loc[name, "flags"], name
            assert words in table.loc[name, "flags"], (name, table.loc[name, "flags"])


@pytest.fixture(scope="session")
def bench() -> Bench:
    return Bench()


@pytest.fixture(scope="session")
def profiles() -> Any:
    return load_profiles(ROOT / "config" / "formats")


@pytest.fixture
def run(profiles: Any) -> Callable[..., tuple[pd.DataFrame, Specimen, Any]]:
    """Ingest and reduce a file: the properties by name, the specimen, what the ingest made."""

    def go(folder: Path, name: str = "X-1", test: str = "tension", **fields: Any) -> Any:
        one = specimen(name, test, **fields)
        done: Ingested = ingest_specimen(one, folder, IngestSettings(), profiles)
        table = reduce_record(done.curve, one, done.record, Bench.settings)
        return table.set_index("property"), one, done

    return go


@pytest.fixture
def make_specimen() -> Callable[..., Specimen]:
    return specimen


@pytest.fixture
def make_curve() -> Callable[..., pd.DataFrame]:
    return curve


@pytest.fixture
def value_of() -> Callable[[pd.DataFrame, str], float]:
    def get(table: pd.DataFrame, name: str) -> float:
        (value,) = table.loc[table["property"] == name, "value"]
        return float(value)

    return get


@pytest.fixture
def flags_of() -> Callable[[pd.DataFrame, str], str]:
    def get(table: pd.DataFrame, name: str) -> str:
        (flags,) = table.loc[table["property"] == name, "flags"]
        return str(flags)

    return get
