"""Every table of the results: what it says, which rule made it, and from what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from nptcs.report.units import Heading

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
    """

    sheet: str
    title: str
    file: str
    rule: str
    source: str
    headings: Mapping[str, Heading] = field(default_factory=dict)

    def with_headings(self, headings: Mapping[str, Heading]) -> Entry:
        """Return the same entry for a view of it that has columns of its own."""
        return replace(self, headings={**self.headings, **headings})


PROBLEMS = Entry(
    "problems",
    "Problems: everything that gave no result, and why",
    "results/tables/problems.csv",
    "problems",
    "specimen sheet, ingest records, reduction, case records and surface fits",
)
SHEET = Entry(
    "specimen_sheet",
    "Specimen sheet: what the laboratory states of each specimen",
    "the specimen sheet of the configuration",
    "(input)",
    "written by the laboratory; the area is mean width × mean thickness",
)
FILES = Entry(
    "files",
    "Every file of the laboratory's folder and what became of it",
    "results/tables/files.csv",
    "account",
    "the folder of the specimen sheet and the ingest records",
)
CONDITIONING = Entry(
    "conditioning",
    "How each curve came about: strain source, conditioning, flags",
    "results/1_ingest/*.json",
    "ingest",
    "raw files, format profiles and the section `ingest` of the configuration",
)
SPECIMENS = Entry(
    "specimens",
    "Properties of each specimen",
    "results/tables/specimens.csv",
    "reduce, statistics",
    "the specimens' curves, by the rule and the range in each row",
)
STATISTICS = Entry(
    "statistics",
    "Statistics of each group of specimens",
    "results/tables/statistics.csv",
    "statistics",
    "the properties of the specimens that the sheet includes",
)
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
MODELS = Entry(
    "hyperelastic_models",
    "Hyperelastic models compared",
    "results/tables/hyperelastic_models.csv",
    "calibrate_rubber, material_card",
    "the rubber curves; the study's model is the one on the card",
)
RANGES = Entry(
    "c10_against_range",
    "C10 against the strain range of the fit",
    "results/tables/c10_against_range.csv",
    "calibrate_rubber, material_card",
    "the rubber curves, neo-Hookean fits to growing ranges",
)
CASES = Entry(
    "cases",
    "Every case of every study: how it ended and its responses",
    "results/tables/cases.csv",
    "solve, cases",
    "one record a case; wall time is that of the run that solved the case",
)
QUALITY = Entry(
    "surface_quality",
    "How well each response surface follows its cases",
    "results/tables/surface_quality.csv",
    "surface, sensitivity",
    "the solved cases and the surfaces fitted to them",
    QUALITY_HEADINGS,
)
IMPACT = Entry(
    "impact",
    "Average gradients and comprehensive impact values, by every rule",
    "results/tables/impact.csv",
    "sensitivity",
    "the response surfaces; printed values are those of table 9",
    IMPACT_HEADINGS,
)
SPOKE_STIFFNESS = Entry(
    "spoke_stiffness",
    "Stiffness of single spokes, computed and table 10",
    "results/tables/spoke_stiffness.csv",
    "spoke_stiffness",
    "the single spokes' curves, lines through the origin; printed values are those of table 10",
    SPOKE_HEADINGS,
)
SPOKE_CURVES = Entry(
    "spoke_curves",
    "Force–displacement curves of single spokes (figure 13)",
    "results/tables/spoke_curves.csv",
    "spoke_stiffness",
    "the records of the single spokes",
)
AGAINST_PUBLISHED = Entry(
    "stiffness_against_published",
    "Computed vertical stiffness beside the published one, case by case",
    "results/tables/stiffness_against_published.csv",
    "against_published",
    "cases.csv; published values are those that the solver `published` looked up",
)
STIFFNESS_ERRORS = Entry(
    "stiffness_errors",
    "Differences from the published stiffness, blind cases apart from calibrated ones",
    "results/tables/stiffness_errors.csv",
    "against_published",
    "stiffness_against_published.csv, summed up",
    {"compared": Heading("cases compared"), "largest_case_id": Heading("case of the largest")},
)
STIFFNESS_BY_LEVEL = Entry(
    "stiffness_by_level",
    "Main effects and differences by level of each factor",
    "results/tables/stiffness_by_level.csv",
    "against_published",
    "stiffness_against_published.csv, averaged over the cases at each level",
    LEVEL_HEADINGS,
)
NEUTRAL_LINE = Entry(
    "neutral_line",
    "Displacement of the band's neutral line, every solver (figure 14)",
    "results/tables/neutral_line.csv",
    "neutral_line",
    "the records of the cases that the studies' neutral_line_cases names",
)
LCA_VALIDATION = Entry(
    "lca_validation",
    "The load-bearing model (LCA) against the published numbers",
    "results/tables/lca_validation.csv",
    "lca_validation",
    "the model solved with table 10's spokes; printed values are those of tables 7 and 11",
)
LCA_AGAINST_FEM = Entry(
    "lca_against_fem",
    "The load-bearing model (LCA) against the FE stiffness of table 7",
    "results/tables/lca_against_fem.csv",
    "lca_validation",
    "the model solved for the cases of table 7; FE values as printed there",
)
LCA_SHAPE = Entry(
    "lca_shape",
    "Deformed neutral line of the shear band, LCA",
    "results/tables/lca_shape.csv",
    "lca_validation",
    "the same solutions of the model, evaluated along the ring",
)
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
    return Entry(
        f"surface_{study}"[:31],
        f"Response surfaces of the study {study}: coefficients",
        f"results/tables/{study}_surface.csv",
        "surface",
        "solved cases, ordinary least squares in coded units, expanded to natural units",
        SURFACE_HEADINGS,
    )
