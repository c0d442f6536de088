from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
import pytest

import nptcs.reduce
from nptcs.config.materials.reduction import AstmD412, ReductionSettings
from nptcs.tables.laboratory.properties import PropertiesTable

Make = Callable[..., Any]
# most curves here end at their largest force: the ingest saw the break
reduce_specimen = partial(nptcs.reduce.reduce_specimen, failure_seen=True)


def test_stress_at_elongation_strength_and_energy(
    make_specimen: Make, make_curve: Make, value_of: Make, flags_of: Make
) -> None:
    strain = np.linspace(0, 2.5, 2501)
    stretch = 1 + strain
    stress = 2 * 1.18 * (stretch - stretch**-2)
    curve = make_curve(strain, stress, time_s=np.linspace(0, 12.5, 2501))
    table = reduce_specimen(curve, make_specimen("R-1", "rubber_tension"), ReductionSettings())
    pd.testing.assert_frame_equal(PropertiesTable.validate(table), table)
    assert value_of(table, "stress_at_100_percent") == pytest.approx(2 * 1.18 * (2 - 0.25))
    assert np.isnan(value_of(table, "stress_at_300_percent"))
    assert "reaches 250 %" in flags_of(table, "stress_at_300_percent")
    assert value_of(table, "strength") == pytest.approx(stress[-1])
    assert value_of(table, "ultimate_strain") == pytest.approx(2.5)
    # W = C10 (λ² + 2/λ - 3): the energy in closed form; trapezoid error below 1e-6
    energy = 1.18 * (3.5**2 + 2 / 3.5 - 3)
    assert value_of(table, "strain_energy_density") == pytest.approx(energy, rel=1e-6)
    assert value_of(table, "strain_rate") == pytest.approx(12.0)


def test_speed_and_configured_elongations(
    make_specimen: Make, make_curve: Make, value_of: Make
) -> None:
    strain = np.linspace(0, 2.0, 201)
    settings = ReductionSettings(astm_d412=AstmD412(elongations_percent=(50.0,)))
    slow = make_curve(strain, strain, time_s=np.linspace(0, 600, 201))
    table = reduce_specimen(slow, make_specimen("R-1", "rubber_tension"), settings)
    assert value_of(table, "stress_at_50_percent") == pytest.approx(0.5)
    # 0.2 per minute over 25 mm
    assert table["flags"].str.contains("grows at 5 mm/min").all()


def test_iso_37_names_itself(make_specimen: Make, make_curve: Make) -> None:
    strain = np.linspace(0, 2.0, 201)
    settings = ReductionSettings(rubber_standard="iso_37")
    specimen = make_specimen("R-1", "rubber_tension", thickness_mm=(3.0,))
    table = reduce_specimen(make_curve(strain, strain), specimen, settings)
    assert table["rule"].str.startswith("ISO 37").all()
    assert table["flags"].str.contains("thickness 3 mm, ISO 37 recommends 1.8 to 2.2 mm").all()
