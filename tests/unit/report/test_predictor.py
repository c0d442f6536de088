"""The predictor's formulas, computed by LibreOffice, against the surfaces in Python."""

import io
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import openpyxl
import pandas as pd
import pytest
from openpyxl import Workbook

from nptcs.report.workbook.build import build_workbook
from nptcs.report.workbook.predictor import (
    FIRST_INPUT,
    PREDICTOR,
    TERMS,
    VALUE,
    first_row,
    write_predictor,
)
from nptcs.report.workbook.predictor_models import INPUTS, predictor_models, start_values
from nptcs.report.workbook.predictor_terms import term_formula
from nptcs.surface.fit import fit_points
from nptcs.surface.kinds.gaussian_process import GaussianProcess
from nptcs.surface.kinds.linked import fit_linked
from nptcs.surface.registry import STIFFNESS, FittedSurface, Response, SurfaceRegistry
from nptcs.terms import parse

STRESS = Response("plate_largest_mises", "5000 N", "MPa")
POINTS = [
    (15.0, 1.8, 45.0, 5.0, 1.04),  # the centre of the plates' design: coded zeros
    (10.0, 1.2, 0.0, 5.0, 1.04),
    (12.34, 2.31, 77.7, 5.0, 1.04),
    (19.9, 1.25, 15.5, 4.2, 3.3),
    (8.0, 1.8, 45.0, 4.4, 5.0),  # closer plates than any case
]
"""S, T, A, T-C, S-C."""


def plates(config, spacing):
    """A full factorial in the plates, spacings as a solver realised them."""
    study = config.study("plate")
    levels = [spacing, *(factor.levels for factor in study.factors[1:])]
    x = np.array(np.meshgrid(*levels, indexing="ij")).reshape(3, -1).T
    y = 500 / x[:, 0] + 30 * x[:, 1] + 0.01 * x[:, 2] * x[:, 1] + 200 - 1e-4 * x[:, 2] ** 2
    return x, y + 3 * np.sin(7 * x[:, 0] + 5 * x[:, 1] + x[:, 2])


@pytest.fixture(scope="module")
def predicted(results):
    """The run with polynomials of both studies, of every link, given and realised spacings."""
    config, found = results.config, []
    study = config.study("plate")
    names = [factor.name for factor in study.factors]
    polynomial = parse(study.terms, names)
    tyre = config.tyre
    realised = [tyre.tread_width_mm / tyre.plates_across(s) for s in (10.0, 15.0, 20.0)]
    for spacing, changed in ((study.factors[0].levels, ()), (realised, ("spacing_mm",))):
        x, y = plates(config, spacing)
        kinds = {
            "polynomial": fit_points(x, y, polynomial),
            "polynomial of log": fit_linked("log", x, y, polynomial),
            "polynomial of reciprocal": fit_linked("reciprocal", x, y, polynomial),
        }
        for name, surface in kinds.items():
            found.append(FittedSurface("plate", "published", name, STRESS, surface, changed))
    process = GaussianProcess(tuple(names), x, y, None, np.zeros(4), np.zeros((1, 4)))
    found.append(FittedSurface("plate", "published", "process", STRESS, process))
    rubber = config.study("rubber")
    x = np.array(np.meshgrid([4.0, 4.5, 5.0], [1.0, 2, 3, 4, 5], indexing="ij")).reshape(2, -1).T
    y = 100 + 40 * x[:, 1] + 12 * x[:, 0] + np.cos(3 * x[:, 1] * x[:, 0])
    terms = parse(rubber.terms, [factor.name for factor in rubber.factors])
    stiffness = Response(STIFFNESS)
    own = FittedSurface("rubber", "published", "polynomial", stiffness, fit_points(x, y, terms))
    models = {
        "plate": SurfaceRegistry("plate", tuple(found)),
        "rubber": SurfaceRegistry("rubber", (own,)),
    }
    return replace(results, models=models)


def in_libreoffice(files, folder):
    """Let LibreOffice compute workbooks; return them as it has stored their values."""
    office = shutil.which("soffice")
    if office is None:
        pytest.skip("LibreOffice (soffice) is not installed: the formulas are not computed")
    profile = f"-env:UserInstallation=file://{folder}/profile"
    command = [office, "--headless", profile, "--convert-to", "xlsx:Calc MS Excel 2007 XML"]
    done = subprocess.run(
        [*command, "--outdir", str(folder / "computed"), *map(str, files)],
        capture_output=True,
        text=True,
        check=True,
        timeout=600,
    )
    assert "rror" not in done.stderr, done.stderr
    return [openpyxl.load_workbook(folder / "computed" / file.name, data_only=True)
            for file in files]  # fmt: skip


@pytest.fixture(scope="module")
def computed(predicted, tmp_path_factory):
    """The predictor at each of the points, computed by LibreOffice."""
    folder = tmp_path_factory.mktemp("predictor")
    workbook = Workbook()
    write_predictor(workbook, predicted)
    files = []
    for number, point in enumerate(POINTS):
        for row, value in enumerate(point, start=FIRST_INPUT):
            workbook[PREDICTOR][f"{VALUE}{row}"] = value
        files.append(folder / f"point_{number}.xlsx")
        workbook.save(files[-1])
    return [workbook[PREDICTOR] for workbook in in_libreoffice(files, folder)]


def expected(model, point, tyre):
    """What Python says about a polynomial: prediction, interval, and whether it is valid there."""
    inputs = dict(zip(INPUTS, point, strict=True))
    used = dict(inputs)
    if model.snaps:
        used["spacing_mm"] = tyre.tread_width_mm / tyre.plates_across(inputs["spacing_mm"])
    x = np.array([[used[name] for name in model.fitted.factors]])
    at = pd.DataFrame({name: [value] for name, value in used.items()})
    done = model.fitted.predict(at)
    low, high = model.fitted.surface.interval(x)
    held = all(inputs[name] == value for name, value in model.fixed.items())
    return done.mean[0], low[0], high[0], bool(done.inside[0]) and held


@pytest.mark.parametrize("number", range(len(POINTS)))
def test_a_sheet_predicts_what_python_predicts(predicted, computed, number):
    sheet, tyre = computed[number], predicted.config.tyre
    models, _ = predictor_models(predicted)
    holds = []
    for place, model in enumerate(models):
        value, low, high, inside = expected(model, POINTS[number], tyre)
        row = [cell.value for cell in sheet[first_row(place)]]
        assert row[6] == pytest.approx(value, rel=1e-9)
        assert (row[9] == "inside") == inside
        if not inside:
            assert row[7:9] == ["not assessed", "not assessed"]
        else:
            assert row[7] == pytest.approx(low, rel=1e-9)
            assert row[8] == (pytest.approx(high, rel=1e-9) if high < np.inf else "no upper bound")
        holds.append(inside)
    warning = sheet[f"A{first_row() - 3}"].value
    outside = holds.count(False)
    assert warning.startswith(f"WARNING: {outside} of {len(models)}" if outside else "All 7")


def test_the_points_lie_inside_and_outside(predicted):
    models, _ = predictor_models(predicted)
    tyre = predicted.config.tyre
    inside = [[expected(model, point, tyre)[3] for model in models] for point in POINTS]
    assert [any(row) for row in inside] == [True, True, True, False, False]
    assert all(inside[0])


def test_what_is_outside_is_named(computed, predicted):
    models, _ = predictor_models(predicted)
    rubber = [model.fitted.study for model in models].index("rubber")
    said = [sheet[f"J{first_row(rubber)}"].value for sheet in computed]
    assert said[0] == "inside"
    assert said[1] == "outside: S, held by the study; T, held by the study; A, held by the study;"
    assert computed[4][f"J{first_row()}"].value == (
        "outside: S; T-C, held by the study; S-C, held by the study;"
    )


def test_every_polynomial_is_there_and_other_surfaces_are_named(predicted):
    models, others = predictor_models(predicted)
    assert [model.link for model in models[:6]] == ["identity", "log", "reciprocal"] * 2
    assert [model.snaps for model in models] == [False] * 3 + [True] * 3 + [False]
    assert others == {"process": 1}
    workbook = Workbook()
    write_predictor(workbook, predicted)
    texts = [cell.value for row in workbook[PREDICTOR].iter_rows() for cell in row]
    assert any("1 × process" in str(text) for text in texts)


def test_inputs_begin_with_the_reference_design(predicted):
    models, _ = predictor_models(predicted)
    assert list(start_values(predicted, models).values()) == [15.0, 1.8, 45.0, 5.0, 1.04]


def test_a_term_never_asks_for_zero_to_the_zero():
    assert term_formula((0, 0, 3), ["A1", "A2", "A3"]) == "A3^3"
    assert term_formula((0, 0, 0), ["A1", "A2", "A3"]) == "1"


def test_a_run_without_polynomials_has_no_predictor(results):
    assert PREDICTOR not in openpyxl.load_workbook(io.BytesIO(build_workbook(results))).sheetnames


def test_the_whole_workbook_opens_without_an_error_value(predicted, tmp_path):
    file = tmp_path / "workbook.xlsx"
    file.write_bytes(build_workbook(predicted))
    (workbook,) = in_libreoffice([file], tmp_path)
    assert {PREDICTOR, TERMS} <= set(workbook.sheetnames)
    faults = [
        (sheet.title, cell.coordinate)
        for sheet in workbook
        for row in sheet.iter_rows()
        for cell in row
        if cell.data_type == "e"
    ]
    assert faults == []
