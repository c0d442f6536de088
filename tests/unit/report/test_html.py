"""The page as a reader's browser gets it."""

import re
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

from nptcs.report.factor_labels import SYMBOLS
from nptcs.report.html import render_report
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.analysis.surface import SurfaceQuality, SurfaceTable
from nptcs.tables.tyres.cases import Cases

IDENTIFIERS = [
    "sensitivity",
    "published_stiffness",
    "lca",
    "spoke",
    "surfaces",
    "materials",
    "specimens",
    "design",
    "cases",
    "provenance",
]


class Page(HTMLParser):
    """What the tests look at: tags, addresses, ids and all text."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.addresses, self.ids, self.words = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.addresses += [value for name, value in attrs if name in ("src", "href")]
        self.ids += [value for name, value in attrs if name == "id"]

    def handle_data(self, data):
        self.words.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


@pytest.fixture(scope="module")
def html(results):
    return render_report(results)


@pytest.fixture(scope="module")
def page(html):
    return Page(html)


@pytest.fixture
def undrawn(monkeypatch):
    """Build all figures, but do not draw them, which takes most of the time."""
    monkeypatch.setattr("nptcs.report.drawing.to_svg", lambda figure: "<svg/>")


@pytest.fixture
def faulty_html(faulty, undrawn):
    return render_report(faulty)


def table_after(html, caption):
    """Read the rows of the table with that caption, as text."""
    start = re.search(rf"<(strong|summary)>{re.escape(caption)}", html).start()
    body = html[html.index("<tbody>", start) : html.index("</tbody>", start)]
    rows = re.findall(r"<tr[^>]*>(.*?)</tr>", body, re.S)
    return [
        [re.sub("<[^>]*>", "", cell) for cell in re.findall(r"<td.*?</td>", row, re.S)]
        for row in rows
    ]


def test_the_page_needs_nothing_but_itself(html, page):
    assert all(address.startswith(("data:image/svg+xml", "#")) for address in page.addresses)
    assert not {"link", "iframe", "object"} & set(page.tags)
    assert "@import" not in html
    assert set(re.findall(r"url\((.)", html)) <= {"#"}  # figures refer to their own parts
    assert len(html.encode()) < 10e6


def test_the_page_is_the_same_in_each_run(results, undrawn):
    assert render_report(results) == render_report(results)


def test_all_sections_are_there_and_linked(page):
    assert [name for name in page.ids if name in IDENTIFIERS] == IDENTIFIERS
    assert {f"#{name}" for name in IDENTIFIERS} <= set(page.addresses)


def test_the_verdict_comes_first(page):
    words = page.text
    assert "No problems: all 78 cases solved; 2 of 3 specimens used (1 left out" in words
    assert words.index("No problems") < words.index("How stiff is the tyre?")


def test_titles_and_messages_are_text_not_markup(html, faulty_html):
    assert "A title &lt;b&gt;&amp;" in html
    assert "step 7 &lt;cut back&gt; 5 times" in faulty_html


def test_every_problem_is_at_the_top(faulty_html):
    head = faulty_html[: faulty_html.index('<div class="findings">')]
    assert "2 problems: 77 of 78 cases solved; 1 of 3 specimens used" in head
    assert "diverged" in head
    assert "T0-1.csv:12, column &#39;Force&#39;: not a number" in head
    assert "unsound" in head
    assert "unsound" not in faulty_html[len(head) :]


def test_stray_files_are_pointed_out_at_the_top_and_notes_are_not(page):
    head, rest = page.text.split("Worth knowing", 1)[1].split("Sensitivity", 1)
    assert "No row of the sheet names these files in the folder: notes.txt " in head
    assert "README" not in head
    assert "README.md note" in rest


def test_no_line_breaks_between_a_number_and_its_percent_sign(html):
    facts = "".join(re.findall(r"<dd>(.*?)</dd>", html, re.S))
    assert re.search(r"\d\u00a0%", facts)
    assert " %" not in facts


def test_synthetic_data_carry_the_badge_and_measured_ones_do_not(html, measured, undrawn):
    assert html.count('<span class="badge">SYNTHETIC DATA</span>') > 10
    assert "SYNTHETIC" not in render_report(measured)


def test_published_studies_are_not_called_synthetic(html):
    surfaces = html[html.index('<section id="surfaces">') : html.index('<section id="materials">')]
    assert "badge" not in surfaces


@pytest.mark.parametrize("study", ["plate", "rubber"])
def test_a_reader_can_evaluate_the_surface_from_the_page(html, results, study):
    rows = table_after(html, f"Response surfaces of the study {study}: coefficients")
    cases = results.table(Cases)[results.table(Cases)["study"] == study]
    value = np.zeros(len(cases))
    for _, term, natural, *_ in rows:
        product = np.ones(len(cases))
        for part in [] if term == "1" else term.split(" × "):
            symbol = part.rstrip("²³")
            power = {"": 1, "²": 2, "³": 3}[part[len(symbol) :]]
            (name,) = (name for name, one in SYMBOLS.items() if one.name == symbol)
            product *= cases[name].to_numpy() ** power
        value += float(natural) * product
    surface = results.surfaces[study]["published"]
    factors = cases[list(surface.polynomial.factors)].to_numpy(float)
    np.testing.assert_allclose(value, surface.predict(factors), atol=1e-5)


def test_printed_values_are_next_to_ours(html):
    rows = table_after(html, "Average gradients and comprehensive impact values, by every rule")
    spacing = next(row for row in rows if row[2] == "plate spacing S")
    assert "54.93" in spacing
    assert {row[3] for row in rows} == {
        "domain mean absolute",
        "design mean absolute",
        "domain mean signed",
    }


def test_a_study_without_a_surface_says_so(results, undrawn):
    quality, impact = results.table(SurfaceQuality), results.table(Impact)
    without = replace(
        results,
        surfaces={**results.surfaces, "plate": {}},
        tables={
            **results.tables,
            "plate_surface.csv": results.table(SurfaceTable, "plate")[:0],
            "surface_quality.csv": quality[quality["study"] != "plate"],
            "impact.csv": impact[impact["study"] != "plate"],
        },
    )
    assert "No surface could be fitted to the study plate" in render_report(without)
