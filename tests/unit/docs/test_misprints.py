"""The page of misprints states what the published tables give."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.laminate import abd
from nptcs.surface.fit import fit
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
from nptcs.terms import parse

ROOT = Path(__file__).parents[3]
PUBLISHED = ROOT / "raw_data" / "published"
FACTORS = {
    5: ["spacing_mm", "thickness_mm", "angle_deg"],
    7: ["shear_band_c10_mpa", "spoke_c10_mpa"],
}
RESPONSE = "stiffness_n_per_mm"


@pytest.fixture(scope="module")
def page():
    return (ROOT / "docs" / "misprints.md").read_text("utf-8")


def table(number):
    (file,) = PUBLISHED.glob(f"table{number}_*.csv")
    return pd.read_csv(file, dtype={"term": str})


def misses(design_table, coefficient_table, factor_of_last=1.0):
    """Return the largest residual of the printed and of the fitted coefficients, N/mm."""
    design, printed = table(design_table), table(coefficient_table)
    factors, terms = FACTORS[design_table], list(printed["term"])
    coefficients = printed["coefficient"].to_numpy().copy()
    coefficients[-1] *= factor_of_last
    x = design[factors].to_numpy(float)
    surface = fit(design, design[RESPONSE], factors, terms)
    values = parse(terms, factors).matrix(x) @ coefficients, surface.predict(x)
    largest = [float(np.abs(value - design[RESPONSE]).max()) for value in values]
    return *largest, np.asarray(surface.coefficients_natural, float)


def test_table_6_has_lost_a_factor_and_its_decimals(page):
    printed, fitted, coefficients = misses(5, 6, factor_of_last=1e-5)
    assert table(6)["coefficient"].iloc[-1] == 9.52
    assert f"{coefficients[-1]:.3e}" == "9.523e-05"
    assert f"up to {printed:.1f} N/mm; the least-squares surface by at most {fitted:.1f}" in page


def test_table_8_is_not_the_least_squares_surface_of_table_7(page):
    printed, fitted, coefficients = misses(7, 8)
    assert ", ".join(f"{c:.3f}" for c in coefficients[:3]) in page
    assert f"up to {printed:.1f} N/mm, the fitted one by {fitted:.1f} N/mm" in page


def test_table_9_was_multiplied_with_more_digits():
    rows = table(9)
    product = rows["gradient"] * rows["range"]
    lost = rows["impact"] - product
    assert lost.between(-0.005, 0.01 * rows["range"] + 0.005).all()
    assert not np.allclose(product, rows["impact"], atol=0.005)


def test_table_10_is_partly_cut_off_and_partly_rounded(page):
    rows, tyre = table(10), TyreGeometry()
    arc = 2 * np.pi * tyre.band_radius_mm / tyre.spoke_count
    k = rows["tension_stiffness_n_per_mm"] / arc
    j = rows["compression_stiffness_n_per_mm"] / arc
    assert f"{k[4]:.3f} and {j[0]:.3f}: cut off; the first k, {k[0]:.3f}, is rounded" in page
    assert (rows["k_n_per_mm2"][4], rows["j_n_per_mm2"][0]) == (4.16, 0.41)
    assert rows["k_n_per_mm2"][0] == 0.95


def test_tables_7_and_11_differ_in_one_digit():
    seven, eleven = table(7), table(11)
    stiffest = seven[seven["shear_band_c10_mpa"] == 5][RESPONSE].to_numpy()
    difference = stiffest - eleven["fem_stiffness_n_per_mm"].to_numpy()
    assert difference.round(2).tolist() == [0, 0, 0, 0, 0.01]


def test_the_section_is_bent_about_the_wrong_axis(page):
    tyre = TyreGeometry()
    height = (tyre.outer_wire_diameter_mm - tyre.inner_wire_diameter_mm) / 2
    width = tyre.tread_width_mm
    assert height * width**3 / 12 == pytest.approx(1.035e7, rel=1e-3)
    assert f"{width * height**3 / 12:.2e}".replace("e+04", "e4") in page
    assert (width * height, width * tyre.shear_band_thickness_mm) == (2687.5, 3010)


def test_two_layers_at_45_degrees_are_not_isotropic(page):
    compliance = np.linalg.inv(abd(PUBLISHED_PLY, 45, 1.8)[:3, :3]) * 1.8
    along = 1 / compliance[0, 0]
    # strain at 45° under stress at 45°: half a stress in 1, in 2 and in shear
    half = np.full(3, 0.5)
    across = 1 / (half @ compliance @ half)
    assert f"{along / 1000:.1f} GPa along the plate and {across / 1000:.1f} GPa at 45°" in page


def test_the_ply_is_not_transversely_isotropic(page):
    isotropic = PUBLISHED_PLY["e2_mpa"] / (2 * (1 + PUBLISHED_PLY["nu23"]))
    assert f"{isotropic:.0f} MPa" in page
    assert PUBLISHED_PLY["g23_mpa"] == 2300


def test_table_7_passes_through_the_fiducial_case(page):
    seven, five = table(7), table(5)
    line = seven[seven["shear_band_c10_mpa"] == 5]
    fiducial = five.set_index("case")[RESPONSE][32]
    c10 = np.interp(fiducial, line[RESPONSE], line["spoke_c10_mpa"])
    assert c10 == pytest.approx(1.04, abs=0.006)
    assert f"{fiducial} N/mm" in page
