"""The page is accessible: axe-core in a real browser, light and dark; keyboard; print."""

import pytest
from axe_check import CHROMIUM, NO_CHROMIUM, chromium, opened, violations

from nptcs.report.html import render_report

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason=NO_CHROMIUM)


@pytest.fixture(scope="module")
def browser():
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def file(compared, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "report.html"
    path.write_text(render_report(compared), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def faulty_file(faulty, tmp_path_factory):
    path = tmp_path_factory.mktemp("faulty") / "report.html"
    path.write_text(render_report(faulty), encoding="utf-8")
    return path


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("name", ["file", "faulty_file"])
def test_axe_finds_no_barrier(browser, request, name, scheme, width):
    with opened(browser, request.getfixturevalue(name), scheme, width) as (page, said):
        assert violations(page) == []
        assert said == []


def test_axe_finds_a_barrier_where_there_is_one(browser, file, tmp_path):
    spoilt = tmp_path / "spoilt.html"
    text = file.read_text("utf-8")
    spoilt.write_text(text.replace("--soft: #595959", "--soft: #b9b9b9"), encoding="utf-8")
    with opened(browser, spoilt) as (page, _):
        assert any("color-contrast" in line for line in violations(page))


def test_the_colours_that_a_reader_chooses_are_kept(browser, file):
    ground = "getComputedStyle(document.body).backgroundColor"
    context = browser.new_context(color_scheme="light")
    page = context.new_page()
    page.goto(file.as_uri())
    light = page.evaluate(ground)
    page.get_by_role("button", name="Colours: system").press("Enter")
    dark = page.evaluate(ground)
    assert dark != light
    page.reload()
    assert page.evaluate(ground) == dark
    page.emulate_media(media="print")
    assert page.evaluate(ground) == light
    context.close()


def test_a_column_is_sorted_with_the_keyboard(browser, file):
    with opened(browser, file) as (page, _):
        head = page.locator("#published_stiffness th.number").first
        head.locator("button").press("Enter")
        assert head.get_attribute("aria-sort") == "ascending"
        values = head.evaluate(
            "head => [...head.closest('table').tBodies[0].rows]"
            ".map(row => Number(row.cells[head.cellIndex].dataset.n))"
        )
        assert values == sorted(values)


def test_on_a_phone_a_section_is_found_in_the_menu(browser, file):
    with opened(browser, file, width=390) as (page, _):
        page.get_by_text("Sections", exact=True).click()
        page.locator(".menu a", has_text="Materials").click()
        assert page.evaluate("location.hash") == "#materials"
        assert not page.locator(".menu ol").is_visible()
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        assert page.locator("#materials h2").evaluate("h => h.getBoundingClientRect().top") < 120
