"""Each how-to page works when it is followed to the letter, in a copy of the project."""

import importlib.util
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
HOW_TO = ROOT / "docs" / "how-to"


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


@pytest.mark.parametrize("page", sorted(HOW_TO.glob("add-*.md")), ids=lambda page: page.stem)
def test_the_page_can_be_followed(page, tree):
    pages.follow(page, tree)
