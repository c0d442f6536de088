"""A small run written by hand: published tables, real fits, a few made-up specimens."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import yaml
from written_laboratory import card, curve, files, neo_hookean, properties, ranges, specimen
from written_studies import (
    ARCHIVES,
    PUBLISHED,
    ROOT,
    analysed,
    cases_of,
    computed_cases,
    shape,
    spoke_records,
)

from nptcs.compare.impact import with_published
from nptcs.compare.lca import lca_against_fem, lca_validation, ring_neutral_lines
from nptcs.compare.published_stiffness import (
    Comparison,
    compare_published,
    stiffness_by_level,
    stiffness_errors,
)
from nptcs.compare.spoke_stiffness import spoke_curves, spoke_lines
from nptcs.compare.stiffness_exponents import stiffness_exponents
from nptcs.config.root import read_config
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.report.data import Results, SolverDescription
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.catalogue import TABLES
from nptcs.tables.io import check, empty_table, read_table
from nptcs.tables.laboratory.curves import Curve, IngestRecord
from nptcs.tables.problems import problems_table
from nptcs.tables.published.inputs import PublishedSpokeStiffness
from nptcs.tables.published.stiffness import (
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
    StiffnessExponents,
)
from nptcs.tables.result_table import PER_STUDY
from nptcs.tables.tyres.cases import Cases, DesignTable
from nptcs.tables.tyres.neutral_line import NeutralLine
from nptcs.tables.tyres.spoke_stiffness import SpokeCurves, SpokeLines


@pytest.fixture(scope="session")
def config():
    values = yaml.safe_load((ROOT / "config" / "config.yaml").read_text("utf-8"))
    studies = [study for study in values["studies"] if study["name"] in ARCHIVES]
    for study in studies:
        study["solvers"] = ["published"]
        study["solver_options"] = study["calibration_cases"] = {}
        study["neutral_line_cases"] = []
        study.pop("decisions", None)  # they ask a solver that this run does not have
    values["studies"] = studies
    values["report"] = {"title": "A title <b>&"}
    values["laboratory"] = {"name": "Laboratory of tyres"}
    return read_config(values)


@pytest.fixture(scope="session")
def results(config):
    sheet = (
        specimen("T0-1"),
        specimen("T0-2", include=False, reason="slipped in the grip"),
        specimen("R75-1", test="rubber_tension"),
    )
    strain, large = np.linspace(0, 0.01, 1000), np.linspace(0, 0.5, 300)
    curves = {
        "T0-1": curve(strain, 128000 * strain),
        "T0-2": curve(strain[:300], 120000 * strain[:300]),
        "R75-1": curve(large, neo_hookean(large)),
    }
    cases = {study.name: cases_of(study) for study in config.studies}
    parts = {study.name: analysed(study, cases[study.name]) for study in config.studies}
    impacts = pd.concat([part[3] for part in parts.values()], ignore_index=True)
    spokes = pd.read_csv(PUBLISHED / "table10_spoke_stiffness.csv")
    table_11 = pd.read_csv(PUBLISHED / "table11_lca_validation.csv")
    tyre = TyreGeometry()
    return Results(
        config=config,
        sheet=sheet,
        solvers={
            "published": SolverDescription("the published finite element results", False, True)
        },
        software={"nptcs": "0.1.0", "Python": "3.11"},
        inputs={"raw_data/published/table5_plate_doe.csv": "a" * 64},
        card=card(),
        curves=curves,
        records={s.specimen: IngestRecord(specimen=s.specimen, status="ok") for s in sheet},
        designs={
            name: check(
                table[["case_id"]]
                .assign(case=range(1, len(table) + 1))
                .join(table[[f.name for f in config.study(name).factors]]),
                DesignTable,
                name,
            )
            for name, table in cases.items()
        },
        surfaces={name: {"published": part[0]} for name, part in parts.items()},
        tables={
            **{
                name: empty_table(table.contract)
                for name, table in TABLES.items()
                if PER_STUDY not in name
            },
            **{f"{name}_surface.csv": part[1] for name, part in parts.items()},
            "files.csv": files(sheet),
            "specimens.csv": properties(sheet),
            "c10_against_range.csv": ranges(),
            "cases.csv": pd.concat(cases.values(), ignore_index=True),
            "surface_quality.csv": pd.concat(
                [part[2] for part in parts.values()], ignore_index=True
            ),
            "impact.csv": with_published(impacts, pd.read_csv(PUBLISHED / "table9_impact.csv")),
            "lca_validation.csv": lca_validation(
                spokes, table_11, pd.read_csv(PUBLISHED / "figure15_load_errors.csv"), tyre
            ),
            "lca_against_fem.csv": lca_against_fem(
                spokes, pd.read_csv(PUBLISHED / "table7_rubber_doe.csv"), tyre
            ),
            "lca_neutral_line.csv": ring_neutral_lines(spokes, table_11[:1], tyre),
        },
    )


@pytest.fixture(scope="session")
def faulty(results):
    """The same run with a case that diverged and a specimen that could not be read."""
    cases = results.table(Cases).copy()
    cases.loc[0, ["status", "message"]] = ["diverged", "step 7 <cut back> 5 times"]
    cases.loc[0, ["vertical_stiffness_n_per_mm", "displacement_mm"]] = np.nan
    problems = problems_table(
        [
            ("solve", "plate_001", "published", "diverged", "step 7 <cut back> 5 times"),
            ("ingest", "T0-1", "", "error", "T0-1.csv:12, column 'Force': not a number"),
        ]
    )
    failed = IngestRecord(specimen="T0-1", status="error", message="not a number")
    return replace(
        results,
        tables={**results.tables, "cases.csv": cases, "problems.csv": problems},
        curves={**results.curves, "T0-1": empty_table(Curve)},
        records={**results.records, "T0-1": failed},
    )


@pytest.fixture(scope="session")
def measured(results):
    """The same run with measured specimens."""
    sheet = tuple(s.model_copy(update={"origin": "measured"}) for s in results.sheet)
    return replace(results, sheet=sheet, card=card(synthetic=False))


@pytest.fixture(scope="session")
def compared(results):
    """The run of the default studies with a made-up fe_tyre_paper and fe_spoke to compare."""
    values = yaml.safe_load((ROOT / "config" / "config.yaml").read_text("utf-8"))
    values["studies"] = [
        study for study in values["studies"] if study["name"] not in ("tested", "loads")
    ]
    for study in values["studies"]:
        study["solvers"] = [name for name in study["solvers"] if name != "lca"]
    config = read_config(values)
    tyres = [config.study(name) for name in ARCHIVES]
    computed = {study.name: computed_cases(study) for study in tyres}
    cases = pd.concat([results.table(Cases), *computed.values()], ignore_index=True)
    studies = {
        study.name: Comparison(
            results.designs[study.name],
            tuple(factor.name for factor in study.factors),
            ("fe_tyre_paper",),
            study.calibration_cases,
        )
        for study in tyres
    }
    table = check(compare_published(cases, studies), StiffnessAgainstPublished, "against")
    records = spoke_records(config.study("spoke"))
    table_10 = read_table(PUBLISHED / "table10_spoke_stiffness.csv", PublishedSpokeStiffness)
    solved = {name: rows[rows["status"] == "ok"] for name, rows in computed.items()}
    parts = {study.name: analysed(study, solved[study.name], "fe_tyre_paper") for study in tyres}
    impacts = pd.concat([part[3] for part in parts.values()], ignore_index=True)
    table_9 = pd.read_csv(PUBLISHED / "table9_impact.csv")
    spokes = pd.DataFrame({"case_id": [r.case_id for r in records], "case": range(1, 6)})
    spokes["spoke_c10_mpa"] = [r.values["spoke_c10_mpa"] for r in records]
    return replace(
        results,
        config=config,
        solvers={
            **results.solvers,
            "lca": SolverDescription("the ring", False, True),
            "fe_tyre_paper": SolverDescription(
                "the tyre", True, True, [{"plate_coupling": "embedded"}]
            ),
            "fe_spoke": SolverDescription("one spoke", True, False),
        },
        designs={**results.designs, "spoke": check(spokes, DesignTable, "spoke")},
        surfaces={
            name: {**by_solver, "fe_tyre_paper": parts[name][0]}
            for name, by_solver in results.surfaces.items()
        },
        tables={
            **results.tables,
            "cases.csv": cases,
            "impact.csv": pd.concat(
                [results.table(Impact), with_published(impacts, table_9)], ignore_index=True
            ),
            "spoke_stiffness.csv": check(
                spoke_lines(records, {"spoke": table_10}), SpokeLines, "lines"
            ),
            "spoke_curves.csv": check(spoke_curves(records), SpokeCurves, "curves"),
            "stiffness_against_published.csv": table,
            "stiffness_errors.csv": check(stiffness_errors(table), StiffnessErrors, "errors"),
            "stiffness_by_level.csv": check(
                stiffness_by_level(table, studies), StiffnessByLevel, "levels"
            ),
            "stiffness_exponents.csv": check(
                stiffness_exponents(table, studies), StiffnessExponents, "exponents"
            ),
            "neutral_line.csv": check(
                pd.concat([shape("lca", 20.0), shape("fe_tyre_paper", 19.0)]), NeutralLine, ""
            ),
        },
    )
