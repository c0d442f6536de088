"""Figures saved in a real browser: SVG, PNG of 300 dots per inch, CSV with the table's values."""

import base64
import io
import re
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest
from chromium import CHROMIUM, MISSING, browser
from PIL import Image

from nptcs.report.drawing import csv_of
from nptcs.report.html import render_report
from nptcs.report.plots import packed
from nptcs.report.svg import VARIABLES
from nptcs.tables.published.lca_validation import LcaValidation

PICKED = "displacement-against-load-lca-sandwich-section"
SAVED = """async () => {
  const made = {}, saved = {};
  URL.createObjectURL = ((before) => (blob) => {
    const address = before.call(URL, blob);
    made[address] = blob;
    return address;
  })(URL.createObjectURL);
  HTMLAnchorElement.prototype.click = function () { saved[this.download] = made[this.href]; };
  for (const button of document.querySelectorAll(".plot button")) button.click();
  const end = performance.now() + 60000;
  while (Object.keys(saved).length < 3 && performance.now() < end)
    await new Promise((done) => setTimeout(done, 50));
  const told = {};
  for (const [name, blob] of Object.entries(saved)) {
    const bytes = new Uint8Array(await blob.arrayBuffer());
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    told[name] = btoa(text);
  }
  return told;
}"""

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason=MISSING)


def one_figure(page):
    """Keep styles, one figure and the scripts of a page: a browser has it at once."""
    styles = re.findall(r"<style.*?</style>", page, re.S)
    plot = re.search(rf'<div class="plot" data-name="{PICKED}".*?</svg></div>', page, re.S)
    scripts = re.findall(r"<script(?: data-[^>]*)?>.*?</script>", page, re.S)
    return "<!doctype html><meta charset=utf-8>" + "".join([*styles, plot[0], *scripts])


@pytest.fixture(scope="module")
def saved(results, tmp_path_factory):
    page = tmp_path_factory.mktemp("saved") / "page.html"
    page.write_text(one_figure(render_report(results)), encoding="utf-8")
    with browser() as tab:
        tab.open(page.as_uri())
        found = tab.value(SAVED)
        titles = tab.value("[...document.querySelectorAll('.plot button')].map((b) => b.title)")
        assert [title.split(":")[0] for title in titles] == [
            "Save as SVG",
            "Save as PNG",
            "Save the numbers",
        ]
        assert tab.complaints == []
    return {name.rsplit(".", 1)[1]: base64.b64decode(text) for name, text in found.items()}


def test_a_click_saves_each_kind(saved):
    assert set(saved) == {"svg", "png", "csv"}


def test_the_png_has_300_dots_per_inch_and_shows_the_figure(saved):
    image = Image.open(io.BytesIO(saved["png"]))
    assert image.info["dpi"] == pytest.approx((300, 300), abs=0.1)
    assert image.size[0] == pytest.approx(4.3 * 300, abs=3)
    pixels = np.asarray(image.convert("RGB")).reshape(-1, 3)
    assert (pixels[0] == 255).all()  # on a white ground
    assert len(np.unique(pixels, axis=0)) > 50


def test_the_svg_stands_alone(saved):
    text = saved["svg"].decode()
    root = ElementTree.fromstring(text)
    assert "var(" not in text
    assert any(colour in text for colour in VARIABLES)
    assert "vertical load [N]" in "".join(root.itertext())


def test_the_csv_is_the_table(saved, results):
    assert saved["csv"].startswith(b"\xef\xbb\xbf")  # spreadsheets read it as UTF-8
    table = pd.read_csv(io.BytesIO(saved["csv"]))
    mine = results.table(LcaValidation)
    mine = mine[mine["section"] == "sandwich"].reset_index(drop=True)
    for name, column in {
        "load_n": "load_n",
        "spoke_c10_mpa": "spoke_c10_mpa",
        "lca_displacement_mm": "displacement_mm",
        "published_lca_displacement_mm": "published_displacement_mm",
    }.items():
        np.testing.assert_allclose(table[name], mine[column], rtol=1e-5)


def test_numbers_are_packed_small():
    table = pd.DataFrame({"x_mm": np.linspace(0, 1, 500), "force_n": np.arange(500.0)})
    assert len(packed(csv_of(table))) < 0.6 * len(csv_of(table))
    assert packed("") == ""


def test_figures_of_a_page_are_small(results):
    page = render_report(results)
    figures = re.findall(r'<div class="plot".*?</svg></div>', page, re.S)
    assert len(figures) > 15
    assert max(map(len, figures)) < 40_000
    assert sum(map(len, figures)) / len(figures) < 15_000
