"""The tutorial and each how-to page work when followed to the letter, in a copy of the project."""

import importlib.util
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
DOCS = ROOT / "docs"
SAYS_SO = "is run by `tests/unit/docs/test_how_to.py`"
PAGES = [
    page
    for page in sorted(DOCS.rglob("*.md"))
    if SAYS_SO in " ".join(page.read_text("utf-8").split())
]


def load_pages():
    spec = importlib.util.spec_from_file_location(
        "how_to_pages", Path(__file__).with_name("pages.py")
    )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


pages = load_pages()


@pytest.fixture
def tree(tmp_path):
    leave = shutil.ignore_patterns("__pycache__", "*.egg-info")
    for name in ("config", "docs", "profiles", "raw_data", "workflow"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=leave)
    return tmp_path


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_page_can_be_followed(page, tree):
    pages.follow(page, tree)


def test_pages_that_say_so_are_followed():
    assert {"tutorial", "add-a-factor", "add-a-result-table"} <= {page.stem for page in PAGES}
