"""Open a page of the report in Chromium and let axe-core look for barriers (WCAG 2.2 A and AA)."""

import shutil
from contextlib import contextmanager
from pathlib import Path

import axe_playwright_python
from playwright.sync_api import sync_playwright

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
NO_CHROMIUM = "Chromium is not installed (Debian: chromium)"
AXE = Path(axe_playwright_python.__file__).with_name("axe.min.js")
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
LIMIT_MS = 300_000
"""The machine may be busy; what hangs still ends."""


@contextmanager
def chromium():
    """Start the browser that is installed; nothing is downloaded."""
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


@contextmanager
def opened(browser, file, scheme="light", width=1280):
    """Open a file; yields the page and what its console said."""
    said = []
    page = browser.new_page(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page.set_default_timeout(LIMIT_MS)
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(Path(file).as_uri(), timeout=LIMIT_MS)
    yield page, said
    page.close()


def violations(page):
    """Open all that is folded and run axe; one line per rule and first place that breaks it."""
    page.evaluate("document.querySelectorAll('main details').forEach((one) => (one.open = true))")
    page.evaluate(AXE.read_text("utf-8"))
    found = page.evaluate("rules => axe.run(document, {runOnly: rules})", RULES)["violations"]
    return [
        f"{one['id']} ({one['impact']}) at {len(one['nodes'])} places, first "
        f"{one['nodes'][0]['html'][:200]}: {one['nodes'][0]['failureSummary'][:300]}"
        for one in found
    ]
