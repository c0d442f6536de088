"""A small run laid out by hand: published tables, real fits, four made-up specimens."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml

from nptcs.config.root import read_config
from nptcs.config.tyre import TyreGeometry
from nptcs.lca.validation import lca_against_fem, lca_validation, ring_shapes
from nptcs.materials import MaterialCard, PlyCard, Quantity, RubberCard
from nptcs.report.data import Results, SolverFacts
from nptcs.sensitivity import impact
from nptcs.surface.fit import fit
from nptcs.surface.quality import assess
from nptcs.tables.cases import Design
from nptcs.tables.catalogue import TABLES
from nptcs.tables.curves import Curve, IngestRecord
from nptcs.tables.impact import with_published
from nptcs.tables.io import check, empty_table, read_table
from nptcs.tables.problems import Problems, problems_table
from nptcs.tables.published import PrintedCoefficients
from nptcs.tables.specimens import Specimen
from nptcs.tables.surface import by_powers, quality_table, surface_table

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
        study["solver_options"] = {}
    values["studies"] = studies
    values["report"] = {"title": "A title <b>&", "laboratory": "Laboratory of tyres"}
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


def analysed(study, cases):
    """Fit the study's surface as the pipeline does."""
    names = [factor.name for factor in study.factors]
    response = cases["vertical_stiffness_n_per_mm"]
    surface = fit(cases, response, names, study.terms)
    file = ROOT / study.published_coefficients
    printed = by_powers(read_table(file, PrintedCoefficients), names)
    quality = quality_table(study.name, {"published": assess(surface, cases, response)})
    impacts = [
        impact(surface, cases, rule).assign(study=study.name, solver="published")
        for rule in ("domain_mean_absolute", "design_mean_absolute", "domain_mean_signed")
    ]
    return surface, surface_table({"published": surface}, printed), quality, pd.concat(impacts)


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
    columns = list(TABLES[name].to_schema().columns)
    return check(pd.DataFrame(rows).reindex(columns=columns), TABLES[name], name)


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
    return pd.DataFrame(rows, columns=list(TABLES["files.csv"].to_schema().columns))


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
        solvers={"published": SolverFacts("The published finite element results.", False)},
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
        coefficients={name: part[1] for name, part in parts.items()},
        files=files(sheet),
        specimens=properties(sheet),
        statistics=empty_table(TABLES["statistics.csv"]),
        models=empty_table(TABLES["hyperelastic_models.csv"]),
        ranges=ranges(),
        cases=pd.concat(cases.values(), ignore_index=True),
        quality=pd.concat([part[2] for part in parts.values()], ignore_index=True),
        impact=with_published(impacts, pd.read_csv(PUBLISHED / "table9_impact.csv")),
        lca_validation=lca_validation(
            spokes, table_11, pd.read_csv(PUBLISHED / "figure15_load_errors.csv"), tyre
        ),
        lca_against_fem=lca_against_fem(
            spokes, pd.read_csv(PUBLISHED / "table7_rubber_doe.csv"), tyre
        ),
        lca_shape=ring_shapes(spokes, table_11[:1], tyre),
        problems=empty_table(Problems),
    )


@pytest.fixture(scope="session")
def faulty(results):
    """The same run with a case that diverged and a specimen that could not be read."""
    cases = results.cases.copy()
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
        cases=cases,
        problems=problems,
        curves={**results.curves, "T0-1": empty_table(Curve)},
        records={**results.records, "T0-1": failed},
    )


@pytest.fixture(scope="session")
def measured(results):
    """The same run with measured specimens."""
    sheet = tuple(s.model_copy(update={"origin": "measured"}) for s in results.sheet)
    return replace(results, sheet=sheet, card=card(synthetic=False))
