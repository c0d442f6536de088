"""The report: one HTML file that needs no network, no script and no other file."""

from __future__ import annotations

from importlib import resources

from markupsafe import Markup

from nptcs.language import language
from nptcs.report.cover import cover_lines
from nptcs.report.data import Results
from nptcs.report.figures.theme import theme_css
from nptcs.report.logo import logo_uri
from nptcs.report.page_templates import clear_template_errors, page_environment
from nptcs.report.plots import finish_figures
from nptcs.report.sections.plan import build_sections
from nptcs.report.sections.summary import summary_blocks
from nptcs.report.tables.sheets import sheets_of


def render_report(results: Results) -> str:
    """Write all results as one HTML page.

    The page depends on the results alone: the same results give the same page.

    Parameters
    ----------
    results : Results
        Everything that a run has made.

    Returns
    -------
    str
        HTML text, UTF-8, with styles and figures inside.
    """
    with language(results.config.laboratory.language):
        return _page(results)


def _page(results: Results) -> str:
    """Write the page in the language of the run."""
    laboratory, templates = results.config.laboratory, results.config.report.templates
    sheets = sheets_of(results)
    content = dict(
        settings=results.config.report,
        laboratory=laboratory,
        logo=logo_uri(laboratory.logo) if laboratory.logo else "",
        cover=cover_lines(laboratory),
        sound=results.verdict()[0],
        synthetic=results.any_synthetic,
        summary=summary_blocks(results, sheets),
        sections=build_sections(results, sheets),
        style=_resource("report.css"),
        script=_resource("page.js"),
        figure_theme=Markup(theme_css()),
        figure_style=_resource("figures.css"),
        figure_script=_resource("figures.js"),
    )
    finish_figures()
    with clear_template_errors(templates):
        return page_environment(templates).get_template("report.html.j2").render(content)


def _resource(name: str) -> Markup:
    """Read a file that belongs to the template and goes into the page as it is."""
    return Markup(resources.files("nptcs.report").joinpath("templates", name).read_text("utf-8"))
