"""The whole pipeline in a copied tree: what runs, what reruns, and what a fault leaves behind."""

import json
import re

import openpyxl
import yaml

SENSITIVITY = "workflow/src/nptcs/surface/sensitivity/gradients.py"


def test_everything_is_there_and_a_second_run_does_nothing(finished):
    for name in ("report.html", "workbook.xlsx", "verdict.txt", "material_card.json"):
        assert finished.path(f"results/{name}").stat().st_size > 0
    assert finished.planned() == {}
    again = finished.snakemake()
    assert again.returncode == 0
    assert "Nothing to be done" in again.stdout + again.stderr


def test_tables_have_the_documented_columns_and_plausible_numbers(finished):
    cases = finished.rows("cases.csv")
    assert {row["status"] for row in cases} == {"ok"}
    assert len(cases) == 20
    assert list(cases[0])[:5] == ["study", "case_id", "solver", "status", "message"]
    surface = finished.rows("rubber_surface.csv")
    assert list(surface[0])[:5] == [
        "solver",
        "term",
        "coefficient_natural",
        "coefficient_coded",
        "standard_error",
    ]
    ranked = sorted(
        (row for row in finished.rows("impact.csv") if row["rule"] == "domain_mean_absolute"),
        key=lambda row: -float(row["impact"]),
    )
    assert ranked[0]["factor"] == "spoke_c10_mpa"
    specimens = finished.rows("specimens.csv")
    assert list(specimens[0])[:10] == (
        [
            "specimen",
            "test",
            "material",
            "property",
            "value",
            "unit",
            "rule",
            "range",
            "points",
            "flags",
        ]
    )
    card = json.loads(finished.path("results/material_card.json").read_text())
    assert card["plies"]["cfrp"]["synthetic"] is True
    assert card["rubbers"]["rubber_75A"]["constants"]["c10_mpa"]["value"] > 1


def test_computed_results_are_next_to_the_paper_s(finished):
    """Coarse meshes: the right order of magnitude, every table filled."""
    rows = finished.rows("stiffness_against_published.csv")
    by_fe = [row for row in rows if row["solver"] == "fe_tyre"]
    assert [row["published_stiffness_n_per_mm"] for row in by_fe] == ["536.71", "591.18"]
    assert all(abs(float(row["difference_percent"])) < 10 for row in by_fe)
    assert {(row["study"], row["solver"]) for row in finished.rows("stiffness_errors.csv")} == {
        ("rubber", "lca"),
        ("band", "lca"),
        ("band", "fe_tyre"),
    }
    levels = finished.rows("stiffness_by_level.csv")
    assert {row["level"] for row in levels if row["study"] == "band"} == {"4.0", "5.0"}
    spokes = finished.rows("spoke_stiffness.csv")
    assert [row["published_tension_stiffness_n_per_mm"] for row in spokes] == ["30.2", "132.57"]
    assert all(abs(float(row["compression_difference_percent"])) < 25 for row in spokes)
    assert len(finished.rows("spoke_curves.csv")) == 2 * 57
    lines = finished.rows("neutral_line.csv")
    assert {(row["case_id"], row["solver"]) for row in lines} == {
        ("band_002", "lca"),
        ("band_002", "fe_tyre"),
    }
    deepest = {
        solver: min(float(row["radial_mm"]) for row in lines if row["solver"] == solver)
        for solver in ("lca", "fe_tyre")
    }
    assert abs(deepest["lca"] / deepest["fe_tyre"] - 1) < 0.25
    loads = {row["study"]: row["load_n"] for row in finished.rows("cases.csv")}
    assert loads == {"rubber": "5000.0", "band": "5000.0", "spoke": ""}
    assert not finished.path("results/tables/spoke_surface.csv").exists()
    report = finished.path("results/report.html").read_text(encoding="utf-8")
    for text in ("Single spoke (section 4.3.1) against the paper", "What the neutral lines show"):
        assert text in report
    workbook = openpyxl.load_workbook(finished.path("results/workbook.xlsx"))
    assert {"spoke_stiffness", "stiffness_against_published"} <= set(workbook.sheetnames)
    assert "neutral_line" not in workbook.sheetnames  # raw points are a CSV file next to it


def test_a_case_that_fails_is_a_row_next_to_the_published_one(project):
    small = yaml.safe_load(project.path("config/small.yaml").read_text())
    small["solvers"]["fe_tyre"] |= {"load_steps": 6, "timeout_s": 0.2}
    small["solvers"]["fe_spoke"]["spoke_mesh"] |= {"gap_columns": 2}
    small["solvers"]["fe_spoke"] |= {"timeout_s": 0.2}
    project.path("config/small.yaml").write_text(yaml.safe_dump(small, sort_keys=False))

    run = project.snakemake()

    assert run.returncode != 0
    rows = project.rows("stiffness_against_published.csv")
    failed = [row for row in rows if row["solver"] == "fe_tyre"]
    assert [row["status"] for row in failed] == ["timeout", "timeout"]
    assert [row["computed_stiffness_n_per_mm"] for row in failed] == ["", ""]
    assert [row["published_stiffness_n_per_mm"] for row in failed] == ["536.71", "591.18"]
    errors = {(row["study"], row["solver"]): row for row in project.rows("stiffness_errors.csv")}
    assert (errors["band", "fe_tyre"]["cases"], errors["band", "fe_tyre"]["compared"]) == ("2", "0")
    assert errors["band", "lca"]["compared"] == "2"
    spokes = project.rows("spoke_stiffness.csv")
    assert [row["status"] for row in spokes] == ["timeout", "timeout"]
    assert spokes[0]["published_tension_stiffness_n_per_mm"] == "30.2"
    report = project.path("results/report.html").read_text(encoding="utf-8")
    assert "fe_tyre: timeout" in report
    assert {row["solver"] for row in project.rows("neutral_line.csv")} == {"lca"}


def test_an_edited_solver_solves_its_cases_again(project):
    project.edit("workflow/src/nptcs/solvers/published.py", 'version="1"', 'version="2"')
    run, solved = project.solved_in_logs()
    assert run.returncode == 0, run.stderr[-3000:]
    assert len(re.findall(r"rubber/published \d/6 \S+ ok \([\d.]+ s", solved)) == 6
    assert "rubber/lca 1/6" not in solved
    assert {r["solver_version"] for r in project.rows("cases.csv")} >= {"2"}


def test_a_deleted_table_is_made_again_and_nothing_is_solved(project):
    before = project.path("results/tables/impact.csv").read_bytes()
    project.path("results/tables/impact.csv").unlink()
    plan = project.planned()
    assert plan["sensitivity"] == 1
    assert not [n for n in plan if n.startswith(("ingest_", "design", "solve", "surface"))]
    assert project.snakemake().returncode == 0
    assert project.path("results/tables/impact.csv").read_bytes() == before


def test_the_report_alone_solves_nothing(project):
    project.path("results/report.html").unlink()
    run = project.snakemake("report")
    assert run.returncode == 0
    assert project.path("results/report.html").is_file()
    assert "rule solve" not in run.stderr


FAULTY_STUDY = {
    "studies": [
        {
            "name": "faulty",
            "title": "Cases that fail",
            "factors": [
                {"name": "kind", "label": "kind", "unit": "-", "levels": [1, 2, 3, 9, 10, 11]},
                {"name": "other", "label": "other", "unit": "-", "levels": [0, 1]},
            ],
            "solvers": ["faulty"],
            "terms": ["1", "kind", "other"],
        }
    ],
    "solvers": {"faulty": {"module": "tests/unit/campaign/faulty_solver.py"}},
}


def test_cases_that_raise_hang_or_die_are_rows_and_the_run_fails_after_the_report(project):
    project.path("config/faulty.yaml").write_text(yaml.safe_dump(FAULTY_STUDY))

    run = project.snakemake(config="config/faulty.yaml")

    assert run.returncode != 0
    cases = {row["case_id"]: row for row in project.rows("cases.csv")}
    assert len(cases) == 12
    ended = {(row["kind"], row["status"]) for row in cases.values()}
    assert ended == {
        ("1.0", "error"),
        ("2.0", "timeout"),
        ("3.0", "error"),
        ("9.0", "ok"),
        ("10.0", "ok"),
        ("11.0", "ok"),
    }
    assert "the mesh has folded" in cases["faulty_001"]["message"]
    assert "timeout_s" in cases["faulty_003"]["message"]
    assert "SIGKILL" in cases["faulty_005"]["message"]
    report = project.path("results/report.html").read_text(encoding="utf-8")
    assert "the mesh has folded" in report
    assert "SIGKILL" in report
    problems = project.rows("problems.csv")
    assert len([row for row in problems if row["stage"] == "solve"]) == 6
    assert "faulty_001" in run.stderr
    assert not project.path("results/verdict.txt").exists()


def test_bad_specimens_are_named_and_the_others_are_used(project):
    rows, columns = project.read_sheet()
    tension = [row for row in rows if row["test"] == "tension" and row["orientation_deg"] == "0"]
    rubber = [row for row in rows if row["material"] == "rubber_75A"]
    tension[0]["force_file"] = "no_such_file.csv"
    rubber[0]["thickness_mm"] = ""
    rubber[1]["test"] = "bending"
    project.write_sheet(columns, rows)

    run = project.snakemake()

    assert run.returncode != 0
    problems = {row["name"]: row["message"] for row in project.rows("problems.csv")}
    assert "no_such_file.csv" in problems[tension[0]["specimen"]]
    no_thickness = next(m for m in problems.values() if "thickness_mm" in m)
    assert "specimens.csv:" in no_thickness
    assert rubber[0]["specimen"] in no_thickness
    assert any("bending" in message for message in problems.values())
    read = {row["specimen"] for row in project.rows("specimens.csv")}
    assert tension[1]["specimen"] in read
    assert tension[0]["specimen"] not in read
    report = project.path("results/report.html").read_text(encoding="utf-8")
    assert "no_such_file.csv" in report


def test_a_misspelt_key_stops_everything_before_it_starts(project):
    project.edit("config/small.yaml", "studies:", "campagin: {batches: 2}\nstudies:")
    run = project.snakemake()
    assert run.returncode != 0
    assert "campagin: unknown key; did you mean 'campaign'?" in run.stderr + run.stdout
    # the report that is there still belongs to its tables, but not to this configuration
    assert "from an earlier configuration" in run.stderr + run.stdout
    assert project.path("results/report.html").exists()


def test_terms_that_the_design_cannot_estimate_are_refused_before_anything_is_solved(project):
    project.edit("config/small.yaml", "spoke_c10_mpa^2]", "shear_band_c10_mpa^2]")
    run = project.snakemake()
    assert run.returncode != 0
    assert "shear_band_c10_mpa^2 with" in run.stderr
    assert "rule " not in run.stderr


def test_a_failed_run_leaves_no_report_that_looks_current(project):
    rows, columns = project.read_sheet()
    for row in rows:
        if row["orientation_deg"] == "0":
            row["force_file"] = "lost_" + row["force_file"]
    project.write_sheet(columns, rows)

    run = project.snakemake()

    assert run.returncode != 0
    assert "e1_mpa" in run.stderr + run.stdout
    assert not project.path("results/report.html").exists()
    assert project.path("results/report.stale.html").exists()


def test_batches_recompute_nothing(project):
    with project.path("config/small.yaml").open("a") as stream:
        stream.write("campaign: {batches: 2}\n")
    before = {row["case_id"] + row["solver"]: row for row in project.rows("cases.csv")}
    run = project.snakemake()
    assert run.returncode == 0, run.stderr[-3000:]
    assert re.search(r"ok \([\d.]+ s", run.stderr) is None
    after = {row["case_id"] + row["solver"]: row for row in project.rows("cases.csv")}
    assert after == before
