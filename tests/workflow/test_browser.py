"""The report in a real browser: all figures are drawn, and nothing is wider than the screen."""

import pytest
from chromium import CHROMIUM, MISSING, browser

SHOWN = """() => {
  for (const folded of document.querySelectorAll("main details")) folded.open = true;
  const figures = [...document.querySelectorAll(".plot svg")];
  const drawn = (svg) => svg.getBoundingClientRect().height > 50 && svg.querySelector("path");
  const broken = figures.filter((svg) => !drawn(svg)).length;
  return [innerWidth, document.documentElement.scrollWidth, broken, figures.length];
}"""


@pytest.mark.skipif(CHROMIUM is None, reason=MISSING)
@pytest.mark.parametrize("width", [390, 1280])
def test_the_report_fits_the_screen_and_draws_every_figure(finished, width):
    with browser(width) as tab:
        tab.open(finished.path("results/report.html").as_uri())
        inner, scrolled, broken, figures = tab.value(SHOWN)
    assert inner == width
    assert scrolled <= width
    assert broken == 0
    assert figures > 10
