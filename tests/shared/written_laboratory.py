"""The laboratory of a small run written by hand: specimens, curves, properties, material card."""

import numpy as np
import pandas as pd

from nptcs.tables.catalogue import TABLES
from nptcs.tables.io import check
from nptcs.tables.laboratory.curves import Curve
from nptcs.tables.laboratory.material_card import CardConstant, MaterialCard, PlyCard, RubberCard
from nptcs.tables.laboratory.specimens import Specimen

C10_MPA = 1.25


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


def card(synthetic=True):
    measured = CardConstant(
        value=127742.123,
        unit="MPa",
        standard_error=2042.8,
        origin="measured",
        rule="chord",
        specimens=("T0-1",),
    )
    assumed = CardConstant(value=2300.0, unit="MPa", origin="assumed", rule="assumed value")
    c10 = CardConstant(
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
    """Make rows a result table; columns that are not given are empty."""
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
