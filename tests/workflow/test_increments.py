"""What a change reruns: content counts, dates do not, words only where they are printed."""

import os

import pytest
import yaml

LATE = {"account", "report", "verdict", "problems", "statistics"}
"""Rules that print; nothing that is measured or solved depends on them."""
OLD = 946684800  # a date in the year 2000, as archives and `cp -p` restore it


def remark(project):
    rows, columns = project.read_sheet()
    rows[0]["remarks"] = "tab came off"
    project.write_sheet(columns, rows)


def comment_in_profile(project):
    for profile in project.path("config/formats").glob("*.yaml"):
        profile.write_text("# ours\n" + profile.read_text("utf-8"), "utf-8")


def settings(change):
    def edit(project):
        path = project.path("config/small.yaml")
        small = yaml.safe_load(path.read_text())
        change(small)
        path.write_text(yaml.safe_dump(small, sort_keys=False))

    return edit


@settings
def time_limits_and_cache(small):
    for options in small["solvers"].values():
        options["timeout_s"] = 1234.5
    small["solvers"]["fe_tyre"]["spoke_cache"] = "results/elsewhere"


@settings
def titles(small):
    for study in small["studies"]:
        study["title"] = "Another heading"
        for factor in study["factors"]:
            factor["label"] = "another label"


def code(name, old, new):
    return lambda project: project.edit(f"workflow/src/nptcs/{name}", old, new)


def with_date(project, path, content):
    path.write_bytes(content)
    os.utime(path, (OLD, OLD))


def raw_file_with_an_old_date(project):
    rows, _ = project.read_sheet()
    raw = project.path("raw_data/example") / rows[0]["force_file"]
    with_date(project, raw, raw.read_bytes() + b"\n")


def published_table_with_an_old_date(project):
    table = project.path("raw_data/published/table10_spoke_stiffness.csv")
    with_date(project, table, table.read_bytes() + b"# seen\n")


def new_dates(project):
    for folder in ("raw_data", "config", "workflow"):
        for path in project.path(folder).rglob("*.*"):
            path.touch()


CHANGES = [
    # change, rules that must run, rules that may run as well
    (remark, {"report"}, LATE),
    (comment_in_profile, {"report"}, {"verdict"}),
    (time_limits_and_cache, {"report"}, {"verdict"}),
    (titles, {"report"}, {"verdict"}),
    (code("errors.py", '". Remedy: {', '". What to do: {'), {"report"}, LATE),
    (code("config/tyre.py", 'description="', 'description="The '), {"report"}, LATE),
    (code("__init__.py", '"0.1.0"', '"0.1.1"'), {"report"}, LATE),
    (new_dates, set(), set()),
    (raw_file_with_an_old_date, {"ingest", "reduce", "account", "report"}, None),
    (published_table_with_an_old_date, {"lca_validation", "report", "solve"}, None),
]


@pytest.mark.parametrize(
    ("change", "must", "may"),
    CHANGES,
    ids=["remark", "comment in a profile", "time limits, cache", "titles", "words of an error",
         "description of a setting", "version of the package", "new dates", "old raw file",
         "old published table"],
)  # fmt: skip
def test_a_change_reruns_what_it_decides(project, change, must, may):
    change(project)
    planned = set(project.planned()) - {"all"}
    assert planned >= must
    if may is not None:
        assert planned <= must | may
