"""The report in a real browser: all figures are drawn, and nothing is wider than the screen."""

import re
import subprocess

import pytest
from headless_chromium import CHROMIUM, quiet

QUIET = quiet(10000)
TELL = """<script>addEventListener("load", () => {
  for (const folded of document.querySelectorAll("main details")) folded.open = true;
  const figures = [...document.querySelectorAll(".plot svg")];
  const drawn = (svg) => svg.getBoundingClientRect().height > 50 && svg.querySelector("path");
  const broken = figures.filter((svg) => !drawn(svg)).length;
  const root = document.documentElement;
  const found = [innerWidth, root.scrollWidth, broken, figures.length];
  parent.postMessage(found.join(" "), "*");
});</script>"""
FRAME = """<!doctype html><iframe src="report.html" style="width:{width}px;height:800px;border:0">
</iframe><script>addEventListener("message", (e) => {{ document.title = e.data; }});</script>"""


@pytest.mark.skipif(CHROMIUM is None, reason="Chromium is not installed (Debian: chromium)")
@pytest.mark.parametrize("width", [390, 1280])
def test_the_report_fits_the_screen_and_draws_every_figure(finished, tmp_path, width):
    report = finished.path("results/report.html").read_text(encoding="utf-8")
    (tmp_path / "report.html").write_text(report + TELL, encoding="utf-8")
    (tmp_path / "frame.html").write_text(FRAME.format(width=width), encoding="utf-8")
    profile = f"--user-data-dir={tmp_path / 'profile'}"
    page = subprocess.run(
        [CHROMIUM, *QUIET, profile, "--dump-dom", (tmp_path / "frame.html").as_uri()],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    ).stdout
    found = re.search(r"<title>(\d+) (\d+) (\d+) (\d+)</title>", page)
    assert found is not None, page[:500]
    inner, scrolled, broken, images = map(int, found.groups())
    assert inner == width
    assert scrolled <= width
    assert broken == 0
    assert images > 10
