"""Two small finished runs written by hand: the same campaign, and one with another rubber."""

import hashlib
from datetime import UTC, datetime
from pathlib import Path

import pandas as pd
import pytest
import yaml

from nptcs.config.root import read_config
from nptcs.files import write_model
from nptcs.runs.content import inputs_of_run, tables_of_run
from nptcs.runs.identity import identify
from nptcs.tables.catalogue import TABLES
from nptcs.tables.io import empty_table, write_table
from nptcs.tables.laboratory.material_card import CardConstant, MaterialCard, PlyCard, RubberCard
from nptcs.tables.result_table import PER_STUDY

ROOT = Path(__file__).parents[3]
C10 = {"rubber_75A": 1.17, "rubber_88A": 2.93}
ERROR = 0.02
SOFTWARE = {"nptcs": "0.1.0", "numpy": "2.4.6"}


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()


def configuration(**changes):
    """The default configuration with the study of the tested rubbers alone, plain values."""
    values = yaml.safe_load((ROOT / "config" / "config.yaml").read_text("utf-8"))
    study = next(one for one in values["studies"] if one["name"] == "tested")
    study["factors"][1]["levels"] = [{"rubber": name} for name in C10]
    study["terms"] = ["1", "shear_band_c10_mpa", "spoke_c10_mpa"]
    values["studies"] = [study]
    values["uncertainty"]["rubber_study"] = "tested"
    values["uncertainty"].pop("surface", None)
    plain = read_config(values).model_dump(mode="json")
    plain["studies"][0].update(changes)
    return plain


def card(c10, error=ERROR, unit="MPa"):
    def quantity(name, value):
        specimens = tuple(f"{name}-{number}" for number in (1, 2, 3))
        return CardConstant(value=value, unit=unit, standard_error=error, origin="measured",
                        rule="least squares", specimens=specimens)  # fmt: skip

    assumed = CardConstant(value=2300.0, unit="MPa", origin="assumed", rule="assumed value")
    plies = [PlyCard(name="cfrp", synthetic=False, constants={"g23_mpa": assumed})]
    rubbers = [
        RubberCard(name=name, synthetic=True, constants={"c10_mpa": quantity(name, value)},
                   strain_range=(0.0, 0.15))
        for name, value in c10.items()
    ]  # fmt: skip
    return MaterialCard.joined(plies, rubbers)


def files(marks):
    """One file per specimen; its content is that of the rubber's mark."""
    rows = [("specimens.csv", "sheet", "", "", "", 10, digest("sheet"))]
    rows += [
        (f"{name}-{number}.csv", "used", f"{name}-{number}", "plain", "", 10,
         digest(f"{mark}{name}{number}"))
        for name, mark in marks.items()
        for number in (1, 2, 3)
    ]  # fmt: skip
    return pd.DataFrame(rows, columns=list(TABLES["files.csv"].contract.to_schema().columns))


def stiffness(band, spoke):
    return 100.0 + 20.0 * band + 60.0 * spoke


def cases(c10, wall_time=1.0, load=5000.0):
    rows = []
    for band in (4.0, 4.5, 5.0):
        for spoke in c10.values():
            k = stiffness(band, spoke)
            rows.append(
                {
                    "study": "tested",
                    "case_id": f"tested_{len(rows) + 1:03d}",
                    "solver": "lca",
                    "status": "ok",
                    "message": "",
                    "shear_band_c10_mpa": band,
                    "spoke_c10_mpa": spoke,
                    "load_n": load,
                    "vertical_stiffness_n_per_mm": k,
                    "displacement_mm": load / k,
                    "wall_time_s": wall_time,
                    "solver_version": "1",
                    "key": "0" * 64,
                }
            )
    return pd.DataFrame(rows)


def impacts(c10):
    spread = max(c10.values()) - min(c10.values())
    rows = [("spoke_c10_mpa", 60.0 * spread, 1), ("shear_band_c10_mpa", 20.0, 2)]
    return pd.DataFrame(
        [
            {
                "study": "tested",
                "solver": "lca",
                "response": "vertical_stiffness_n_per_mm",
                "at": "",
                "unit": "N/mm",
                "surface": "polynomial",
                "factor": factor,
                "lowest": 1.0,
                "highest": 5.0,
                "impact": impact,
                "signed_impact": impact,
                "first_index": 0.5,
                "total_index": 0.5,
                "total_confidence": 0.01,
                "effect": impact,
                "rank": rank,
                "near_tie_with": "",
                "cases": 6,
                "not_assessed_cases": 0,
                "failed_cases": 0,
            }
            for factor, impact, rank in rows
        ]
    )


def write_run(
    folder, c10, marks, *, config=None, error=ERROR, unit="MPa", wall_time=1.0, load=5000.0,
    day=1, identified=True, changes=None,
):  # fmt: skip
    """Write a finished run; `changes` maps a table's file to a function that changes it."""
    results = Path(folder) / "results"
    plain = config or configuration()
    tables = {
        name: empty_table(row.contract) for name, row in TABLES.items() if PER_STUDY not in name
    }
    tables |= {
        "files.csv": files(marks),
        "cases.csv": cases(c10, wall_time, load),
        "response_impact.csv": impacts(c10),
    }
    for name, table in tables.items():
        write_table(results / "tables" / name, table, TABLES[name].contract)
    for name, change in (changes or {}).items():
        change(results / "tables" / name)
    write_model(results / "material_card.json", card(c10, error, unit))
    text = yaml.safe_dump(plain, sort_keys=False)
    (results / "configuration.yaml").write_text(text, encoding="utf-8")
    if identified:
        identify_run(results, plain, day)
    return Path(folder)


def identify_run(results, plain, day=1):
    paths = sorted((results / "tables").glob("*.csv"))
    made = datetime(2026, 11, day, 4, 3, tzinfo=UTC)
    named = {"raw_data/published/table7_rubber_doe.csv": digest("table 7")}
    run = identify(
        inputs_of_run("raw_data/example", paths, named),
        plain,
        "c0de",
        tables_of_run(paths, results / "material_card.json"),
        SOFTWARE,
        made,
    )
    write_model(results / "identity.json", run)
    return run


MARKS = dict.fromkeys(C10, "a")
OTHER_RUBBER = {**C10, "rubber_88A": 3.10}
OTHER_MARKS = {**MARKS, "rubber_88A": "b"}


@pytest.fixture(scope="session")
def march(tmp_path_factory):
    return write_run(tmp_path_factory.mktemp("march"), C10, MARKS)


@pytest.fixture(scope="session")
def april(tmp_path_factory):
    """The same campaign, except for the files of rubber_88A."""
    return write_run(tmp_path_factory.mktemp("april"), OTHER_RUBBER, OTHER_MARKS, day=2)
