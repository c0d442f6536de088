"""The report: one HTML file that needs no network, no script and no other file."""

from __future__ import annotations

from importlib import resources

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from nptcs.language import tr
from nptcs.report.blocks import macro_of
from nptcs.report.data import Results
from nptcs.report.figures.theme import theme_css
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
    sheets = sheets_of(results)
    return (
        page_environment()
        .get_template("report.html.j2")
        .render(
            settings=results.config.report,
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
    )


def page_environment() -> Environment:
    """Return what the page template is written with: `tr` and `macro_of` are known in it."""
    environment = Environment(
        loader=PackageLoader("nptcs.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals.update(tr=tr, macro_of=macro_of)
    return environment


def _resource(name: str) -> Markup:
    """Read a file that belongs to the template and goes into the page as it is."""
    return Markup(resources.files("nptcs.report").joinpath("templates", name).read_text("utf-8"))
