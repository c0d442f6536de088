"""What the explorer is given, and what it can copy."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml

from nptcs.config.root import read_config
from nptcs.config.studies.response import RESPONSE_KINDS
from nptcs.report.explorer import markup
from nptcs.report.explorer.markup import SCRIPTS, asset, explorer_markup, scripts
from nptcs.report.explorer.models import WRITERS
from nptcs.report.explorer.payload import explorer_payload
from nptcs.report.explorer.shared import share_covariances
from nptcs.report.explorer.words import page_words
from nptcs.report.sections.explorer import explorer_section
from nptcs.report.tables.response_titles import RESPONSE_TITLES
from nptcs.surface.registry import STIFFNESS, FittedSurface, Response, SurfaceRegistry
from nptcs.surface.stored import READERS
from nptcs.tables.published.stiffness import StiffnessAgainstPublished
from nptcs.tables.result_table import ReportSection


def registry(results, name):
    surface = results.surfaces[name]["published"]
    response = Response(STIFFNESS, unit="N/mm")
    fitted = FittedSurface(name, "published", "polynomial", response, surface)
    return SurfaceRegistry(name, (fitted,))


@pytest.fixture
def with_models(results):
    models = {study.name: registry(results, study.name) for study in results.config.studies}
    return replace(results, models=models)


def test_every_stored_kind_and_every_response_has_its_words():
    assert {kind.__name__ for kind in WRITERS} == set(READERS)
    assert set(RESPONSE_TITLES) == set(RESPONSE_KINDS)


def test_scripts_use_every_text_that_they_are_given_and_no_other():
    text = "".join(asset(name) for name in SCRIPTS)
    words = page_words()
    assert {key for key in words if f'"{key}"' not in text and f'say("{key}"' not in text} <= {
        "refused",
        "flagged",
        "absent",
    }
    assert set(re.findall(r'say\(\s*"(\w+)"', text)) <= set(words)


def test_values_in_texts_are_those_that_scripts_give():
    text = "".join(asset(name) for name in SCRIPTS)
    for key, words in page_words().items():
        for name in re.findall(r"\{(\w+)\}", words):
            assert re.search(rf"\b{name}\b\s*[:,}}]", text), (key, name)


def test_a_run_without_surfaces_has_no_explorer(results):
    assert explorer_payload(results)["studies"] == []
    section = explorer_section(results, {})
    assert section.identifier is ReportSection.EXPLORE
    assert section.blocks == ()


def test_numbers_of_a_surface_are_exact_and_nothing_else_is_needed(with_models):
    payload = json.loads(json.dumps(explorer_payload(with_models), allow_nan=False))
    study = payload["studies"][0]
    response = study["solvers"][0]["responses"][0]
    surface = with_models.surfaces["plate"]["published"]
    plain = response["surfaces"][0]["plain"]
    assert plain["coefficients"] == surface.coefficients_coded.tolist()
    assert response["values"] == surface.y.tolist()
    assert study["solvers"][0]["points"][response["points"]] == surface.x.tolist()
    assert (response["name"], response["at"]) == ("secant_stiffness", "5000 N")
    assert plain["quantile"] == pytest.approx(2.0066, abs=1e-4)  # t of 52 degrees of freedom
    assert study["fixed"] == {"shear_band_c10_mpa": 5.0, "spoke_c10_mpa": 1.04}


def test_the_bias_is_that_of_blind_cases_alone(with_models):
    rows = {
        "study": "plate",
        "case_id": ["plate_001", "plate_002", "plate_003"],
        "case": [1, 2, 3],
        "solver": "published",
        "status": "ok",
        "computed_stiffness_n_per_mm": 100.0,
        "published_stiffness_n_per_mm": 100.0,
        "difference_percent": [-1.0, 2.0, 50.0],
        "used_for_calibration": [False, False, True],
    }
    table = StiffnessAgainstPublished.validate(pd.DataFrame(rows))
    tables = {**with_models.tables, "stiffness_against_published.csv": table}
    solver = explorer_payload(replace(with_models, tables=tables))["studies"][0]["solvers"][0]
    assert solver["bias"] == {
        "cases": 2,
        "mean_percent": 0.5,
        "low_percent": -1.0,
        "high_percent": 2.0,
    }


def test_no_text_can_end_the_block_of_data(with_models):
    payload = {**explorer_payload(with_models), "words": {"a": "</script><!-- <b>"}}
    text = explorer_markup(payload, "off")
    data = re.search(r'id="explorer-data">(.*?)</script>', text, re.DOTALL)
    assert json.loads(data[1])["words"]["a"] == "</script><!-- <b>"


def test_scripts_keep_every_statement_when_they_are_packed():
    packed = scripts()
    assert "//" not in re.sub(r'"[^"]*"|`[^`]*`', "", packed)
    kept = [line.strip() for name in SCRIPTS for line in asset(name).splitlines()]
    assert [line for line in kept if line and not line.startswith("//")] == packed.split("\n")


def test_the_page_stays_small(with_models):
    """Half of the bound of 250 kB is left to the surfaces of a study."""
    text = explorer_markup({**explorer_payload(with_models), "studies": []}, "off")
    assert len(text.encode()) < 125_000


def test_the_config_block_is_a_further_case_of_the_study():
    """As the page writes it for spacing 12, thickness 2 and angle 30."""
    lines = (Path(markup.__file__).parents[5] / "config" / "config.yaml").read_text("utf-8")
    block = "    further_cases:\n      - {spacing_mm: 12, thickness_mm: 2, angle_deg: 30}\n"
    head, rest = lines.split("    load_n: 5000\n", 1)
    study = read_config(yaml.safe_load(head + block + "    load_n: 5000\n" + rest)).study("plate")
    assert study.number_of_cases() == 64
    assert np.array(list(study.further_cases[0].values())).tolist() == [12.0, 2.0, 30.0]


def test_equal_covariances_are_written_once_in_units_of_the_variance():
    one = {"covariance": [4.0, 2.0, 8.0], "sd": 2.0}
    other = {"deep": [{"covariance": [9.0, 4.5, 18.0], "sd": 3.0}]}
    exact = {"covariance": [0.0, 0.0, 0.0], "sd": 0.0}
    shared = []
    share_covariances([one, other, exact], shared)
    assert shared == [[1.0, 0.5, 2.0]]
    assert one["covariance"] == other["deep"][0]["covariance"] == 0
    assert exact["covariance"] == [0.0, 0.0, 0.0]
