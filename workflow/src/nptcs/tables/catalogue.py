"""All result tables: the one list from which rules, report, workbook and reference page are made.

A new table is its contract, one row here, its rule and its script. Its row decides its sheet in
the workbook and the section of the report that shows it; no other place needs to know it.
"""

from collections.abc import Iterator, Sequence

import pandera.pandas as pa

from nptcs.tables import column_headings as headings
from nptcs.tables.analysis.decisions import (
    DecisionConfirmation,
    DecisionDesigns,
    DecisionFront,
    Decisions,
)
from nptcs.tables.analysis.diagnostics import (
    SurfaceAnova,
    SurfaceInfluence,
    SurfaceSelection,
    SurfaceStationary,
    SurfaceTests,
)
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.analysis.response_surfaces import ResponseImpact, ResponseSurfaces
from nptcs.tables.analysis.sobol import MainEffects, SobolIndices
from nptcs.tables.analysis.surface import (
    SurfaceByFactor,
    SurfaceComparison,
    SurfaceQuality,
    SurfaceTable,
)
from nptcs.tables.analysis.uncertainty import ResponseUncertainty, UncertaintyShares
from nptcs.tables.laboratory.files import Files
from nptcs.tables.laboratory.flags import FlagsTable
from nptcs.tables.laboratory.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.laboratory.statistics import StatisticsTable
from nptcs.tables.problems import Problems
from nptcs.tables.published.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation
from nptcs.tables.published.stiffness import (
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
    StiffnessExponents,
)
from nptcs.tables.result_table import (
    PER_STUDY,
    ReportSection,
    ResultTable,
    RowMark,
    SyntheticBy,
)
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.coverage import CaseCoverage
from nptcs.tables.tyres.deformed_tyre import DeformedTyre
from nptcs.tables.tyres.displacement_by_load import DisplacementByLoad
from nptcs.tables.tyres.neutral_line import NeutralLine
from nptcs.tables.tyres.spoke_stiffness import SpokeCurves, SpokeLines
from nptcs.tables.tyres.tyre_responses import PlateStress, TyreCurves, TyreResponses

TABLES: dict[str, ResultTable] = {
    "problems.csv": ResultTable(
        Problems,
        "Problems: everything that gave no result, and why",
        "problems",
        "specimen sheet, ingest records, reduction, case records and surface fits",
        section=ReportSection.SUMMARY,
        mark=RowMark.EVERY_ROW,
        synthetic=SyntheticBy.NOTHING,
    ),
    "files.csv": ResultTable(
        Files,
        "Every file of the laboratory's folder and what became of it",
        "account",
        "the folder of the specimen sheet and the ingest records",
        section=ReportSection.SPECIMENS,
        mark=RowMark.FILE_STATUS,
    ),
    "specimens.csv": ResultTable(
        PropertiesTable,
        "Properties of each specimen",
        "reduce, statistics",
        "the specimens' curves, by the rule and the range in each row",
        section=ReportSection.SPECIMENS,
        mark=RowMark.SPECIMEN,
    ),
    "statistics.csv": ResultTable(
        StatisticsTable,
        "Statistics of each group of specimens",
        "statistics",
        "the properties of the specimens that the sheet includes",
        section=ReportSection.SPECIMENS,
        mark=RowMark.OUTLIERS,
    ),
    "flags.csv": ResultTable(
        FlagsTable,
        "What was flagged: deviations from the standards, values not assessed, remarks",
        "statistics",
        "the flags of the specimens' properties; flags that differ only in their numbers are one",
        section=ReportSection.SPECIMENS,
        mark=RowMark.DEVIATION,
    ),
    "hyperelastic_models.csv": ResultTable(
        ModelComparison,
        "Hyperelastic models compared",
        "calibrate_rubber, material_card",
        "the rubber curves; the study's model is the one on the card",
        section=ReportSection.MATERIALS,
        synthetic=SyntheticBy.RUBBERS,
    ),
    "c10_against_range.csv": ResultTable(
        RangeTable,
        "C10 against the strain range of the fit",
        "calibrate_rubber, material_card",
        "the rubber curves, neo-Hookean fits to growing ranges",
        section=ReportSection.MATERIALS,
        synthetic=SyntheticBy.RUBBERS,
    ),
    "cases.csv": ResultTable(
        Cases,
        "Every case of every study: how it ended and its responses",
        "solve, cases",
        "one record per case; wall time is that of the run that solved the case",
        section=ReportSection.CASES,
        mark=RowMark.STATUS,
        synthetic=SyntheticBy.STUDIES,
    ),
    "case_coverage.csv": ResultTable(
        CaseCoverage,
        "Solved, failed and missing cases by level of each factor",
        "case_coverage",
        "cases.csv and the design tables; estimability of the terms with the solved cases",
        section=ReportSection.CASES,
        synthetic=SyntheticBy.STUDIES,
    ),
    "STUDY_surface.csv": ResultTable(
        SurfaceTable,
        "Response surfaces of the study STUDY: coefficients",
        "surface",
        "solved cases, ordinary least squares in coded units, expanded to natural units",
        section=ReportSection.SURFACES,
        headings=headings.SURFACE,
        synthetic=SyntheticBy.STUDIES,
        sheet="surface_STUDY",
    ),
    "surface_quality.csv": ResultTable(
        SurfaceQuality,
        "How well each polynomial follows its cases",
        "surface, sensitivity",
        "the solved cases and the surfaces fitted to them",
        section=ReportSection.SURFACES,
        headings=headings.QUALITY,
        synthetic=SyntheticBy.STUDIES,
    ),
    "surface_comparison.csv": ResultTable(
        SurfaceComparison,
        "Surfaces of every kind: how they predict cases that they have not seen",
        "surface, sensitivity",
        "the solved cases; each surface fitted again without each case and without each level",
        section=ReportSection.SURFACES,
        headings=headings.COMPARISON,
        synthetic=SyntheticBy.STUDIES,
    ),
    "surface_by_factor.csv": ResultTable(
        SurfaceByFactor,
        "Surfaces of every kind along each factor: range of validity, levels left out, direction",
        "surface, sensitivity",
        "the same surfaces; direction over a grid in the box of the cases",
        section=ReportSection.SURFACES,
        headings=headings.BY_FACTOR,
        synthetic=SyntheticBy.STUDIES,
    ),
    "surface_tests.csv": ResultTable(
        SurfaceTests,
        "Tests of the polynomials' coefficients: t, p, confidence interval, variance inflation",
        "diagnostics",
        "the polynomials of equations 21 and 22, or those configured; coded coefficients",
        section=ReportSection.SURFACES,
        headings=headings.of(headings.DIAGNOSTICS, SurfaceTests),
        synthetic=SyntheticBy.STUDIES,
    ),
    "surface_anova.csv": ResultTable(
        SurfaceAnova,
        "Analysis of variance of the polynomials, sequential and partial, with lack of fit",
        "diagnostics",
        "the polynomials and the cases that they were fitted to",
        section=ReportSection.SURFACES,
        headings=headings.of(headings.DIAGNOSTICS, SurfaceAnova),
        synthetic=SyntheticBy.STUDIES,
    ),
    "surface_influence.csv": ResultTable(
        SurfaceInfluence,
        "What each case does to the polynomials: residual, leverage, Cook's distance",
        "diagnostics",
        "the polynomials and the cases that they were fitted to",
        section=ReportSection.SURFACES,
        headings=headings.of(headings.DIAGNOSTICS, SurfaceInfluence),
        synthetic=SyntheticBy.STUDIES,
    ),
    "surface_stationary.csv": ResultTable(
        SurfaceStationary,
        "Stationary points of the polynomials with their kind, and paths of the extremes",
        "diagnostics",
        "the polynomials; paths on spheres about the centre in coded units",
        section=ReportSection.SURFACES,
        headings=headings.of(headings.DIAGNOSTICS, SurfaceStationary),
        synthetic=SyntheticBy.STUDIES,
    ),
    "surface_selection.csv": ResultTable(
        SurfaceSelection,
        "Terms of the polynomials dropped one by one, by AICc and by PRESS",
        "diagnostics",
        "the polynomials' terms; only a term that no other one needs may go",
        section=ReportSection.SURFACES,
        headings=headings.of(headings.DIAGNOSTICS, SurfaceSelection),
        synthetic=SyntheticBy.STUDIES,
    ),
    "impact.csv": ResultTable(
        Impact,
        "Average gradients and comprehensive impact values, by every rule",
        "sensitivity",
        "the response surfaces; published values are those of table 9",
        section=ReportSection.SENSITIVITY,
        headings=headings.IMPACT,
        synthetic=SyntheticBy.STUDIES,
    ),
    "sobol_indices.csv": ResultTable(
        SobolIndices,
        "Shares of the variance by factor and by pair (Sobol indices), every surface",
        "sobol",
        "the surfaces, sampled over independent factors; intervals by bootstrap",
        section=ReportSection.SENSITIVITY,
        headings=headings.of(headings.SOBOL, SobolIndices),
        synthetic=SyntheticBy.STUDIES,
    ),
    "main_effects.csv": ResultTable(
        MainEffects,
        "Main effect of each factor over its range, every surface",
        "sobol",
        "the surfaces, averaged over the other factors",
        section=ReportSection.SENSITIVITY,
        headings=headings.of(headings.SOBOL, MainEffects),
        synthetic=SyntheticBy.STUDIES,
    ),
    "response_surfaces.csv": ResultTable(
        ResponseSurfaces,
        "Surfaces of every response, and how they predict cases that were left out",
        "surface, sensitivity",
        "cases.csv and the responses of solved tyres, realised values; left-out cases predicted by "
        "surfaces that were fitted again",
        section=ReportSection.SURFACES,
        headings=headings.RESPONSE_SURFACES,
        synthetic=SyntheticBy.ROWS,
    ),
    "response_impact.csv": ResultTable(
        ResponseImpact,
        "What each factor does to each response",
        "sobol",
        "the surface of each response that predicts left-out cases best; Sobol indices by "
        "Saltelli's scheme, slopes over a scrambled Sobol sequence",
        section=ReportSection.SENSITIVITY,
        headings=headings.RESPONSE_IMPACT,
        synthetic=SyntheticBy.ROWS,
    ),
    "uncertainty.csv": ResultTable(
        ResponseUncertainty,
        "Responses of reference and chosen designs with their uncertainty",
        "decide",
        "the surfaces, sampled over the card's uncertainty, stated rubbers and tolerances; the "
        "solver's bias is next to the interval, not in it",
        section=ReportSection.UNCERTAINTY,
        headings=headings.of(headings.UNCERTAINTY, ResponseUncertainty),
        synthetic=SyntheticBy.ROWS,
    ),
    "uncertainty_shares.csv": ResultTable(
        UncertaintyShares,
        "Which test or tolerance the uncertainty comes from",
        "decide",
        "the same models, each source alone (three-point Gauss rule)",
        section=ReportSection.UNCERTAINTY,
        headings=headings.of(headings.UNCERTAINTY, UncertaintyShares),
        synthetic=SyntheticBy.ROWS,
    ),
    "decisions.csv": ResultTable(
        Decisions,
        "Decisions: what was asked, the chosen design and whether it was confirmed",
        "decide",
        "the surfaces of the study, its uncertainties, and the solver for the confirmation",
        section=ReportSection.DECISION,
        headings=headings.of(headings.DECISION, Decisions),
        synthetic=SyntheticBy.ROWS,
    ),
    "decision_designs.csv": ResultTable(
        DecisionDesigns,
        "The best designs of each decision, goal by goal",
        "decide",
        "the same surfaces as decisions.csv; low and high are quantiles of the samples",
        section=ReportSection.DECISION,
        headings=headings.of(headings.DECISION, DecisionDesigns),
        synthetic=SyntheticBy.STUDIES,
    ),
    "decision_front.csv": ResultTable(
        DecisionFront,
        "Pareto front of decisions with two objectives or more",
        "decide",
        "the same surfaces as decisions.csv; acceptable candidates and designs that no other one "
        "betters",
        section=ReportSection.DECISION,
        headings=headings.of(headings.DECISION, DecisionFront),
        synthetic=SyntheticBy.STUDIES,
    ),
    "decision_confirmation.csv": ResultTable(
        DecisionConfirmation,
        "Chosen designs solved: inside or outside the prediction interval",
        "decide",
        "the study's solver at the chosen design; the interval is that of the surface alone",
        section=ReportSection.DECISION,
        headings=headings.of(headings.DECISION, DecisionConfirmation),
        synthetic=SyntheticBy.ROWS,
    ),
    "spoke_stiffness.csv": ResultTable(
        SpokeLines,
        "Stiffness of single spokes, computed and table 10",
        "spoke_stiffness",
        "the single spokes' curves, lines through the origin; published values are those of "
        "table 10",
        section=ReportSection.SPOKE,
        headings=headings.SPOKE,
        mark=RowMark.STATUS,
        synthetic=SyntheticBy.ROWS,
    ),
    "spoke_curves.csv": ResultTable(
        SpokeCurves,
        "Force–displacement curves of single spokes (figure 13)",
        "spoke_stiffness",
        "the records of the single spokes",
        section=ReportSection.SPOKE,
        synthetic=SyntheticBy.ROWS,
        raw=True,
    ),
    "tyre_responses.csv": ResultTable(
        TyreResponses,
        "What each solved tyre does: stiffness at any load, contact, spokes, plates",
        "tyre_responses",
        "the records of the tyres; margins with the ply's strengths in statistics.csv",
        section=ReportSection.TYRE,
        mark=RowMark.STATUS,
        headings=headings.RESPONSES,
        synthetic=SyntheticBy.ROWS,
    ),
    "tyre_curves.csv": ResultTable(
        TyreCurves,
        "Load–displacement curves of the solved tyres (figure 10 b)",
        "tyre_responses",
        "the records of the tyres",
        section=ReportSection.TYRE,
        synthetic=SyntheticBy.ROWS,
        raw=True,
    ),
    "deformed_tyre.csv": ResultTable(
        DeformedTyre,
        "Outlines of a loaded tyre with all its spokes (figure 10 a)",
        "deformed_tyre",
        "the first case that neutral_line_cases names, solved again for the motions of its spokes",
        section=ReportSection.TYRE,
        synthetic=SyntheticBy.ROWS,
        raw=True,
    ),
    "plate_stress.csv": ResultTable(
        PlateStress,
        "Stress at the faces of the most loaded spokes' plates (figure 10 a)",
        "tyre_responses",
        "the records of the tyres, whose most loaded spokes were solved again at their motion",
        section=ReportSection.TYRE,
        synthetic=SyntheticBy.ROWS,
        raw=True,
    ),
    "stiffness_against_published.csv": ResultTable(
        StiffnessAgainstPublished,
        "Computed and published vertical stiffness, case by case",
        "compare_published",
        "cases.csv; published values are those that the solver `published` looked up",
        section=ReportSection.PUBLISHED_STIFFNESS,
        mark=RowMark.STATUS_OR_CALIBRATION,
        synthetic=SyntheticBy.ROWS,
    ),
    "stiffness_errors.csv": ResultTable(
        StiffnessErrors,
        "Differences from the published stiffness, blind cases and calibration cases",
        "compare_published",
        "stiffness_against_published.csv, summarised",
        section=ReportSection.PUBLISHED_STIFFNESS,
        headings=headings.ERRORS,
        synthetic=SyntheticBy.ROWS,
    ),
    "stiffness_by_level.csv": ResultTable(
        StiffnessByLevel,
        "Main effects and differences by level of each factor",
        "compare_published",
        "stiffness_against_published.csv, averaged over the cases at each level",
        section=ReportSection.PUBLISHED_STIFFNESS,
        headings=headings.LEVELS,
        synthetic=SyntheticBy.ROWS,
    ),
    "stiffness_exponents.csv": ResultTable(
        StiffnessExponents,
        "Exponents of the stiffness with respect to each modulus, computed and published",
        "compare_published",
        "stiffness_against_published.csv, logarithm of the stiffness against that of each modulus",
        section=ReportSection.PUBLISHED_STIFFNESS,
        headings=headings.EXPONENTS,
        synthetic=SyntheticBy.ROWS,
    ),
    "neutral_line.csv": ResultTable(
        NeutralLine,
        "Displacement of the band's neutral line, every solver (figure 14)",
        "neutral_line",
        "the records of the cases that the studies' neutral_line_cases names",
        section=ReportSection.PUBLISHED_STIFFNESS,
        synthetic=SyntheticBy.ROWS,
        raw=True,
    ),
    "lca_validation.csv": ResultTable(
        LcaValidation,
        "The load-bearing model (LCA) against the published numbers",
        "lca_validation",
        "the model solved with table 10's spokes; published values are those of tables 7 and 11",
        section=ReportSection.LCA,
        synthetic=SyntheticBy.NOTHING,
    ),
    "lca_against_fem.csv": ResultTable(
        LcaAgainstFem,
        "The load-bearing model (LCA) against the FE stiffness of table 7",
        "lca_validation",
        "the model solved for the cases of table 7; FE values as published there",
        section=ReportSection.LCA,
        synthetic=SyntheticBy.NOTHING,
    ),
    "displacement_by_load.csv": ResultTable(
        DisplacementByLoad,
        "Displacement by finite elements and by the load-bearing model (figure 15)",
        "displacement_by_load",
        "the curves of the tyres of table 11, and lca_validation.csv",
        section=ReportSection.LCA,
        mark=RowMark.STATUS,
        synthetic=SyntheticBy.PLIES,
    ),
    "lca_neutral_line.csv": ResultTable(
        LcaNeutralLine,
        "Deformed neutral line of the shear band, LCA",
        "lca_validation",
        "the same solutions of the model, evaluated along the ring",
        section=ReportSection.LCA,
        synthetic=SyntheticBy.NOTHING,
        raw=True,
    ),
}
"""Tables of ``results/tables`` by file name, in the order of the workbook.

`PER_STUDY` in a name stands for each study that has a surface.
"""


def result_files(surface_studies: Sequence[str]) -> Iterator[tuple[str, ResultTable, str]]:
    """Go through all files of ``results/tables``.

    Parameters
    ----------
    surface_studies : sequence of str
        Names of the studies that have a surface.

    Yields
    ------
    file, table, study : str, ResultTable, str
        Name of the file, its row of `TABLES`, and the study if it is the table of one study.
    """
    for name, table in TABLES.items():
        for study in surface_studies if PER_STUDY in name else [""]:
            yield name.replace(PER_STUDY, study), table, study


def file_of(contract: type[pa.DataFrameModel], study: str = "") -> str:
    """Return the name of the file that a contract is for; of a table per study, that of `study`.

    Raises
    ------
    KeyError
        For a contract of no result table.
    """
    for name, table in TABLES.items():
        if table.contract is contract:
            return name.replace(PER_STUDY, study)
    raise KeyError(f"{contract.__name__} is not the contract of a result table")
