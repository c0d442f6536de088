"""What the head of report and workbook says about a laboratory, its customer and its dates."""

from __future__ import annotations

from nptcs.config.laboratory import Laboratory
from nptcs.language import tr, translatable

NAMED = {
    "customer": translatable("Customer"),
    "operator": translatable("Operator"),
    "report_number": translatable("Report number"),
}
"""Keys of the section `laboratory`, as they are written for a reader."""

USUAL_DATES = (
    translatable("Specimens received"),
    translatable("Tests"),
    translatable("Report"),
)
USUAL_ROLES = (
    translatable("Tested by"),
    translatable("Checked by"),
    translatable("Approved by"),
)
"""Names that laboratories give to dates and signatures, translated where the catalogue has them."""


def cover_lines(laboratory: Laboratory) -> tuple[tuple[str, str], ...]:
    """List what is known about a report, name and text, in the language of the run."""
    given = [(tr(name), getattr(laboratory, key)) for key, name in NAMED.items()]
    dates = [(tr(name), day.isoformat()) for name, day in laboratory.dates.items()]
    return tuple((name, text) for name, text in [*given, *dates] if text)
