"""The check of the built site finds links that lead nowhere and files from a network."""

import importlib.util
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[3] / "docs" / "check_site.py"
SOUND = """<link href="site.css" rel="stylesheet"><h1 id="top">Top</h1>
<a href="#top">up</a> <a href="sub/other.html#part">part</a> <a href="https://example.org">else</a>"""


@pytest.fixture(scope="module")
def check_site():
    spec = importlib.util.spec_from_file_location("check_site", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def site(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "site.css").write_text("")
    (tmp_path / "index.html").write_text(SOUND)
    (tmp_path / "sub" / "other.html").write_text('<h2 id="part">Part</h2><a href="../index.html">')
    return tmp_path


def test_a_sound_site_has_no_faults(check_site, site):
    assert check_site.faults(site) == []


@pytest.mark.parametrize(
    ("wrong", "fault"),
    [
        ('<a href="gone.html">', "leads to no file"),
        ('<img src="images/gone.png">', "leads to no file"),
        ('<a href="#gone">', "leads to no such heading"),
        ('<a href="sub/other.html#gone">', "leads to no such heading"),
        ('<script src="https://cdn.example.org/x.js"></script>', "loads https://cdn.example.org"),
        ('<link rel="stylesheet" href="//fonts.example.org/x.css">', "loads //fonts.example.org"),
    ],
)
def test_a_fault_is_found(check_site, site, wrong, fault):
    with (site / "index.html").open("a") as page:
        page.write(wrong)
    (found,) = check_site.faults(site)
    assert fault in found
