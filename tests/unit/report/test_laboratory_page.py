"""A laboratory's own page: cover, logo, signatures, its own templates."""

import struct
import zlib
from dataclasses import replace
from pathlib import Path

import pytest
import yaml

from nptcs.archive.contents import study_inputs
from nptcs.config.laboratory import Laboratory
from nptcs.config.root import read_config
from nptcs.errors import InputError
from nptcs.language import language
from nptcs.report.cover import cover_lines
from nptcs.report.html import render_report
from nptcs.report.logo import LARGEST_BYTES, logo_uri
from nptcs.report.page_files import page_faults
from nptcs.report.page_templates import clear_template_errors, page_environment, template_faults

ROOT = Path(__file__).parents[3]
LABORATORY = {
    "name": "Tyre lab",
    "address": "1 Street\nTown",
    "customer": "A & B <Ltd>",
    "operator": "O. Perator",
    "report_number": "R-17",
    "dates": {"Specimens received": "2026-03-02", "Shipped": "2026-04-17"},
    "signatures": [{"role": "Tested by", "name": "O. Perator"}, {"role": "Approved by"}],
}
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 1"><path d="M0 0"/></svg>'


def chunk(kind, data):
    body = kind + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))


PNG = (
    b"\x89PNG\r\n\x1a\n"
    + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
    + chunk(b"IDAT", zlib.compress(b"\x00\x7f"))
    + chunk(b"IEND", b"")
)


def written(path, content):
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def cover(folder=None, **changes):
    """Render the head of the page alone."""
    laboratory = Laboratory.model_validate({**LABORATORY, **changes})
    with language(laboratory.language), clear_template_errors(folder):
        content = {
            "settings": {"title": "T"},
            "laboratory": laboratory,
            "logo": "",
            "cover": cover_lines(laboratory),
            "synthetic": False,
        }
        return page_environment(folder).get_template("cover.html.j2").render(content)


def test_the_head_says_who_for_whom_and_when():
    page = cover()
    for text in ("Tyre lab", "A &amp; B &lt;Ltd&gt;", "R-17", "Shipped", "2026-04-17"):
        assert text in page
    assert "<Ltd>" not in page


def test_names_are_translated_and_what_the_catalogue_lacks_stays():
    page = cover(language="zh")
    assert "客户" in page
    assert "收样日期" in page
    assert "Shipped" in page
    assert "Customer" not in page


def test_a_laboratory_that_gives_nothing_has_no_cover():
    laboratory = Laboratory()
    assert cover_lines(laboratory) == ()
    assert not laboratory.has_cover
    assert Laboratory(customer="A").has_cover


@pytest.mark.parametrize("dates", [{"Report": "17.4.2026"}, {"": "2026-04-17"}, {"Report": "soon"}])
def test_a_text_that_is_not_a_date_is_refused(dates, config):
    values = config.model_dump(mode="json") | {"laboratory": {"dates": dates}}
    with pytest.raises(InputError, match="laboratory"):
        read_config(values)


def test_an_unknown_language_is_refused(config):
    values = config.model_dump(mode="json") | {"laboratory": {"language": "de"}}
    with pytest.raises(InputError, match=r"laboratory\.language"):
        read_config(values)


def test_a_png_and_an_svg_are_recognised_by_their_content(tmp_path):
    assert logo_uri(written(tmp_path / "a", PNG)).startswith("data:image/png;base64,")
    assert logo_uri(written(tmp_path / "b", SVG)).startswith("data:image/svg+xml;base64,")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"GIF89a", "neither PNG nor SVG"),
        (b"\xff\xd8\xff\xe0JFIF", "neither PNG nor SVG"),
        ("<html/>", "neither PNG nor SVG"),
        (b"", "neither PNG nor SVG"),
        (PNG[:40], "this PNG is damaged"),
        (PNG.replace(b"IDAT", b"IDAX"), "this PNG is damaged"),
        (b"\x89PNG\r\n\x1a\n" + b"0" * LARGEST_BYTES, "more than 500,000"),
        (SVG.replace("<path", '<image href="https://x/y.png"/><path'), "needs another file"),
        (SVG.replace("<path", "<script>1</script><path"), "contains an element <script>"),
        ('<!DOCTYPE s [<!ENTITY a "b">]>' + SVG, "declares entities"),
    ],
)
def test_a_logo_that_cannot_be_shown_is_refused_with_its_file(tmp_path, content, said):
    file = written(tmp_path / "logo.png", content)
    with pytest.raises(InputError, match=said) as refusal:
        logo_uri(file)
    assert refusal.value.file == file
    assert refusal.value.remedy


def test_logo_and_templates_are_inputs_that_are_checked_and_archived(tmp_path):
    written(tmp_path / "logo.svg", SVG)
    (tmp_path / "mine").mkdir()
    written(tmp_path / "mine/cover.html.j2", "<p>{% if %}</p>")
    values = yaml.safe_load((ROOT / "config/config.yaml").read_text("utf-8"))
    values["laboratory"] = {"logo": str(tmp_path / "logo.svg")}
    values["report"] = {"templates": str(tmp_path / "mine")}
    changed = read_config(values)
    named = {tmp_path / "logo.svg", tmp_path / "mine/cover.html.j2"}
    assert {Path(name) for name in changed.page_inputs()} == named
    assert named <= set(study_inputs(ROOT, changed))
    (fault,) = page_faults(changed)
    assert (fault.file, fault.line) == (tmp_path / "mine/cover.html.j2", 1)
    (tmp_path / "logo.svg").unlink()
    assert [fault.message for fault in page_faults(changed)][1:] == ["this logo does not exist"]


def test_an_own_template_is_used_and_the_others_are_the_packages(tmp_path):
    written(tmp_path / "cover.html.j2", "<h1>MINE {{ laboratory.name }}</h1>")
    assert cover(str(tmp_path)) == "<h1>MINE Tyre lab</h1>"
    (tmp_path / "cover.html.j2").unlink()
    assert cover(str(tmp_path)) == cover()


def test_a_template_can_build_on_the_packages(tmp_path):
    own = 'BEFORE{% include "nptcs/cover.html.j2" %}AFTER'
    written(tmp_path / "cover.html.j2", own)
    page = cover(str(tmp_path))
    assert page.startswith("BEFORE")
    assert page.endswith("AFTER")
    assert "R-17" in page


@pytest.mark.parametrize(
    ("own", "line", "said"),
    [
        ("<p>\n{% if %}\n</p>", 2, "Expected an expression"),
        ("<p>\n\n{{ nobody }}</p>", 3, "'nobody' is undefined"),
        ("<p>\n{{ laboratory.naem }}</p>", 2, "naem"),
        ('<p>\n{% include "none.html.j2" %}', 2, "there is no template none.html.j2"),
        ("<p>\n{{ 1 + laboratory.name }}", 2, "unsupported operand"),
    ],
)
def test_a_broken_template_names_file_and_line(tmp_path, own, line, said):
    file = written(tmp_path / "cover.html.j2", own)
    with pytest.raises(InputError, match=said) as refusal:
        cover(str(tmp_path))
    assert (Path(refusal.value.file), refusal.value.line) == (file, line)
    assert "the package's own is then used" in refusal.value.remedy


def test_a_template_that_nothing_uses_is_named(tmp_path):
    written(tmp_path / "covr.html.j2", "x")
    (fault,) = template_faults(str(tmp_path))
    assert "no template of the report has this name" in str(fault)
    assert "cover.html.j2" in fault.remedy
    written(tmp_path / "cover.html.j2", '{% include "covr.html.j2" %}')
    assert template_faults(str(tmp_path)) == []
    (missing,) = template_faults(str(tmp_path / "none"))
    assert "this folder does not exist" in str(missing)


def test_the_page_carries_logo_cover_and_signatures(results, tmp_path):
    values = results.config.model_dump(mode="json")
    values["laboratory"] = {**LABORATORY, "logo": str(written(tmp_path / "l.svg", SVG))}
    page = render_report(replace(results, config=read_config(values)))
    assert 'src="data:image/svg+xml;base64,' in page
    assert '<html lang="en">' in page
    assert page.index("<main") < page.index("R-17") < page.index("Approved by")
