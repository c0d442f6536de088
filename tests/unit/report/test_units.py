"""Headings are read from column names."""

import pytest

from nptcs.report.tables.headings import heading
from nptcs.tables.column_headings import IMPACT


@pytest.mark.parametrize(
    ("column", "written"),
    [
        ("vertical_stiffness_n_per_mm", "vertical stiffness [N/mm]"),
        ("spoke_c10_mpa", "spoke C10 [MPa]"),
        ("k_n_per_mm2", "k [N/mm²]"),
        ("area_mm2", "area [mm²]"),
        ("load_n", "load [N]"),
        ("theta_c_deg", "θc [°]"),
        ("theta_t_difference_percent", "θt difference [%]"),
        ("leave_one_out_r_squared", "leave one out R²"),
        ("wall_time_s", "wall time [s]"),
        ("specimen", "specimen"),
        ("n", "n"),
        ("specimens", "specimens"),
    ],
)
def test_the_unit_comes_from_the_name(column, written):
    assert str(heading(column)) == written


def test_a_fixed_heading_wins():
    assert str(heading("impact", IMPACT)) == "impact [N/mm]"
