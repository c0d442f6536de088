"""The studies of a small run written by hand: published cases, and made-up ones of two solvers."""

from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.campaign.record import CaseRecord
from nptcs.compare.coefficients import by_powers
from nptcs.fe.spoke.stiffness_line import stiffness_line
from nptcs.solvers.contract import SolverResult
from nptcs.solvers.spoke_responses import spoke_responses
from nptcs.surface.sensitivity.impact_table import impact_table
from nptcs.surface.study import fit_study
from nptcs.surface.tables import quality_table, surface_table
from nptcs.tables.io import read_table
from nptcs.tables.published.inputs import PublishedCoefficients

ROOT = Path(__file__).parents[2]
PUBLISHED = ROOT / "raw_data" / "published"
ARCHIVES = {"plate": "table5_plate_doe.csv", "rubber": "table7_rubber_doe.csv"}
ERROR_PERCENT = {
    "plate": lambda row: -1.0 if row["angle_deg"] < 60 else 2.0,
    "rubber": lambda row: 3.0 - row["spoke_c10_mpa"],
}
"""Made-up differences of the solver fe_tyre_paper from the published stiffness."""


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
