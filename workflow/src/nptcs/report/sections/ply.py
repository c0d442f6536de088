"""Which ply the solvers were given, in words, and how it differs from table 2 of the paper."""

from __future__ import annotations

from nptcs.language import tr
from nptcs.report.data import Results
from nptcs.report.tables.headings import words
from nptcs.report.text import joined, number_text
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY


def ply_words(results: Results) -> str:
    """Name the ply of the solvers that need one, and how it differs from table 2.

    Empty where no solver needs a ply.
    """
    solvers = [name for name, facts in results.solvers.items() if facts.needs_ply]
    if not solvers:
        return ""
    sentences = []
    named = {study.ply for study in results.config.studies if study.ply is not None}
    for ply in results.card.plies.values():
        if named and ply.name not in named:
            continue
        parts = []
        for name, quantity in ply.constants.items():
            unit = "" if quantity.unit == "1" else f" {quantity.unit}"
            change = 100 * (quantity.value / PUBLISHED_PLY[name] - 1)
            parts.append(
                f"{words(name.removesuffix('_mpa'))} {number_text(quantity.value, 4)}{unit} "
                f"({change:+.1f} %)"
            )
        origin = tr(" (SYNTHETIC data)") if ply.synthetic else ""
        sentences.append(
            tr(
                "The ply of {solvers} is {ply} of the material card{origin}, not the one printed "
                "in the paper; in brackets the difference from table 2: {differences}.",
                solvers=joined(solvers),
                ply=ply.name,
                origin=origin,
                differences=", ".join(parts),
            )
        )
    return " ".join(sentences)
