"""Published shear moduli of two silicones; the files are next to the repository."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.calibrate.fit import fit_model
from nptcs.calibrate.invariants import NEO_HOOKEAN
from nptcs.calibrate.observations import Observation

SILICONE = Path(__file__).resolve().parents[3] / ".." / "shared" / "labdata" / "silicone-d412"


@pytest.mark.parametrize(("name", "kpa"), [("Ecoflex 00-50", 22.0), ("Dragon Skin 30", 223.0)])
def test_shear_modulus_below_100_percent(name: str, kpa: float) -> None:
    path = SILICONE / f"{name}.csv"
    if not path.exists():
        pytest.skip("the laboratory files are not next to this repository (shared/labdata)")
    raw = pd.read_csv(path, sep=";", skiprows=18, header=None, encoding="latin-1")
    strain, stress = raw[3].to_numpy(float), raw[4].to_numpy(float)
    inside = strain <= 1.0
    observation = Observation(
        "S-1", "rubber_tension", 1 + strain[inside], stress[inside], np.ones(inside.sum())
    )
    fit = fit_model(NEO_HOOKEAN, [observation], 0.1)
    # published as "about": rounded to the last digit shown, and a little for the end of the range
    assert 2e3 * fit.constants[0] == pytest.approx(kpa, rel=0.025)
