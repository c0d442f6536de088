"""Every link of the docs leads to a file or heading that exists."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)


def anchors(page):
    """Return the anchors that GitHub makes of a page's headings."""
    headings = (
        heading.lower().replace("`", "") for heading in HEADING.findall(page.read_text("utf-8"))
    )
    return {re.sub(r"[^\w\- ]", "", heading).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for link in LINK.findall(page.read_text("utf-8")):
        if link.startswith(("http:", "https:")):
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        assert target.exists(), link
        if anchor:
            assert anchor in anchors(target), link


def test_the_index_names_every_page():
    index = ROOT / "docs" / "index.md"
    named = {
        (index.parent / link.partition("#")[0]).resolve()
        for link in LINK.findall(index.read_text("utf-8"))
    }
    assert set((ROOT / "docs").rglob("*.md")) - {index} <= named


NAMED_FILE = re.compile(r"`([\w/.-]+\.(?:py|smk|j2))`")
FILES = [
    f"/{file.relative_to(ROOT)}"
    for part in ("benchmarks", "docs", "recipe", "tests", "workflow")
    for file in (ROOT / part).rglob("*.*")
]
OWN_FILES = [page for page in PAGES if not page.name.startswith("add-")]


@pytest.mark.parametrize("page", OWN_FILES, ids=lambda page: str(page.relative_to(ROOT)))
def test_files_that_a_page_names_exist(page):
    named = NAMED_FILE.findall(page.read_text("utf-8"))
    assert [name for name in named if not any(f.endswith(f"/{name}") for f in FILES)] == []
