"""Published values are compared with a study only under the conditions of their tables."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml

from nptcs.compare.conditions import load_fault, plate_faults, range_faults, surface_faults
from nptcs.compare.impact import with_published
from nptcs.config.studies.study import Study

ROOT = Path(__file__).parents[3]
STUDIES = {
    study["name"]: study
    for study in yaml.safe_load((ROOT / "config/config.yaml").read_text("utf-8"))["studies"]
}


OF_ALL_CASES = ("decisions", "neutral_line_cases", "calibration_cases")


def study(name, **changed):
    kept = {key: value for key, value in STUDIES[name].items() if key not in OF_ALL_CASES}
    return Study.model_validate({**kept, **changed})


def factors(name, factor, levels):
    return [
        {**one, "levels": levels if one["name"] == factor else one["levels"]}
        for one in STUDIES[name]["factors"]
    ]


@pytest.mark.parametrize("name", ["plate", "rubber"])
def test_the_papers_own_studies_meet_its_conditions(name):
    assert surface_faults(study(name)) == []


def test_another_load_is_refused_unless_the_archive_is_of_that_load():
    assert "5000 N, the study plate at 4000 N" in load_fault(study("plate", load_n=4000))
    archive = {"published": {"archive": "mine.csv", "archive_load_n": 4000}}
    assert load_fault(study("plate", load_n=4000, solver_options=archive)) == ""


@pytest.mark.parametrize(
    ("name", "factor", "levels", "said"),
    [
        ("plate", "spacing_mm", [12, 15, 18], "10 to 20 mm in the published tables, 12 to 18 mm"),
        ("rubber", "spoke_c10_mpa", [1, 3], "1 to 5 MPa in the published tables, 1 to 3 MPa"),
        ("rubber", "spoke_c10_mpa", [{"rubber": "a"}, {"rubber": "b"}], "tested rubbers"),
    ],
)
def test_other_ranges_are_refused(name, factor, levels, said):
    changed = study(name, factors=factors(name, factor, levels), reference={})
    (fault,) = range_faults(changed)
    assert said in fault


def test_inner_levels_do_not_matter():
    other = factors("plate", "spacing_mm", [10, 12.5, 20])
    assert surface_faults(study("plate", factors=other)) == []


def test_other_plates_than_the_fiducial_ones_are_refused():
    fixed = {"spacing_mm": 15, "thickness_mm": 1.2, "angle_deg": 45}
    (fault,) = plate_faults(study("rubber", fixed=fixed))
    assert "thickness_mm is 1.8 in the published tables, 1.2 in the study rubber" in fault


def test_a_refused_study_has_no_published_impact_and_no_rank():
    impact = pd.DataFrame(
        {
            "solver": "lca",
            "study": ["plate", "rubber"],
            "factor": ["spacing_mm", "spoke_c10_mpa"],
            "rule": "domain_mean_absolute",
            "gradient": [5.0, 80.0],
            "range": [10.0, 4.0],
            "impact": [50.0, 320.0],
            "nominal_range": [10.0, 4.0],
            "values_used": "given",
            "cases": 63,
            "failed_cases": 0,
            "near_tie_with": "",
        }
    )
    table_9 = pd.read_csv(ROOT / "raw_data/published/table9_impact.csv")
    shown = with_published(impact, table_9)["published_impact"]
    np.testing.assert_allclose(shown, [54.93, 319.83])
    refused = with_published(impact, table_9, ["plate"]).set_index("study")
    assert np.isnan(refused.loc["plate", "published_impact"])
    assert pd.isna(refused.loc["plate", "rank"])
    assert refused.loc["rubber", "published_impact"] == 319.83
