# All results → the list of problems, the report and the workbook, and the verdict on the run.
from importlib.resources import files as package_files

from nptcs.runs.identity import WORDS_ONLY

from nptcs.language import catalogue_digest


def solver_facts():
    """What the report says about each solver: what it is, and what it is given.

    A solver's choices between models are listed once for each study that makes them differently.
    """
    named = {(name, study.name) for study in CONFIG.studies for name in study.solvers}
    facts = {}
    for name, study in sorted(named):
        solver = solver_of(study, name)
        facts[name] = {
            "about": solver.about,
            "needs_ply": solver.needs_ply,
            "loads_tyre": solver.loads_tyre,
            "choices": facts.get(name, {}).get("choices", []),
            "whole_plates": solver.whole_plates,
        }
        chosen = solver.choices
        if chosen and chosen not in facts[name]["choices"]:
            facts[name]["choices"].append(chosen)
    return facts


def configured_inputs():
    """Input files that the configuration names; raw laboratory files are listed in files.csv."""
    formats = sorted(Path(CONFIG.lab_data.formats).glob("*.yaml"))
    paths = [str(SHEET), *map(str, formats), *CONFIG.published_inputs()]
    for study in CONFIG.studies:
        for name in study.solvers:
            paths += solver_of(study.name, name).tables().values()
    return list(dict.fromkeys(paths))


rule configuration:
    output:
        configuration="results/configuration.yaml",
    log:
        "results/logs/configuration.log",
    params:
        job={"config": plain(CONFIG), "code": code_of("configuration")},
    script:
        "../scripts/configuration.py"


rule problems:
    input:
        records=records(SPECIMENS),
        cases="results/tables/cases.csv",
        tables=expand("results/2_reduce/{series}_problems.csv", series=SERIES)
        + expand("results/6_surface/{study}_problems.csv", study=SURFACE_STUDIES)
        + ["results/6_surface/sobol/problems.csv", "results/7_decide/problems.csv"],
    output:
        problems="results/tables/problems.csv",
    log:
        "results/logs/problems.log",
    params:
        job={
            "sheet_errors": [
                [error.specimen or SHEET.name, str(error)] for error in SHEET_ERRORS
            ],
            "code": code_of("problems", words=True),
        },
    script:
        "../scripts/problems.py"


# what the identity of a run does not depend on: how its numbers are shown
PAGES = ("configuration", "identity", "report", "verdict", "workbook")


def code_of_tables():
    """Hash of the code that made the tables: every rule's script but those of pages, and solvers."""
    solvers = {
        module_of(name, options)
        for study in CONFIG.studies
        for name, options in CONFIG.solver_options(study).items()
    }
    scripts = sorted(path for path in SCRIPTS.glob("*.py") if path.stem not in PAGES)
    return FACTS.code_of(*map(str, scripts), *sorted(solvers))


rule identity:
    input:
        tables=TABLES,
        card="results/material_card.json",
        inputs=[ancient(path) for path in configured_inputs()],
    output:
        identity="results/identity.json",
    log:
        "results/logs/identity.log",
    params:
        job={
            "config": CONFIG.model_dump(mode="json", exclude=set(WORDS_ONLY)),
            "inputs": contents(configured_inputs()),
            "code_of_tables": code_of_tables(),
            "folder": SHEET.parent.as_posix(),
            "code": code_of("identity"),
        },
    script:
        "../scripts/identity.py"


def page_inputs():
    """Input files of the report: those that the configuration names, its logo and its templates."""
    return [*configured_inputs(), *CONFIG.page_inputs()]


def all_results():
    """Everything that the report and the workbook show, as named inputs of their rules."""
    return {
        "tables": TABLES,
        "identity": "results/identity.json",
        "card": "results/material_card.json",
        "curves": curves(SPECIMENS),
        "records": records(SPECIMENS),
        "designs": expand("results/4_design/{study}.csv", study=STUDIES),
        "surfaces": expand("results/6_surface/{study}.json", study=SURFACE_STUDIES),
        "models": expand(
            "results/6_surface/models/{study}.json", study=SURFACE_STUDIES
        ),
        "inputs": [ancient(path) for path in page_inputs()],
    }


def shown():
    """What the report and the workbook show beyond the results."""
    return {
        "config": plain(CONFIG),
        "specimens": [specimen.model_dump(mode="json") for specimen in SPECIMENS],
        "solvers": solver_facts(),
        "inputs": contents(page_inputs()),
        "language": catalogue_digest(CONFIG.laboratory.language),
    }


def figure_code():
    """Hash of the code that draws the figures: those that are kept are of this code."""
    folder = Path(str(package_files("nptcs.report") / "figures"))
    modules = [
        f"nptcs.report.figures.{file.stem}" for file in sorted(folder.glob("*.py"))
    ]
    return FACTS.code_of("nptcs.report.plots", *modules, words=True)


def drawers(wildcards):
    """Processes that draw the figures; only the workbook is written at the same time."""
    settings = workflow.resource_settings  # a run on a cluster has no number of cores
    return min(4, settings.cores or settings.local_cores or 1)


# report and workbook both hold the tables of all cases: where these are long, one after the other
LONG_TABLES = any(
    solved_in_bulk(study.name, solver)
    for study in CONFIG.studies
    for solver in study.solvers
)


rule report:
    input:
        **all_results(),
    output:
        page=report(
            "results/report.html",
            caption="../report/page.rst",
            category="Report",
        ),
    log:
        "results/logs/report.log",
    threads: 4 if LONG_TABLES else 1  # with one, the workbook is written at the same time
    resources:
        drawers=drawers,
    params:
        job={
            **shown(),
            "figures": "results/7_report/figures",
            "figure_code": figure_code(),
            "templates": {
                template.name: sha256_of_file(template)
                for folder in ("templates", "explorer/assets")
                for template in sorted(
                    Path(str(package_files("nptcs.report") / folder)).iterdir()
                )
            },
            "code": code_of("report", words=True),
        },
    script:
        "../scripts/report.py"


rule workbook:
    input:
        **all_results(),
    output:
        workbook=report(
            "results/workbook.xlsx",
            caption="../report/workbook.rst",
            category="Report",
        ),
    log:
        "results/logs/workbook.log",
    params:
        job={**shown(), "code": code_of("workbook", words=True)},
    script:
        "../scripts/workbook.py"


rule verdict:
    input:
        "results/report.html",
        "results/workbook.xlsx",
        problems="results/tables/problems.csv",
        cases="results/tables/cases.csv",
        records=records(SPECIMENS),
    output:
        verdict_file="results/verdict.txt",
    log:
        "results/logs/verdict.log",
    params:
        job={
            "specimens": [plain(specimen) for specimen in SPECIMENS],
            "code": code_of("verdict", words=True),
        },
    script:
        "../scripts/verdict.py"


# After a failed run, a report that it did not build must not look current.
onerror:
    import nptcs.report.stale

    nptcs.report.stale.set_aside(
        ["results/report.html", "results/workbook.xlsx"],
        "results/logs/verdict.log",
        STARTED,
    )
