"""A small run written by hand: published tables, real fits, four made-up specimens."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml

from nptcs.campaign.record import CaseRecord
from nptcs.compare.coefficients import by_powers
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
from nptcs.fe.spoke.stiffness_line import stiffness_line
from nptcs.report.data import Results, SolverFacts
from nptcs.solvers.contract import SolverResult
from nptcs.solvers.spoke_responses import spoke_responses
from nptcs.surface.sensitivity.impact_table import impact_table
from nptcs.surface.study import fit_study
from nptcs.surface.tables import quality_table, surface_table
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.catalogue import TABLES
from nptcs.tables.io import check, empty_table, read_table
from nptcs.tables.laboratory.curves import Curve, IngestRecord
from nptcs.tables.laboratory.material_card import MaterialCard, PlyCard, Quantity, RubberCard
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.problems import problems_table
from nptcs.tables.published.inputs import PublishedCoefficients, PublishedSpokeStiffness
from nptcs.tables.published.stiffness import (
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
    StiffnessExponents,
)
from nptcs.tables.result_table import PER_STUDY
from nptcs.tables.tyres.cases import Cases, Design
from nptcs.tables.tyres.neutral_line import NeutralLine
from nptcs.tables.tyres.spoke_stiffness import SpokeCurves, SpokeLines

ROOT = Path(__file__).parents[3]
PUBLISHED = ROOT / "raw_data" / "published"
ARCHIVES = {"plate": "table5_plate_doe.csv", "rubber": "table7_rubber_doe.csv"}
C10_MPA = 1.25


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


def specimen(name, test="tension", origin="synthetic", **more):
    size = {"width_mm": (15.0,), "thickness_mm": (1.0,), "force_file": f"{name}.csv"}
    angle = {} if test.startswith("rubber") else {"orientation_deg": 0.0}
    material = "rubber_75A" if test.startswith("rubber") else "cfrp"
    return Specimen(
        specimen=name, test=test, material=material, origin=origin, **size, **angle, **more
    )


def curve(strain, stress):
    table = pd.DataFrame({"strain_axial": strain, "stress_mpa": stress})
    table["force_n"] = 15.0 * table["stress_mpa"]
    for column in ("time_s", "strain_transverse", "strain_axial_back"):
        table[column] = np.nan
    return check(table[list(Curve.to_schema().columns)], Curve, "curve")


def neo_hookean(strain):
    stretch = 1 + strain
    return 2 * C10_MPA * (stretch - stretch**-2)


def cases_of(study):
    table = pd.read_csv(PUBLISHED / ARCHIVES[study.name])
    factors = {factor.name: table[factor.name].astype(float) for factor in study.factors}
    return pd.DataFrame(
        {
            "study": study.name,
            "case_id": [f"{study.name}_{number:03d}" for number in table["case"]],
            "solver": "published",
            "status": "ok",
            "message": "",
            **factors,
            "load_n": 5000.0,
            "vertical_stiffness_n_per_mm": table["stiffness_n_per_mm"],
            "displacement_mm": 5000 / table["stiffness_n_per_mm"],
            "wall_time_s": 0.001,
            "solver_version": "1",
            "key": "0" * 64,
        }
    )


def analysed(study, cases, solver="published"):
    """Fit the study's surface as the pipeline does."""
    names = [factor.name for factor in study.factors]
    done = fit_study(
        cases.assign(solver=solver), study.model_copy(update={"solvers": (solver,), "surfaces": ()})
    )
    surface = done.polynomials[solver]
    file = ROOT / study.published_coefficients
    published = by_powers(read_table(file, PublishedCoefficients), names)
    quality = quality_table(done)
    rules = ("domain_mean_absolute", "design_mean_absolute", "domain_mean_signed")
    impacts = impact_table(
        {study.name: {solver: surface}}, {study.name: cases[names]}, quality, rules, 0.8
    )
    return surface, surface_table({solver: surface}, published), quality, impacts


def card(synthetic=True):
    measured = Quantity(
        value=127742.123,
        unit="MPa",
        standard_error=2042.8,
        origin="measured",
        rule="chord",
        specimens=("T0-1",),
    )
    assumed = Quantity(value=2300.0, unit="MPa", origin="assumed", rule="assumed value")
    c10 = Quantity(
        value=C10_MPA,
        unit="MPa",
        standard_error=0.0123,
        origin="measured",
        rule="least squares",
        specimens=("R75-1",),
    )
    ply = PlyCard(
        name="cfrp",
        synthetic=synthetic,
        constants={"e1_mpa": measured, "g23_mpa": assumed},
        checks=("warning: not transversely isotropic", "compliance matrix is positive definite"),
    )
    rubber = RubberCard(
        name="rubber_75A",
        synthetic=synthetic,
        constants={"c10_mpa": c10},
        strain_range=(0.0, 0.15),
        fit_quality={"rmse_mpa": 0.01, "drucker_stable": 1.0},
    )
    return MaterialCard(plies={"cfrp": ply}, rubbers={"rubber_75A": rubber})


def as_table(rows, name):
    """Lay rows out as a result table; columns that are not given are empty."""
    columns = list(TABLES[name].contract.to_schema().columns)
    return check(pd.DataFrame(rows).reindex(columns=columns), TABLES[name].contract, name)


def properties(sheet):
    rows = [
        {
            "specimen": s.specimen,
            "test": s.test.value,
            "material": s.material,
            "property": "modulus",
            "value": 127742.123456789,
            "unit": "MPa",
            "rule": "chord",
            "range": "strain 0.001 to 0.003",
            "points": 40,
            "flags": "=1+1",
            "origin": s.origin,
        }
        for s in sheet
        if not s.test.is_rubber
    ]
    return as_table(rows, "specimens.csv")


def files(sheet):
    rows = [
        (
            s.force_file,
            "used" if s.include else "left out",
            s.specimen,
            "plain",
            s.reason,
            10,
            "0" * 64,
        )
        for s in sheet
    ]
    rows.append(("notes.txt", "not named", "", "", "no row names it", 3, "1" * 64))
    rows.append(("README.md", "note", "", "", "a README is a note", 3, "2" * 64))
    return pd.DataFrame(rows, columns=list(TABLES["files.csv"].contract.to_schema().columns))


def ranges():
    rows = [
        {
            "rubber": "rubber_75A",
            "specimen": "all",
            "strain_low": 0.0,
            "strain_high": high,
            "c10_mpa": C10_MPA + high,
            "standard_error_mpa": 0.01,
            "points": 50,
            "in_card": high == 0.15,
            "remarks": "",
        }
        for high in (0.05, 0.15, 0.3)
    ]
    return as_table(rows, "c10_against_range.csv")


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
        solvers={"published": SolverFacts("the published finite element results", False, True)},
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
                Design,
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


ERROR_PERCENT = {"plate": lambda row: -1.0 if row["angle_deg"] < 60 else 2.0}
ERROR_PERCENT["rubber"] = lambda row: 3.0 - row["spoke_c10_mpa"]
"""Made-up differences of the solver fe_tyre_paper from the published stiffness."""


def computed_cases(study):
    """Cases of a made-up fe_tyre_paper; the last one of the rubber study diverged."""
    cases = cases_of(study).assign(solver="fe_tyre_paper")
    error = cases.apply(ERROR_PERCENT[study.name], axis=1)
    cases["vertical_stiffness_n_per_mm"] *= 1 + error / 100
    if study.name == "rubber":
        last = cases.index[-1]
        cases.loc[last, ["status", "message"]] = ["diverged", "outside the table"]
        cases.loc[last, ["vertical_stiffness_n_per_mm", "displacement_mm"]] = np.nan
    return cases


def spoke_records(study):
    """Spokes twice as stiff in tension at the end as at the start; the last one diverged."""
    place = np.linspace(-20.0, 4.0, 49)
    records = []
    for number, c10 in enumerate(study.factors[0].levels, start=1):
        force = 30.0 * c10 * place + 2.0 * c10 * np.sign(place) * place**2
        curve = {"displacement_mm": place.tolist(), "force_n": force.tolist()}
        pulled, pressed = place >= 0.0, place <= 0.0
        lines = (
            stiffness_line(place[pulled], force[pulled]),
            stiffness_line(-place[pressed], -force[pressed]),
        )
        ok = SolverResult(status="ok", extra=spoke_responses(*lines), curve=curve)
        failed = SolverResult(status="diverged", message="no equilibrium")
        records.append(
            CaseRecord(
                study=study.name,
                case_id=f"spoke_{number:03d}",
                solver="fe_spoke",
                solver_version="1",
                key="0" * 64,
                values={"spoke_c10_mpa": c10, **study.fixed},
                load_n=None,
                wall_time_s=1.0,
                result=failed if c10 == 5 else ok,
            )
        )
    return records


def shape(solver, depth_mm):
    theta = np.arange(-180.0, 180.0, 1.5)
    radial = -depth_mm * np.exp(-((theta / 20) ** 2))
    return pd.DataFrame(
        {
            "study": "rubber",
            "case_id": "rubber_011",
            "solver": solver,
            "load_n": 5000.0,
            "theta_deg": theta,
            "radial_mm": radial,
            "tangential_mm": 0.2 * depth_mm * np.sin(np.radians(theta)),
        }
    )


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
            "lca": SolverFacts("the ring", False, True),
            "fe_tyre_paper": SolverFacts("the tyre", True, True, [{"plate_coupling": "embedded"}]),
            "fe_spoke": SolverFacts("one spoke", True, False),
        },
        designs={**results.designs, "spoke": check(spokes, Design, "spoke")},
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
