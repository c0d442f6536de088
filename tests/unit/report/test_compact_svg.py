"""SVG of the figures: the same picture in fewer characters, with real text and page colours."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties

from nptcs.report.figures.canvas import WideCanvas
from nptcs.report.figures.style import mark_synthetic, panel, styled, to_svg
from nptcs.report.figures.theme import DARK, LIGHT
from nptcs.report.svg import compact
from nptcs.report.svg_path import SEEN_PT, Stroke, distance, read_path, short, thinned, write_path

STEP = re.compile(r"([Mlhvcqz])|(-?(?:\d+\.?\d*|\.\d+))")


def absolute(text):
    """Read a written path again: the end of every step, in points."""
    places, here, command, numbers = [], np.zeros(2), "", []
    size = {"M": 2, "l": 2, "h": 1, "v": 1, "q": 4, "c": 6}
    for letter, number in STEP.findall(text):
        if letter:
            command, numbers = letter, []
            continue
        numbers.append(float(number))
        if len(numbers) == size[command]:
            step = {"h": [numbers[-1], 0], "v": [0, numbers[-1]]}.get(command, numbers[-2:])
            here = np.array(step, float) if command == "M" else here + step
            places.append(here)
            numbers = []
    return np.array(places)


points = st.lists(
    st.tuples(*[st.floats(-500, 500, allow_nan=False, width=32)] * 2), min_size=2, max_size=40
)


@given(points)
def test_a_path_is_written_to_a_hundredth_of_a_point(line):
    text = "M " + " L ".join(f"{x!r} {y!r}" for x, y in line)
    read = read_path(text)
    np.testing.assert_allclose(absolute(write_path(read)), np.array(line), atol=0.00501)


@given(points)
def test_no_point_that_is_left_out_can_be_seen(line):
    places = np.array(line)
    stroke = Stroke("M" + "L" * (len(line) - 1), tuple(point[None] for point in places))
    kept = np.vstack(thinned(stroke).points)
    away = [
        min(distance(place[None], *ends)[0] for ends in zip(kept, kept[1:], strict=False))
        for place in places
    ]
    assert max(away) <= SEEN_PT + 1e-9


def test_closed_pieces_and_curves_stay_what_they_are():
    text = "M 0 0 L 10 0 L 10 10 z M 1 1 C 1 2 3 4 5 6 Q 1 1 2 2"
    assert write_path(read_path(text)) == "M0 0h10v10zM1 1c0 1 2 3 4 5q-4-5-3-4"


@pytest.mark.parametrize(("cents", "text"), [(0, "0"), (-1, "-.01"), (250, "2.5"), (-1000, "-10")])
def test_numbers_are_as_short_as_they_can_be(cents, text):
    assert short(cents) == text


@styled
def drawn():
    figure, axes = panel("Stiffness <of> the tyre\nsecond line", "load [N]", "α [°]")
    axes.plot(np.linspace(0, 1, 400), np.linspace(0, 1, 400) ** 2, "o-", markevery=100, label="a")
    axes.axhspan(0.2, 0.4, color=LIGHT["--f-range"])
    axes.bar([0.2, 0.4], [0.3, 0.5], 0.1, hatch="///", color=LIGHT["--f0"])
    axes.set_xlim(0.1, 0.9)
    axes.legend()
    mark_synthetic(figure, True)
    return figure


@pytest.fixture(scope="module")
def pair():
    before = to_svg(drawn())
    return before, compact(before)


def words(svg):
    return [
        "".join(element.itertext())
        for element in ElementTree.fromstring(svg).iter()
        if element.tag.endswith("text")
    ]


def test_every_word_is_text(pair):
    before, after = pair
    assert sorted(words(after)) == sorted(words(before))
    assert {"load [N]", "α [°]", "SYNTHETIC DATA", "second line"} <= set(words(after))


def test_it_is_a_fraction_of_what_matplotlib_writes(pair):
    before, after = pair
    assert len(after) < len(before) / 3
    assert "matplotlib" not in after
    assert "<metadata" not in after


def test_every_reference_has_one_target(pair):
    after = pair[1]
    targets = re.findall(r'id="([^"]+)"', after)
    assert len(targets) == len(set(targets))
    assert set(re.findall(r"#(f[0-9a-f]+)", after)) == set(targets)


def test_colours_follow_the_page(pair):
    used = set(re.findall(r"var\((--[\w-]+)\)", pair[1]))
    assert {"--f0", "--f-ink", "--f-grid", "--f-range", "--f-warning"} <= used
    assert used <= set(LIGHT) & set(DARK)
    assert LIGHT["--f0"] not in pair[1]


def luminance(colour):
    parts = [int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5)]
    linear = [
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_colours_have_contrast_on_their_ground(theme):
    """WCAG 2.1: text 4.5, parts of graphics 3."""
    for name, colour in theme.items():
        if name in ("--f-grid", "--f-range", "--f-paper"):
            continue
        least = 4.5 if name in ("--f-ink", "--f-grey", "--f-warning") else 3.0
        assert contrast(colour, theme["--f-paper"]) >= least, name
        if name == "--f-ink":
            assert contrast(colour, theme["--f-range"]) >= 4.5


def width(words, **more):
    canvas = WideCanvas(Figure())
    size = canvas.get_renderer().get_text_width_height_descent
    return size(words, FontProperties(family="DejaVu Sans", size=10, **more), False)[0]


def test_chinese_characters_are_measured_as_wide_as_they_are_high():
    assert width("垂直刚度") == pytest.approx(4 * 10, rel=0.05)
    assert width("abc") == pytest.approx(width("abc垂") - width("垂"), rel=0.02)


@styled
def in_chinese():
    figure, axes = panel("垂直刚度与角度", "载荷 [N]", "刚度 [N/mm]")
    axes.barh([0, 1], [1, 2])
    axes.set_yticks([0, 1], ["辐条橡胶的弹性常数", "间距"])
    return figure


def test_chinese_labels_have_room_and_stay_text():
    svg = compact(to_svg(in_chinese()))  # a missing glyph would be a warning, so an error
    assert {"辐条橡胶的弹性常数", "垂直刚度与角度"} <= set(words(svg))
    place = re.search(r'x="([\d.]+)"[^>]*>辐条橡胶的弹性常数', svg)
    assert float(place[1]) > 9 * 9.5  # it ends there: nine characters fit to its left
