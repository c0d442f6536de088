"""An archive contains every file that the configuration names; files elsewhere are refused."""

from pathlib import Path

import pytest
import yaml

from nptcs.archive.contents import RESULTS, ArchivedAs, contents_of, study_inputs
from nptcs.config.root import read_config
from nptcs.errors import InputError
from nptcs.tables.catalogue import result_files

ROOT = Path(__file__).parents[3]
DEFAULT = yaml.safe_load((ROOT / "config" / "config.yaml").read_text(encoding="utf-8"))
CONFIG = read_config(DEFAULT)


def texts(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [text for part in value for text in texts(part)]
    return [value] if isinstance(value, str) else []


def test_every_file_that_the_configuration_names_is_an_input():
    """Whatever key names it: a key that is added later is noticed here."""
    named = {text for text in texts(CONFIG.model_dump(mode="json")) if (ROOT / text).is_file()}
    assert len(named) > 5
    assert {ROOT / text for text in named} <= set(study_inputs(ROOT, CONFIG))


@pytest.fixture
def project(tmp_path):
    """A project folder with its inputs, and results of the right names."""
    for name in ("raw_data", "config"):
        (tmp_path / name).symlink_to(ROOT / name)
    surfaces = [study.name for study in CONFIG.studies if study.terms]
    for name in [*RESULTS, *(f"tables/{file}" for file, _, _ in result_files(surfaces))]:
        file = tmp_path / "results" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("x", encoding="utf-8")
    return tmp_path


def test_inputs_results_and_the_package_belong_to_it(project):
    found = contents_of(project, CONFIG)
    assert found["raw_data/example/T0-1_wdw.txt"][1] is ArchivedAs.INPUT
    assert found["results/tables/cases.csv"][1] is ArchivedAs.RESULT
    assert found["workflow/src/nptcs/cli.py"][1] is ArchivedAs.CODE
    assert not any("__pycache__" in name for name in found)


def test_a_study_that_is_not_finished_is_refused(project):
    (project / "results" / "tables" / "cases.csv").unlink()
    with pytest.raises(InputError, match="not finished") as refusal:
        contents_of(project, CONFIG)
    assert "cases.csv" in str(refusal.value)


def test_an_input_outside_the_project_is_refused(project, tmp_path_factory):
    outside = tmp_path_factory.mktemp("elsewhere") / "table11.csv"
    outside.write_text("x", encoding="utf-8")
    validation = CONFIG.lca_validation.model_copy(update={"published": str(outside)})
    config = CONFIG.model_copy(update={"lca_validation": validation})
    with pytest.raises(InputError, match="is outside the project folder"):
        contents_of(project, config)
