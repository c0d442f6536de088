# All results → the list of problems, the report and the workbook, and the verdict on the run.
from importlib.resources import files as package_files


def solver_facts():
    """What the report says of each solver: what it is, and what it is given.

    A solver's choices between models stand once for each study that makes them differently.
    """
    named = {(name, study.name) for study in CONFIG.studies for name in study.solvers}
    facts = {}
    for name, study in sorted(named):
        solver, options = solver_of(study, name)
        facts[name] = {
            "about": solver.about,
            "needs_ply": solver.needs_ply,
            "loads_tyre": solver.loads_tyre,
            "choices": facts.get(name, {}).get("choices", []),
        }
        chosen = model_choices(options)
        if chosen and chosen not in facts[name]["choices"]:
            facts[name]["choices"].append(chosen)
    return facts


def configured_inputs():
    """Input files that the configuration names; raw laboratory files stand in files.csv."""
    check = CONFIG.lca_validation
    paths = [
        str(SHEET),
        *map(str, sorted(Path(CONFIG.lab_data.formats).glob("*.yaml"))),
        CONFIG.sensitivity.published_impact,
        check.spoke_stiffness,
        check.published,
        check.published_loads,
        check.published_fem,
    ]
    for study in CONFIG.studies:
        paths += [study.published_coefficients, study.published_spoke_stiffness]
        for name in study.solvers:
            paths += solver_of(study.name, name)[1].tables().values()
    return list(dict.fromkeys(filter(None, paths)))


rule problems:
    input:
        records=records(SPECIMENS),
        cases="results/tables/cases.csv",
        tables=expand("results/2_reduce/{series}_problems.csv", series=SERIES)
        + expand("results/6_surface/{study}_problems.csv", study=SURFACE_STUDIES),
    output:
        problems="results/tables/problems.csv",
    log:
        "results/logs/problems.log",
    params:
        job={
            "sheet_errors": [
                [error.specimen or SHEET.name, str(error)] for error in SHEET_ERRORS
            ],
            "code": code_of("problems"),
        },
    script:
        "../scripts/problems.py"


rule report:
    input:
        problems="results/tables/problems.csv",
        files="results/tables/files.csv",
        specimens="results/tables/specimens.csv",
        statistics="results/tables/statistics.csv",
        models="results/tables/hyperelastic_models.csv",
        ranges="results/tables/c10_against_range.csv",
        card="results/material_card.json",
        curves=curves(SPECIMENS),
        records=records(SPECIMENS),
        designs=expand("results/4_design/{study}.csv", study=STUDIES),
        cases="results/tables/cases.csv",
        surfaces=expand("results/6_surface/{study}.json", study=SURFACE_STUDIES),
        coefficients=expand("results/tables/{study}_surface.csv", study=SURFACE_STUDIES),
        quality="results/tables/surface_quality.csv",
        impact="results/tables/impact.csv",
        spoke_stiffness="results/tables/spoke_stiffness.csv",
        spoke_curves="results/tables/spoke_curves.csv",
        compare_published="results/tables/stiffness_against_published.csv",
        stiffness_errors="results/tables/stiffness_errors.csv",
        stiffness_by_level="results/tables/stiffness_by_level.csv",
        neutral_line="results/tables/neutral_line.csv",
        lca_validation="results/tables/lca_validation.csv",
        lca_against_fem="results/tables/lca_against_fem.csv",
        lca_neutral_line="results/tables/lca_neutral_line.csv",
        inputs=configured_inputs(),
    output:
        page="results/report.html",
        workbook="results/workbook.xlsx",
    log:
        "results/logs/report.log",
    params:
        job={
            "config": plain(CONFIG),
            "specimens": [plain(specimen) for specimen in SPECIMENS],
            "solvers": solver_facts(),
            "templates": {
                template.name: sha256_of_file(template)
                for template in sorted(
                    Path(str(package_files("nptcs.report") / "templates")).iterdir()
                )
            },
            "code": code_of("report"),
        },
    script:
        "../scripts/report.py"


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
            "code": code_of("verdict"),
        },
    script:
        "../scripts/verdict.py"


# After a failed run a report that was not built by it must not look current.
onerror:
    import nptcs.report.stale

    nptcs.report.stale.set_aside(
        ["results/report.html", "results/workbook.xlsx"],
        "results/logs/verdict.log",
        STARTED,
    )
