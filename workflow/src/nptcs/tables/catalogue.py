"""All result tables: file, contract, what each says, which rule made it, and from what.

This is the one list of them: the rules, the report, the workbook and the reference page take it.
"""

from dataclasses import dataclass

import pandera.pandas as pa

from nptcs.tables.cases import Cases
from nptcs.tables.files import Files
from nptcs.tables.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.impact import Impact
from nptcs.tables.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation
from nptcs.tables.neutral_line import NeutralLine
from nptcs.tables.problems import Problems
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.published_stiffness import (
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
)
from nptcs.tables.spoke_stiffness import SpokeCurves, SpokeLines
from nptcs.tables.statistics import StatisticsTable
from nptcs.tables.surface import SurfaceQuality, SurfaceTable


@dataclass(frozen=True)
class ResultTable:
    """One table.

    Parameters
    ----------
    contract : type of DataFrameModel
        Its columns.
    title : str
        What it says.
    rule : str
        Snakemake rules that made it.
    source : str
        What the rules made it from, and how.
    """

    contract: type[pa.DataFrameModel]
    title: str
    rule: str
    source: str


TABLES = {
    "files.csv": ResultTable(
        Files,
        "Every file of the laboratory's folder and what became of it",
        "account",
        "the folder of the specimen sheet and the ingest records",
    ),
    "specimens.csv": ResultTable(
        PropertiesTable,
        "Properties of each specimen",
        "reduce, statistics",
        "the specimens' curves, by the rule and the range in each row",
    ),
    "statistics.csv": ResultTable(
        StatisticsTable,
        "Statistics of each group of specimens",
        "statistics",
        "the properties of the specimens that the sheet includes",
    ),
    "hyperelastic_models.csv": ResultTable(
        ModelComparison,
        "Hyperelastic models compared",
        "calibrate_rubber, material_card",
        "the rubber curves; the study's model is the one on the card",
    ),
    "c10_against_range.csv": ResultTable(
        RangeTable,
        "C10 against the strain range of the fit",
        "calibrate_rubber, material_card",
        "the rubber curves, neo-Hookean fits to growing ranges",
    ),
    "cases.csv": ResultTable(
        Cases,
        "Every case of every study: how it ended and its responses",
        "solve, cases",
        "one record a case; wall time is that of the run that solved the case",
    ),
    "STUDY_surface.csv": ResultTable(
        SurfaceTable,
        "Response surfaces of the study STUDY: coefficients",
        "surface",
        "solved cases, ordinary least squares in coded units, expanded to natural units",
    ),
    "surface_quality.csv": ResultTable(
        SurfaceQuality,
        "How well each response surface follows its cases",
        "surface, sensitivity",
        "the solved cases and the surfaces fitted to them",
    ),
    "impact.csv": ResultTable(
        Impact,
        "Average gradients and comprehensive impact values, by every rule",
        "sensitivity",
        "the response surfaces; printed values are those of table 9",
    ),
    "spoke_stiffness.csv": ResultTable(
        SpokeLines,
        "Stiffness of single spokes, computed and table 10",
        "spoke_stiffness",
        "the single spokes' curves, lines through the origin; printed values are those of table 10",
    ),
    "spoke_curves.csv": ResultTable(
        SpokeCurves,
        "Force–displacement curves of single spokes (figure 13)",
        "spoke_stiffness",
        "the records of the single spokes",
    ),
    "stiffness_against_published.csv": ResultTable(
        StiffnessAgainstPublished,
        "Computed vertical stiffness beside the published one, case by case",
        "compare_published",
        "cases.csv; published values are those that the solver `published` looked up",
    ),
    "stiffness_errors.csv": ResultTable(
        StiffnessErrors,
        "Differences from the published stiffness, blind cases apart from calibrated ones",
        "compare_published",
        "stiffness_against_published.csv, summed up",
    ),
    "stiffness_by_level.csv": ResultTable(
        StiffnessByLevel,
        "Main effects and differences by level of each factor",
        "compare_published",
        "stiffness_against_published.csv, averaged over the cases at each level",
    ),
    "neutral_line.csv": ResultTable(
        NeutralLine,
        "Displacement of the band's neutral line, every solver (figure 14)",
        "neutral_line",
        "the records of the cases that the studies' neutral_line_cases names",
    ),
    "lca_validation.csv": ResultTable(
        LcaValidation,
        "The load-bearing model (LCA) against the published numbers",
        "lca_validation",
        "the model solved with table 10's spokes; printed values are those of tables 7 and 11",
    ),
    "lca_against_fem.csv": ResultTable(
        LcaAgainstFem,
        "The load-bearing model (LCA) against the FE stiffness of table 7",
        "lca_validation",
        "the model solved for the cases of table 7; FE values as printed there",
    ),
    "lca_neutral_line.csv": ResultTable(
        LcaNeutralLine,
        "Deformed neutral line of the shear band, LCA",
        "lca_validation",
        "the same solutions of the model, evaluated along the ring",
    ),
    "problems.csv": ResultTable(
        Problems,
        "Problems: everything that gave no result, and why",
        "problems",
        "specimen sheet, ingest records, reduction, case records and surface fits",
    ),
}
"""Tables of ``results/tables`` by file name; STUDY stands for the name of each study."""
