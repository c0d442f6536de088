"""What a change reruns: each row changes a finished project and says which jobs and cases follow.

``python benchmarks/increments.py`` prints the rows as the table of docs/runs.md.
"""

from __future__ import annotations

import csv
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import yaml

ROOT = Path(__file__).parents[2]
CONFIG = "config/increments.yaml"
SOLVER = "own_solver.py"
OLD = 946684800.0
"""A date in the year 2000, as archives and ``cp -p`` restore it."""

OWN_SOLVER = '''
"""A stub that rests on the ply."""
from nptcs.solvers.contract import Solver, SolverResult

def solve(inputs):
    "Return a stiffness without a model."
    stiffness = inputs.ply["e1_mpa"] / 1000.0 + 10.0 * inputs.values["spoke_c10_mpa"]
    stiffness += 3.0 * inputs.values["shear_band_c10_mpa"] ** 2
    return SolverResult(status="ok", vertical_stiffness_n_per_mm=stiffness,
                        displacement_mm=inputs.load_n / stiffness)

SEEN = frozenset({"shear_band_c10_mpa", "spoke_c10_mpa"})
SOLVER = Solver("own", "1", solve, SEEN, about="a stub", needs_ply=True)
'''

STUDY = {
    "name": "tested",
    "title": "Tested rubbers and a ply",
    "factors": [
        {"name": "shear_band_c10_mpa", "label": "band", "unit": "MPa", "levels": [4, 5]},
        {
            "name": "spoke_c10_mpa",
            "label": "spokes",
            "unit": "MPa",
            "levels": [{"rubber": "rubber_75A"}, 2.0, {"rubber": "rubber_88A"}],
        },
    ],
    "solvers": ["lca", "own"],
    "terms": ["1", "shear_band_c10_mpa", "spoke_c10_mpa"],
}


def write_config(folder: Path) -> None:
    """Add a study on tested materials to the small configuration."""
    small = yaml.safe_load((folder / "config/small.yaml").read_text(encoding="utf-8"))
    small["studies"].append(STUDY)
    small["solvers"]["own"] = {"module": SOLVER}
    (folder / CONFIG).write_text(yaml.safe_dump(small, sort_keys=False), encoding="utf-8")
    (folder / SOLVER).write_text(OWN_SOLVER, encoding="utf-8")


After = Literal["nothing", "pages", "tables"]


@dataclass(frozen=True)
class Change:
    """A change, and what must follow.

    Parameters
    ----------
    name : str
        As the table names it.
    edit : callable
        Makes the change in a project's folder.
    measure, design, solve : int
        Jobs of ingest, reduce and calibrate together; of design; of solve.
    cases : int
        Cases that are solved, in all studies.
    after : str
        What else runs: nothing, only pages (report, identity, account of the files, problems,
        verdict), or tables of results as well.
    solves : bool
        The cases are known only after materials were calibrated: the run is made, not planned.
    """

    name: str
    edit: Callable[[Path], None]
    measure: int = 0
    design: int = 0
    solve: int = 0
    cases: int = 0
    after: After = "pages"
    solves: bool = False

    def row(self) -> str:
        """Return the change and what follows as a row of a table."""
        cases = f"{self.cases}" if self.cases else ""
        jobs = [str(number) if number else "" for number in (self.measure, self.design, self.solve)]
        return f"| {self.name} | {' | '.join(jobs)} | {cases} | {self.after} |"

    def expected_jobs(self) -> dict[str, Any]:
        """Return what must follow, except the cases."""
        return {name: value for name, value in self.expected().items() if name != "cases"}

    def expected(self) -> dict[str, Any]:
        """Return what must follow, in the form in which `summary` gives what does follow."""
        return {
            "measure": self.measure,
            "design": self.design,
            "solve": self.solve,
            "cases": self.cases,
            "after": self.after,
        }


HEAD = (
    "| change | ingest, reduce, calibrate | design | solve | cases solved | what else |\n"
    "|---|---|---|---|---|---|"
)
"""Head of the table that `Change.row` fills."""

MEASURE = ("ingest_", "reduce", "calibrate_")
"""Beginnings of the rules' names; ingest has a rule for each batch of specimens."""
PAGES = {"account", "configuration", "identity", "problems", "report", "verdict", "workbook"}


def summary(jobs: dict[str, int], cases: int) -> dict[str, Any]:
    """Sum up planned jobs by what they do."""
    jobs = {name: number for name, number in jobs.items() if name != "all"}
    measure = {name for name in jobs if name.startswith(MEASURE)}
    rest = set(jobs) - measure - {"design", "solve"}
    return {
        "measure": sum(jobs[name] for name in measure),
        "design": jobs.get("design", 0),
        "solve": jobs.get("solve", 0),
        "cases": cases,
        "after": "nothing" if not rest else "pages" if rest <= PAGES else "tables",
    }


def in_yaml(file: str, change: Callable[[Any], None]) -> Callable[[Path], None]:
    """Return an edit of a YAML file."""

    def edit(folder: Path) -> None:
        content = yaml.safe_load((folder / file).read_text(encoding="utf-8"))
        change(content)
        (folder / file).write_text(yaml.safe_dump(content, sort_keys=False), encoding="utf-8")

    return edit


def config(change: Callable[[Any], None]) -> Callable[[Path], None]:
    """Return an edit of the configuration."""
    return in_yaml(CONFIG, change)


def study(name: str, /, **keys: Any) -> Callable[[Path], None]:
    """Return an edit of keys of a study."""

    def change(content: Any) -> None:
        next(one for one in content["studies"] if one["name"] == name).update(keys)

    return config(change)


def text(file: str, old: str, new: str) -> Callable[[Path], None]:
    """Return an edit of a text, at its first place."""

    def edit(folder: Path) -> None:
        content = (folder / file).read_text(encoding="utf-8")
        assert old in content, f"{old!r} is not in {file}"
        (folder / file).write_text(content.replace(old, new, 1), encoding="utf-8")

    return edit


def code(file: str, old: str, new: str) -> Callable[[Path], None]:
    """Return an edit of a module of the package."""
    return text(f"workflow/src/nptcs/{file}", old, new)


SHEET = "raw_data/example/specimens.csv"


def sheet_rows(folder: Path) -> list[list[str]]:
    """Return the cells of the specimen sheet, the header first."""
    with (folder / SHEET).open(encoding="utf-8", newline="") as stream:
        return list(csv.reader(stream))


def in_sheet(material: str, column: str, value: str) -> Callable[[Path], None]:
    """Return an edit of one cell: the first specimen of a material."""

    def edit(folder: Path) -> None:
        header, *rows = sheet_rows(folder)
        row = next(row for row in rows if row[header.index("material")] == material)
        row[header.index(column)] = value
        with (folder / SHEET).open("w", encoding="utf-8", newline="") as stream:
            csv.writer(stream, lineterminator="\n").writerows([header, *rows])

    return edit


def new_content(material: str, date: float | None = None) -> Callable[[Path], None]:
    """Return an edit of the raw file of a material's first specimen: its content, and its date."""

    def edit(folder: Path) -> None:
        header, *rows = sheet_rows(folder)
        row = next(row for row in rows if row[header.index("material")] == material)
        raw = folder / "raw_data/example" / row[header.index("force_file")]
        raw.write_bytes(raw.read_bytes() + b"\n")
        if date is not None:
            os.utime(raw, (date, date))

    return edit


def another_specimen(folder: Path) -> None:
    """Add a specimen of a rubber, with a file of its own."""
    raw = folder / "raw_data/example"
    header, *rows = sheet_rows(folder)
    row = list(next(row for row in rows if row[header.index("material")] == "rubber_75A"))
    for column in ("force_file", "strain_file"):
        place = header.index(column)
        if row[place]:
            name = row[place].replace(".", "_new.", 1)
            shutil.copy(raw / row[place], raw / name)
            row[place] = name
    row[header.index("specimen")] += "-new"
    with (folder / SHEET).open("a", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerow(row)


def old_table(name: str) -> Callable[[Path], None]:
    """Return an edit of a published table that keeps an old date."""

    def edit(folder: Path) -> None:
        table = folder / "raw_data/published" / name
        table.write_bytes(table.read_bytes() + b"# seen\n")
        os.utime(table, (OLD, OLD))

    return edit


def touch_all(folder: Path) -> None:
    """Give all inputs and all code new dates."""
    for name in ("raw_data", "config", "workflow"):
        for path in (folder / name).rglob("*.*"):
            path.touch()


def own_page(folder: Path) -> None:
    """Give the report a logo and a template of its own."""
    (folder / "own").mkdir()
    svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1"/>'
    (folder / "own/logo.svg").write_text(svg, encoding="utf-8")
    (folder / "own/templates").mkdir()
    (folder / "own/templates/cover.html.j2").write_text("<h1>Ours</h1>", encoding="utf-8")
    keys = {"laboratory": {"logo": "own/logo.svg"}, "report": {"templates": "own/templates"}}
    config(lambda content: content.update(keys))(folder)


def titles(content: Any) -> None:
    """Change every word of the studies that only the report prints."""
    for one in content["studies"]:
        one["title"] = "Another heading"
        for factor in one["factors"]:
            factor["label"] = "another label"


def profile_comments(folder: Path) -> None:
    """Write a comment into every format profile."""
    for profile in (folder / "config/formats").glob("*.yaml"):
        profile.write_text("# ours\n" + profile.read_text("utf-8"), "utf-8")


def add_file(folder: Path) -> None:
    """Put a file next to the raw files that the sheet does not name."""
    (folder / "raw_data/example/notes.txt").write_text("seen\n", encoding="utf-8")


def try_again(folder: Path) -> None:
    """Note, as a killed case does, that a batch is to be tried again."""
    batch = folder / "results/5_solve/tested/lca/batch_1.tries"
    batch.unlink(missing_ok=True)
    batch.write_text("1\n", encoding="utf-8")


def delete(name: str) -> Callable[[Path], None]:
    """Return an edit that deletes a file."""
    return lambda folder: (folder / name).unlink()


def constraints(folder: Path) -> None:
    """Raise a version of the environment."""
    (folder / "constraints.txt").write_text("numpy==9.9.9\n", encoding="utf-8")


LEVELS = {"factors": [STUDY["factors"][0] | {"levels": [3, 4, 5]}, STUDY["factors"][1]]}

CHANGES = [
    Change("raw file of a rubber, the same numbers: new content, older date",
           new_content("rubber_75A", OLD), 3, 1, 2, 0, "tables", solves=True),
    Change("published table: new content, older date", old_table("table7_rubber_doe.csv"),
           solve=2, after="tables"),
    Change("new dates on all files", touch_all, after="nothing"),
    Change("comment in the finite element code",
           code("fe/case.py", "from __future__", "# seen\nfrom __future__"), after="nothing"),
    Change("version of NumPy in constraints.txt", constraints, after="nothing"),
    Change("raw file of a rubber, the same numbers", new_content("rubber_75A"),
           3, 1, 2, 0, "tables", solves=True),
    Change("raw file of a composite, the same numbers", new_content("cfrp"),
           3, 0, 3, 0, "tables", solves=True),
    Change("specimen of a rubber: include → no", in_sheet("rubber_75A", "include", "no"),
           3, 1, 2, 4, "tables", solves=True),
    Change("specimen of a composite: include → no", in_sheet("cfrp", "include", "no"),
           3, 0, 3, 10, "tables", solves=True),
    Change("level added to a factor", study("tested", **LEVELS), 0, 1, 2, 6, "tables"),
    Change("study renamed", study("tested", name="renamed"), 0, 1, 2, 0, "tables"),
    Change("studies in another order", config(lambda c: c["studies"].reverse()), after="tables"),
    Change("fewer terms of a surface", study("tested", terms=["1", "spoke_c10_mpa"]),
           after="tables"),
    Change("remark on a specimen", in_sheet("cfrp", "remarks", "tab came off")),
    Change("comment in a format profile", profile_comments),
    Change("wording of an error message", code("errors.py", '". Remedy: {', '". What to do: {')),
    Change("description of a setting of the finite elements",
           code("config/solvers/fe.py", 'description="', 'description="The '), after="nothing"),
    Change("version of the package", code("__init__.py", '"0.1.0"', '"0.1.1"')),
    Change("`timeout_s` of all solvers",
           config(lambda c: [one.update(timeout_s=1234.5) for one in c["solvers"].values()])),
    Change("`spoke_cache`", config(lambda c: c["solvers"]["fe_tyre"].update(spoke_cache="x"))),
    # further changes
    Change("titles, labels and units of studies", config(titles)),
    Change("comment and docstring in a solver of one's own",
           text(SOLVER, '"Return a stiffness without a model."', '"Say it."  # in other words'),
           after="nothing"),
    Change("number in a solver of one's own", text(SOLVER, "10.0", "11.0"), 0, 0, 1, 6, "tables"),
    Change("number in the code of the load-bearing model",
           code("lca/linear/newton.py", "import numpy as np\n",
                "import numpy as np\n\nOTHER = 2.0\n"),
           0, 0, 3, 14, "tables"),
    Change("load of a study", study("tested", load_n=4000.0), 0, 1, 2, 12, "tables"),
    Change("two batches instead of one", config(lambda c: c.update(campaign={"batches": 2})),
           0, 0, 16, 0, "tables"),
    Change("cases whose neutral line is drawn", study("band", neutral_line_cases=[1, 2]),
           after="tables"),
    Change("cases on which a solver was calibrated",
           study("band", calibration_cases={"fe_tyre": [1]}), after="tables"),
    Change("number in the code of the impact values",
           code("surface/sensitivity/gradients.py", "GRID_POINTS = 2_", "GRID_POINTS = 3_"),
           after="tables"),
    Change("code of a rule's script",
           text("workflow/scripts/case_coverage.py", "from pathlib", "import math\nfrom pathlib"),
           after="tables"),
    Change("another specimen of a rubber, with the same data", another_specimen,
           3, 1, 2, 0, "tables", solves=True),
    Change("file that the sheet does not name", add_file, after="pages"),
    Change("range of a modulus", config(
        lambda c: c.update(reduction={"astm_d3518": {"chord_range": [0.002, 0.0061]}})),
        6, 0, 3, 10, "tables", solves=True),
    Change("case added at the end", study("tested", further_cases=[
        {"shear_band_c10_mpa": 4.5, "spoke_c10_mpa": 3.0}]), 0, 1, 2, 2, "tables"),
    Change("a case was killed in the last run", try_again, 0, 0, 1, 0, "tables"),
    Change("table of results deleted", delete("results/tables/impact.csv"), after="tables"),
    Change("report deleted", delete("results/report.html")),
    Change("key that only the report reads", config(lambda c: c.update(report={"title": "Ours"}))),
    Change("customer and language of the report",
           config(lambda c: c.update(laboratory={"customer": "Someone", "language": "zh"}))),
    Change("a logo and a template of the laboratory", own_page),
]  # fmt: skip


def changed_copy(finished: Path, folder: Path, change: Change) -> None:
    """Copy a finished project and change it. Results are linked: nothing here writes into them."""
    shutil.copytree(finished / "results", folder / "results", copy_function=os.link)
    for part in finished.iterdir():
        if part.name == "results":
            continue
        if part.is_dir():
            shutil.copytree(part, folder / part.name, symlinks=True)
        else:
            shutil.copy2(part, folder / part.name)
    change.edit(folder)


def plan_all(folders: list[Path]) -> list[dict[str, Any]]:
    """Plan the next run in each folder: jobs by rule, and cases that are not known.

    One process plans them all: most of the time of a dry run is spent on imports.
    """
    environment = {
        **os.environ,
        "PYTHONPATH": str(ROOT / "workflow/src"),
        "OPENBLAS_NUM_THREADS": "1",
    }
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name("plan_increments.py")), *map(str, folders)],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-4000:]
    return json.loads(done.stdout.splitlines()[-1])


SOLVED = re.compile(r"^\w+/\w+ \d+/\d+ \S+ ok \([\d.]+ s", re.MULTILINE)


def run_change(folder: Path) -> tuple[dict[str, int], int]:
    """Plan the next run, solve the cases that depend on tested materials; return jobs and cases."""
    jobs = plan_all([folder])[0]["jobs"]
    batches = [
        f"results/5_solve/{study}/{solver}/batch_1.jsonl"
        for study, solver in (("tested", "lca"), ("tested", "own"), *FE_STUDIES)
    ]
    command = [sys.executable, "-m", "snakemake", "-j2", *batches, "--configfile", CONFIG]
    environment = {**os.environ, "PYTHONPATH": str(folder / "workflow/src")}
    logs = folder / "results/logs/solve"
    shutil.rmtree(logs, ignore_errors=True)
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-4000:]
    return jobs, sum(len(SOLVED.findall(log.read_text("utf-8"))) for log in logs.glob("*.log"))


FE_STUDIES = (("band", "fe_tyre"), ("spoke", "fe_spoke"))


def table() -> str:
    """Return the table of all changes."""
    return "\n".join([HEAD, *(change.row() for change in CHANGES)]) + "\n"
