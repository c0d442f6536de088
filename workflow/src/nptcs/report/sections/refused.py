"""Published values that are not put next to a study, because their conditions differ."""

from __future__ import annotations

from nptcs.compare.conditions import plate_faults, surface_faults
from nptcs.config.studies.study import Study
from nptcs.language import tr
from nptcs.report.blocks import Text
from nptcs.report.data import Results
from nptcs.tables.solver_names import PUBLISHED


def refused_words(study: Study) -> str:
    """Say why published coefficients and impact values are not shown; empty where they are."""
    compares = study.published_coefficients or PUBLISHED in study.solvers
    faults = surface_faults(study) if compares and study.terms else []
    if not faults:
        return ""
    return tr(
        "Study {study}: the paper's coefficients and impact values are not shown next to ours: "
        "{reasons}.",
        study=study.name,
        reasons="; ".join(faults),
    )


def refused_stiffness_words(study: Study) -> str:
    """Say why the published stiffness is not compared with a study's; empty where it is."""
    faults = plate_faults(study) if PUBLISHED in study.solvers else []
    if not faults:
        return ""
    return tr(
        "Study {study}: its stiffness is not compared with the paper's: {reasons}.",
        study=study.name,
        reasons="; ".join(faults),
    )


def all_refused(results: Results) -> list[str]:
    """Collect the reasons of all studies."""
    said = [
        words(study)
        for study in results.config.studies
        for words in (refused_words, refused_stiffness_words)
    ]
    return [text for text in said if text]


def refused_blocks(study: Study) -> list[Text]:
    """Write the reason as a paragraph in the section on the study's surfaces."""
    words = refused_words(study)
    return [Text(words, "warn")] if words else []
