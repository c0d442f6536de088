"""A faulty configuration is refused with a message that says where the fault is and what to do."""

import copy
from pathlib import Path

import pytest
import yaml

from nptcs.commands.fe_calibrate import CASES
from nptcs.config.root import read_config
from nptcs.errors import InputError
from nptcs.solvers.registry import check_study, load_solver, module_of

ROOT = Path(__file__).parents[3]
DEFAULT = yaml.safe_load((ROOT / "config" / "config.yaml").read_text())


def changed(path, value):
    config = copy.deepcopy(DEFAULT)
    place = config
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return config


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        (["calibraton"], {}, "calibraton: unknown key; did you mean 'calibration'?"),
        (["studies", 0, "levels"], [1], "studies.0.levels: unknown key"),
        (["studies", 0, "factors", 0, "level"], [1], "did you mean 'levels'?"),
        (["studies", 0, "factors", 0, "levels"], [10], "studies.0.factors.0.levels"),
        (["studies", 0, "factors", 0, "levels"], [10, 10], "levels must increase"),
        (["studies", 0, "factors", 0, "levels"], [15, 10], "levels must increase"),
        (["studies", 0, "factors", 0, "levels"], [10, "x"], "studies.0.factors.0.levels.1"),
        (["studies", 0, "factors", 0, "levels"], [1.0, float("nan")], "finite number"),
        (["studies", 0, "load_n"], -5, "studies.0.load_n"),
        (["studies", 0, "load_n"], 5e6, "load_n must be between 1 and 100000 N, got 5e+06"),
        (["studies", 0, "factors", 2, "levels"], [0, 300], "angle_deg must be between -90 and 90"),
        (["studies", 0, "factors", 1, "levels"], [-1, 2], "thickness_mm must be above 0"),
        (["studies", 0, "fixed"], {"spoke_c10_mpa": 1040}, "spoke_c10_mpa must be above 0 and at"),
        (["studies", 0, "fixed"], {"angle_deg": 3}, "both varied and fixed: ['angle_deg']"),
        (["studies", 0, "solver_options"], {"lca": {}}, "which `solvers` does not run"),
        (["studies", 0, "calibration_cases"], {"lca": [1]}, "calibration_cases for ['lca']"),
        (
            ["studies", 0, "calibration_cases"],
            {"fe_tyre_paper": [63, 64]},
            "[64] not among cases 1 to 63",
        ),
        (["studies", 1, "neutral_line_cases"], [0], "neutral_line_cases: [0] not among cases 1 to"),
        (["studies", 1, "published_spoke_stiffness"], "x.csv", "the only factor is spoke_c10_mpa"),
        (["studies", 1, "name"], "plate", "a name is used twice"),
        (["studies"], [], "studies"),
        (["sensitivity", "rules"], ["mean"], "sensitivity.rules.0"),
        (["tyre"], {"rim_diameter_mm": 700}, "radii must increase"),
        (["tyre"], {"plate_width_mm": 216}, "plate_width_mm must not exceed tread_width_mm"),
        (["tyre"], {"rim_width_mm": 165.1}, "tyre.rim_width_mm"),
        (["campaign"], {"batches": 0}, "campaign.batches"),
    ],
)
def test_each_fault_is_named_with_its_key(path, value, message):
    with pytest.raises(InputError) as refusal:
        read_config(changed(path, value))
    assert message in str(refusal.value)
    assert "config.yaml" in str(refusal.value)


def test_all_faults_are_in_one_message():
    config = changed(["studies", 0, "load_n"], -5)
    config["reprot"] = {}
    with pytest.raises(InputError) as refusal:
        read_config(config)
    assert "load_n" in str(refusal.value)
    assert "did you mean 'report'?" in str(refusal.value)


def checked(path, value):
    config = read_config(changed(path, value))
    for study in config.studies:
        check_study(study, config.solver_options(study))


def test_default_configuration_is_sound():
    checked(["report"], {})


def test_a_solver_that_cannot_see_a_factor_refuses_it_by_name():
    with pytest.raises(InputError) as refusal:
        checked(["studies", 0, "solvers"], ["published", "lca", "fe_tyre_paper"])
    assert "solver 'lca' does not use angle_deg, spacing_mm, thickness_mm" in str(refusal.value)
    assert "studies.plate.solvers" in str(refusal.value)


def test_a_solver_that_lacks_a_value_says_which():
    config = copy.deepcopy(DEFAULT)
    config["studies"][1]["factors"] = config["studies"][1]["factors"][1:]
    config["studies"][1]["solvers"] = ["lca"]
    config["studies"][1]["solver_options"] = {}
    config["studies"][1]["neutral_line_cases"] = []
    for key in ("terms", "surfaces", "responses"):
        config["studies"][1][key] = []
    config = read_config(config)
    study = config.studies[1]
    with pytest.raises(InputError, match="solver 'lca' needs shear_band_c10_mpa"):
        check_study(study, config.solver_options(study))


def test_unknown_solvers_and_options_are_named():
    with pytest.raises(InputError, match="unknown solver"):
        checked(["studies", 1, "solvers"], ["published", "lcaa"])
    with pytest.raises(InputError, match="did you mean 'archive'"):
        checked(["studies", 0, "solver_options"], {"published": {"archve": "x.csv"}})
    with pytest.raises(InputError, match="does not exist"):
        load_solver(module_of("own", {"module": "no/such/file.py"}))


SPOKE = next(number for number, s in enumerate(DEFAULT["studies"]) if s["name"] == "spoke")


def test_single_spokes_have_no_surface():
    with pytest.raises(InputError) as refusal:
        checked(["studies", SPOKE, "terms"], ["1", "spoke_c10_mpa"])
    assert "give no vertical stiffness" in str(refusal.value)
    assert "studies.spoke.solvers" in str(refusal.value)
    assert "fe_spoke" in str(refusal.value)


def test_table_10_for_a_study_of_tyres_is_refused():
    config = copy.deepcopy(DEFAULT)
    config["studies"][SPOKE] |= {"solvers": ["lca"], "fixed": {"shear_band_c10_mpa": 5}}
    config = read_config(config)
    study = config.study("spoke")
    with pytest.raises(InputError, match="no solver of this study computes single spokes"):
        check_study(study, config.solver_options(study))


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("plate", {"solvers": ["fe_tyre_paper"], "solver_options": {}}),
        ("plate", {"calibration_cases": {"published": [1]}}),
        ("spoke", {"calibration_cases": {"fe_spoke": [1]}}),
    ],
    ids=["without published", "of published", "of a spoke"],
)
def test_calibration_cases_that_are_never_compared_are_refused(name, change):
    config = copy.deepcopy(DEFAULT)
    next(study for study in config["studies"] if study["name"] == name).update(change)
    config = read_config(config)
    study = config.study(name)
    with pytest.raises(InputError, match="calibration cases have no effect") as refusal:
        check_study(study, config.solver_options(study))
    assert refusal.value.column == f"studies.{name}.calibration_cases"
    assert refusal.value.value == ", ".join(study.calibration_cases)


def test_the_calibration_cases_are_those_of_the_calibration():
    """The default study names the cases on which `nptcs fe-calibrate` fits the section."""
    plate = read_config(DEFAULT).study("plate")
    assert set(plate.calibration_cases["fe_tyre_paper"]) == set(CASES)
