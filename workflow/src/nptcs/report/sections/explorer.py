"""The explorer: sliders for the design, and what every stored surface says about it."""

from __future__ import annotations

from nptcs.language import tr
from nptcs.report.blocks import Interactive, Section, Text
from nptcs.report.data import Results
from nptcs.report.explorer.markup import explorer_markup
from nptcs.report.explorer.payload import explorer_payload
from nptcs.report.tables.sheets import Sheets
from nptcs.tables.result_table import ReportSection


def explorer_section(results: Results, sheets: Sheets) -> Section:
    """Build the explorer; a run without surfaces has none."""
    title = tr("Explore designs")
    payload = explorer_payload(results)
    if not payload["studies"]:
        return Section(ReportSection.EXPLORE, title, ())
    lead = tr(
        "On screen, move a slider, or click in a profile or in the plane: the page computes "
        "every value from the fitted surfaces of this run, without a network. Each study has its "
        "own models; a factor that a study holds fixed cannot be moved in it, and results of two "
        "studies are not multiplied."
    )
    without_script = tr("This part computes in the browser and needs scripts, which are off.")
    synthetic = any(
        solver["synthetic"] for study in payload["studies"] for solver in study["solvers"]
    )
    blocks = (Text(lead), Interactive(explorer_markup(payload, without_script)))
    return Section(ReportSection.EXPLORE, title, blocks, synthetic)
