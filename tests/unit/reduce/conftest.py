from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.tables.specimens import Specimen


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
