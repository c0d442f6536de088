"""Every table of the report and the workbook: what it says, which rule made it, and from what.

Tables of ``results/tables`` are those of `nptcs.tables.catalogue`; here they get their headings.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import pandera.pandas as pa

from nptcs.report.tables.headings import Heading
from nptcs.tables.catalogue import TABLES

IMPACT_HEADINGS = {
    "gradient": Heading("gradient", "N/mm per unit of the factor"),
    "range": Heading("range", "unit of the factor"),
    "impact": Heading("impact", "N/mm"),
    "published_gradient": Heading("printed gradient", "N/mm per unit of the factor"),
    "published_impact": Heading("printed impact", "N/mm"),
    "difference_percent": Heading("difference", "%"),
    "published_rank": Heading("printed rank"),
}
SURFACE_HEADINGS = {
    "coefficient_natural": Heading("coefficient, natural", "N/mm per unit of the term"),
    "coefficient_coded": Heading("coefficient, coded", "N/mm"),
    "standard_error": Heading("standard error, natural", "N/mm per unit of the term"),
    "standard_error_coded": Heading("standard error, coded", "N/mm"),
    "published_coefficient": Heading("printed coefficient (FE)", "N/mm per unit of the term"),
}
SPOKE_HEADINGS = {
    f"{prefix}{direction}_r2{suffix}": Heading(f"{prefix.replace('_', ' ')}{direction} R²{kind}")
    for direction in ("tension", "compression")
    for prefix, suffix, kind in (
        ("", "_uncentred", ", uncentred"),
        ("", "_centred", ", centred"),
        ("published_", "", ""),
    )
}
LEVEL_HEADINGS = {
    "level": Heading("level", "unit of the factor"),
    "compared": Heading("cases compared"),
}
QUALITY_HEADINGS = {
    "residual_sd": Heading("residual SD", "N/mm"),
    "largest_residual": Heading("largest residual", "N/mm"),
}


@dataclass(frozen=True)
class Entry:
    """One table.

    Parameters
    ----------
    sheet : str
        Name of its sheet in the workbook, 31 characters at most.
    title : str
        What it says.
    file : str
        Its file among the results, or the file that it is taken from.
    rule : str
        Snakemake rule that made it.
    source : str
        What the rule made it from, and how.
    headings : mapping of str to Heading
        Headings of columns whose names do not state the unit.
    contract : type of DataFrameModel, optional
        Contract of its columns, which says what they mean.
    """

    sheet: str
    title: str
    file: str
    rule: str
    source: str
    headings: Mapping[str, Heading] = field(default_factory=dict)
    contract: type[pa.DataFrameModel] | None = None

    def with_headings(self, headings: Mapping[str, Heading]) -> Entry:
        """Return the same entry for a view of it that has columns of its own."""
        return replace(self, headings={**self.headings, **headings})


def _entry(name: str, headings: Mapping[str, Heading] | None = None) -> Entry:
    """Return the entry of a table of ``results/tables``; its sheet is named as its file."""
    table = TABLES[name]
    return Entry(
        name.removesuffix(".csv"),
        table.title,
        f"results/tables/{name}",
        table.rule,
        table.source,
        headings or {},
        table.contract,
    )


PROBLEMS = _entry("problems.csv")
SHEET = Entry(
    "specimen_sheet",
    "Specimen sheet: what the laboratory states of each specimen",
    "the specimen sheet of the configuration",
    "(input)",
    "written by the laboratory; the area is mean width × mean thickness",
)
FILES = _entry("files.csv")
CONDITIONING = Entry(
    "conditioning",
    "How each curve came about: strain source, conditioning, flags",
    "results/1_ingest/*.json",
    "ingest",
    "raw files, format profiles and the section `ingest` of the configuration",
)
SPECIMENS = _entry("specimens.csv")
STATISTICS = _entry("statistics.csv")
PLY = Entry(
    "ply_constants",
    "Constants of the orthotropic ply",
    "results/material_card.json",
    "calibrate_ply, material_card",
    "the specimens in each row by the rule in each row; assumptions from the configuration",
)
RUBBERS = Entry(
    "rubber_constants",
    "Hyperelastic constants of the rubbers",
    "results/material_card.json",
    "calibrate_rubber, material_card",
    "the specimens in each row, within the strain range in each row",
    {
        "strain_low": Heading("strain range from", "1"),
        "strain_high": Heading("strain range to", "1"),
    },
)
MODELS = _entry("hyperelastic_models.csv")
RANGES = _entry("c10_against_range.csv")
CASES = _entry("cases.csv")
QUALITY = _entry("surface_quality.csv", QUALITY_HEADINGS)
IMPACT = _entry("impact.csv", IMPACT_HEADINGS)
SPOKE_STIFFNESS = _entry("spoke_stiffness.csv", SPOKE_HEADINGS)
SPOKE_CURVES = _entry("spoke_curves.csv")
STIFFNESS_AGAINST_PUBLISHED = _entry("stiffness_against_published.csv")
STIFFNESS_ERRORS = _entry(
    "stiffness_errors.csv",
    {"compared": Heading("cases compared"), "largest_case_id": Heading("case of the largest")},
)
STIFFNESS_BY_LEVEL = _entry("stiffness_by_level.csv", LEVEL_HEADINGS)
NEUTRAL_LINE = _entry("neutral_line.csv")
LCA_VALIDATION = _entry("lca_validation.csv")
LCA_AGAINST_FEM = _entry("lca_against_fem.csv")
LCA_SHAPE = _entry("lca_neutral_line.csv")
SOFTWARE = Entry(
    "software",
    "Software that built the report",
    "(the environment)",
    "report",
    "installed versions",
)
INPUTS = Entry(
    "published_inputs",
    "Published and configured input files with their SHA-256",
    "(the files named)",
    "report",
    "files that the configuration names; raw laboratory files stand in the table `files`",
)


def design_entry(study: str) -> Entry:
    """Return the entry of a study's design table."""
    return Entry(
        f"design_{study}"[:31],
        f"Design table of the study {study}",
        f"results/4_design/{study}.csv",
        "design",
        "factors and levels of the configuration, full factorial",
    )


def surface_entry(study: str) -> Entry:
    """Return the entry of a study's table of coefficients."""
    entry = _entry("STUDY_surface.csv", SURFACE_HEADINGS)
    return replace(
        entry,
        sheet=f"surface_{study}"[:31],
        title=entry.title.replace("STUDY", study),
        file=entry.file.replace("STUDY", study),
    )
