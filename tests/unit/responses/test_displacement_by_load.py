"""Displacements at figure 15's loads: read from curves, compared with the load-bearing model."""

import numpy as np
import pandas as pd
import pytest

from nptcs.responses.displacement_by_load import FIDUCIAL_PLATES, displacement_by_load
from nptcs.tables.io import check
from nptcs.tables.tyres.displacement_by_load import DisplacementByLoad

LOADS = (3000.0, 4000.0, 5000.0, 6000.0)
STIFFNESS = {1.0: 250.0, 2.0: 350.0}


def case(case_id, spoke, load, **other):
    values = {**FIDUCIAL_PLATES, "shear_band_c10_mpa": 5.0, "spoke_c10_mpa": spoke}
    row = {"solver": "fe_tyre", "case_id": case_id, "load_n": load, "realised_spacing_mm": 14.3}
    return {"study": "s", **row, **values, **other}


def curve(case_id, spoke, load, solver="fe_tyre"):
    force = np.linspace(0.0, load, 11)
    place = force / STIFFNESS[spoke] * (1 + 1e-6 * (load - force))
    rows = {"displacement_mm": place, "force_n": force}
    return pd.DataFrame({"study": "s", "case_id": case_id, "solver": solver, **rows})


@pytest.fixture
def validation():
    rows = [
        {
            "section": section,
            "spoke_c10_mpa": spoke,
            "load_n": load,
            "displacement_mm": 1.1 * load / STIFFNESS[spoke],
            "published_displacement_mm": 20.0 if load == 5000 else np.nan,
            "published_fem_stiffness_n_per_mm": 260.0 if load == 5000 else np.nan,
            "published_largest_error_percent": 7.49,
        }
        for section in ("sandwich", "printed")
        for spoke in STIFFNESS
        for load in LOADS
    ]
    return pd.DataFrame(rows)


def table(cases, curves, validation):
    rows = displacement_by_load(pd.DataFrame(cases), pd.concat(curves), validation, 5.0)
    return check(rows, DisplacementByLoad, "displacement_by_load.csv")


def test_the_case_with_the_largest_load_gives_all_loads(validation):
    cases = [case("a", 1.0, 5000.0), case("b", 1.0, 6000.0), case("c", 2.0, 5000.0)]
    curves = [curve("a", 1.0, 5000.0), curve("b", 1.0, 6000.0), curve("c", 2.0, 5000.0)]
    rows = table(cases, curves, validation).set_index(["spoke_c10_mpa", "load_n"])
    assert set(rows.loc[1.0, "case_id"]) == {"b"}
    assert rows.loc[(1.0, 6000.0), "displacement_mm"] == pytest.approx(24.0)
    assert rows.loc[(2.0, 6000.0), "status"] == "not reached"
    assert "5000 N" in rows.loc[(2.0, 6000.0), "note"]
    assert np.isnan(rows.loc[(2.0, 6000.0), "displacement_mm"])


def test_the_difference_is_that_of_the_stiffness_as_the_paper_takes_it(validation):
    rows = table([case("b", 1.0, 6000.0)], [curve("b", 1.0, 6000.0)], validation)
    row = rows[(rows["spoke_c10_mpa"] == 1.0) & (rows["load_n"] == 6000.0)].iloc[0]
    of_lca, of_fe = 6000 / row["lca_displacement_mm"], 6000 / row["displacement_mm"]
    assert row["lca_difference_percent"] == pytest.approx(100 * (of_lca - of_fe) / of_fe)
    at_table_11 = rows[rows["load_n"] == 5000.0].iloc[0]
    assert at_table_11["published_fem_displacement_mm"] == pytest.approx(5000 / 260)


@pytest.mark.parametrize(
    "other",
    [{"thickness_mm": 2.4}, {"shear_band_c10_mpa": 4.0}, {"realised_spacing_mm": np.nan}],
    ids=["other plates", "other band", "a solver without plates"],
)
def test_another_tyre_is_not_taken(validation, other):
    cases = [case("a", 1.0, 6000.0, **other), case("b", 2.0, 6000.0)]
    rows = table(cases, [curve("a", 1.0, 6000.0), curve("b", 2.0, 6000.0)], validation)
    mine = rows[rows["spoke_c10_mpa"] == 1.0]
    assert set(mine["status"]) == {"not assessed"}
    assert set(mine["case_id"]) == {""}


def test_studies_without_such_tyres_give_no_rows(validation):
    lonely = pd.DataFrame([{"study": "s", "solver": "lca", "case_id": "a", "spoke_c10_mpa": 1.0}])
    assert displacement_by_load(lonely, curve("a", 1.0, 5000.0), validation, 5.0).empty


def test_a_curve_of_too_few_points_is_not_assessed(validation):
    short = curve("b", 1.0, 6000.0).iloc[:3]
    rows = table([case("b", 1.0, 6000.0)], [short], validation)
    assert rows.loc[rows["spoke_c10_mpa"] == 1.0, "note"].str.contains("fewer than four").all()
