"""What the figures show, read from their axes."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex
from matplotlib.ticker import MaxNLocator

from nptcs.report.factor_labels import factor_labels
from nptcs.report.figures.impact import impact_bars, ranked
from nptcs.report.figures.lca import deformed_ring, load_displacement
from nptcs.report.figures.materials import hyperelastic_fit
from nptcs.report.figures.specimens import DRAWN_POINTS, evenly_spaced, stress_strain
from nptcs.report.figures.style import to_svg
from nptcs.report.figures.surface import (
    LEVELS,
    STIFFNESS,
    contours,
    middle_level,
    round_levels,
    slices,
)
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.io import empty_table
from nptcs.tables.published.lca_validation import LcaNeutralLine, LcaValidation
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.displacement_by_load import DisplacementByLoad
from nptcs.tables.tyres.neutral_line import NeutralLine


@pytest.fixture
def plate(results, config):
    study = config.study("plate")
    cases = results.table(Cases)[results.table(Cases)["study"] == "plate"]
    return results.surfaces["plate"]["published"], cases, factor_labels(study)


def lines(figure):
    return {line.get_label(): line for line in figure.axes[0].get_lines()}


def test_an_svg_has_no_date_and_is_the_same_in_each_run(results):
    figures = [stress_strain("cfrp", results.curves, ["T0-2"], True) for _ in range(2)]
    first, second = (to_svg(figure) for figure in figures)
    assert first == second
    assert "<dc:date>" not in first


def test_specimens_left_out_are_dashed_and_say_so(results):
    figure = stress_strain("cfrp", results.curves, ["T0-2"])
    drawn = lines(figure)
    assert drawn["T0-2 (left out)"].get_linestyle() == "--"
    assert drawn["T0-1"].get_linestyle() == "-"
    assert figure.axes[0].get_ylabel() == "nominal stress [MPa]"
    np.testing.assert_allclose(drawn["T0-1"].get_xdata().max(), 1.0)  # percent


def test_only_synthetic_curves_are_marked(results):
    marked, plain = (stress_strain("cfrp", results.curves, [], flag) for flag in (True, False))
    assert [text.get_text() for text in marked.axes[0].texts] == ["SYNTHETIC DATA"]
    assert not plain.axes[0].texts


def test_thinning_keeps_the_ends_and_the_peak():
    strain = np.linspace(0, 1, 5001)
    stress = np.where(np.arange(5001) == 3333, 9.0, strain)
    curve = evenly_spaced(pd.DataFrame({"strain_axial": strain, "stress_mpa": stress}))
    assert len(curve) <= DRAWN_POINTS + 1
    assert curve["stress_mpa"].max() == 9.0
    assert (curve["strain_axial"].iloc[0], curve["strain_axial"].iloc[-1]) == (0, 1)


def test_a_curve_without_strain_is_not_drawn():
    nothing = pd.DataFrame({"strain_axial": [np.nan], "stress_mpa": [5.0]})
    assert not stress_strain("cfrp", {"T0-1": nothing}, []).axes[0].get_lines()


def test_the_model_is_full_in_its_range_and_dotted_beyond(results):
    figure = hyperelastic_fit(
        "rubber",
        {"R75-1": results.curves["R75-1"]},
        lambda stretch: stretch - 1,
        "model",
        (0, 0.15),
    )
    _, inside, beyond = figure.axes[0].get_lines()
    assert (inside.get_linestyle(), beyond.get_linestyle()) == ("-", ":")
    np.testing.assert_allclose([inside.get_xdata()[-1], beyond.get_xdata()[-1]], [15, 30])


def test_contours_show_the_cases_at_the_middle_level(plate):
    surface, cases, labels = plate
    figure = contours(surface, cases, ("spacing_mm", "thickness_mm"), labels)
    points = figure.axes[0].collections[-1].get_offsets()
    assert len(points) == 9
    assert figure.axes[0].get_title(loc="left") == "Stiffness, published\nat fibre angle A 45°"
    assert figure.axes[0].get_xlabel() == "plate spacing S [mm]"
    shown = figure.axes[0].collections[-1].get_array()
    expected = cases[cases["angle_deg"] == 45][STIFFNESS]
    np.testing.assert_allclose(np.sort(shown), np.sort(expected))


def test_lines_of_a_contour_map_are_named_readably_off_the_marks(plate):
    surface, cases, labels = plate
    figure = contours(surface, cases, ("spacing_mm", "angle_deg"), labels)
    axes = figure.axes[0]
    filled, marks = axes.collections[0], axes.collections[-1].get_offsets()
    (low, high), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    named = [text for text in axes.texts if text.get_text().isdigit()]
    assert len(named) > 3
    for text in named:
        x, y = text.get_position()
        assert 0.1 <= (x - low) / (high - low) <= 0.9
        assert 0.1 <= (y - bottom) / (top - bottom) <= 0.9
        away = np.hypot((marks[:, 0] - x) / (high - low), (marks[:, 1] - y) / (top - bottom))
        assert away.min() > 0.06, text.get_text()
        ground = filled.cmap(filled.norm(float(text.get_text())))
        brightness = np.dot(ground[:3], (0.2126, 0.7152, 0.0722))
        assert (to_hex(text.get_color()) == "#111111") == (brightness > 0.55), text.get_text()
    assert {to_hex(text.get_color()) for text in named} == {"#111111", "#ffffff"}


def test_curves_are_named_below_their_panel(results):
    curves = {name: results.curves["T0-2"] for name in ("T0-1", "T0-2", "a longer name-1")}
    figure = stress_strain("cfrp", curves, [])
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == list(curves)
    assert figure.axes[0].get_legend() is None  # no modulus is drawn


def test_slices_are_the_surface(plate):
    surface, cases, labels = plate
    figure = slices(surface, cases, ("angle_deg", "spacing_mm"), labels)
    curve, marks = figure.axes[0].get_lines()[:2]
    x = curve.get_xdata()
    points = np.column_stack([np.full_like(x, 10), np.full_like(x, 1.8), x])
    np.testing.assert_allclose(curve.get_ydata(), surface.predict(points))
    at_level = cases[(cases["spacing_mm"] == 10) & (cases["thickness_mm"] == 1.8)]
    np.testing.assert_array_equal(marks.get_ydata(), at_level[STIFFNESS])


@pytest.mark.parametrize(("levels", "middle"), [([1, 3, 2], 2), ([4, 1], 1), ([5, 5, 5], 5)])
def test_middle_level(levels, middle):
    assert middle_level(levels) == middle


def test_impact_bars_are_the_table(results, config):
    rules = config.sensitivity.rules
    keys = ranked(results.table(Impact), rules[0])
    figure = impact_bars(results.table(Impact), dict(zip(keys, "abcde", strict=True)), rules)
    axes = figure.axes[0]
    assert [label.get_text() for label in axes.get_yticklabels()] == list("abcde")
    table = results.table(Impact).set_index(["rule", "study", "factor"])["impact"]
    for rule, bars in zip(rules, axes.containers, strict=True):
        widths = [bar.get_width() for bar in bars]
        np.testing.assert_allclose(widths, [table[(rule, *key)] for key in keys])
    published = axes.get_lines()[0].get_xdata()
    np.testing.assert_allclose(published, [319.83, 54.93, 38.60, 21.91, 15.97])


def test_the_ring_stands_on_the_ground(results):
    shape = results.table(LcaNeutralLine)
    figure = deformed_ring(shape, 431.8, empty_table(NeutralLine))
    drawn = lines(figure)
    lowest = np.nanmin(drawn["LCA, contact"].get_ydata())
    assert lowest == pytest.approx(shape["y_mm"].min())
    assert np.nanmin(drawn["LCA, tension"].get_ydata()) > lowest
    assert figure.axes[0].get_aspect() == 1


def test_displacements_are_lines_by_rubber_with_the_printed_ones_on_them(results):
    table = results.table(LcaValidation)
    table = table[table["section"] == "sandwich"].sample(frac=1, random_state=1)
    drawn = lines(load_displacement(table, empty_table(DisplacementByLoad)))
    rubbers = [f"{c10:g}" for c10 in sorted(set(table["spoke_c10_mpa"]))]
    assert set(rubbers) <= set(drawn)
    assert len({drawn[c10].get_color() for c10 in rubbers}) == len(rubbers)
    soft = table[table["spoke_c10_mpa"] == table["spoke_c10_mpa"].min()].sort_values("load_n")
    np.testing.assert_array_equal(drawn[rubbers[0]].get_xdata(), soft["load_n"])
    np.testing.assert_array_equal(drawn[rubbers[0]].get_ydata(), soft["displacement_mm"])


@pytest.mark.parametrize("low", [0.0, 217.3, -1e-3, 4.0])
@pytest.mark.parametrize("span", [0.0123, 3.0, 86.0, 4e5])
def test_levels_are_those_of_matplotlib(low, span):
    theirs = MaxNLocator(LEVELS, steps=[1, 2, 2.5, 5, 10]).tick_values(low, low + span)
    ours = round_levels(low, low + span, LEVELS)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * span)


def test_levels_of_one_value_enclose_it():
    for value in (0.0, 300.0):
        levels = round_levels(value, value, LEVELS)
        assert levels[0] <= value <= levels[-1]
        assert len(levels) > 1
