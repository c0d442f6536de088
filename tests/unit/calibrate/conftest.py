from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.tables.laboratory.specimens import Specimen


def rubber(name: str = "R-1", test: str = "rubber_tension", **changes: Any) -> Specimen:
    fields: dict[str, Any] = {
        "specimen": name,
        "test": test,
        "material": "rubber_75A",
        "width_mm": (6.0,),
        "thickness_mm": (2.0,),
        "gauge_length_mm": 25.0,
        "force_file": f"{name}.csv",
    }
    return Specimen(**(fields | changes))


def ply(name: str, test: str, angle: float, **changes: Any) -> Specimen:
    fields: dict[str, Any] = {
        "specimen": name,
        "test": test,
        "material": "cfrp",
        "orientation_deg": angle,
        "width_mm": (15.0,),
        "thickness_mm": (1.0,),
        "force_file": f"{name}.csv",
    }
    return Specimen(**(fields | changes))


def curve(strain: Any, stress: Any) -> pd.DataFrame:
    strain = np.asarray(strain, dtype=float)
    table = {
        "time_s": np.linspace(0.0, 10.0, len(strain)),
        "force_n": 12.0 * np.asarray(stress),
        "stress_mpa": stress,
        "strain_axial": strain,
        "strain_transverse": np.nan,
        "strain_axial_back": np.nan,
    }
    return pd.DataFrame(table).astype(float)


@pytest.fixture
def make_rubber() -> Callable[..., Specimen]:
    return rubber


@pytest.fixture
def make_ply() -> Callable[..., Specimen]:
    return ply


@pytest.fixture
def make_curve() -> Callable[..., pd.DataFrame]:
    return curve
