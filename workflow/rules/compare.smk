# Computed results compared with the paper: section 4.3.1, tables 5, 7, 10 and 11, figures 14, 15.
from nptcs.compare.conditions import plate_faults
from nptcs.tables.solver_names import PUBLISHED

COMPARED_STUDIES = [
    study.name
    for study in CONFIG.studies
    if PUBLISHED in study.solvers and not plate_faults(study)
]
LINE_STUDIES = [study.name for study in CONFIG.studies if study.neutral_line_cases]
PUBLISHED_SPOKES = {
    study.name: study.published_spoke_stiffness
    for study in CONFIG.studies
    if study.published_spoke_stiffness
}


rule spoke_stiffness:
    input:
        records=[
            path
            for study in CONFIG.studies
            for solver in study.solvers
            if solver not in tyre_solvers(study.name)
            for path in record_batches(study.name, solver)
        ],
        published=[ancient(path) for path in PUBLISHED_SPOKES.values()],
    output:
        lines="results/tables/spoke_stiffness.csv",
        curves="results/tables/spoke_curves.csv",
    log:
        "results/logs/spoke_stiffness.log",
    params:
        job={
            "studies": list(PUBLISHED_SPOKES),
            "published": contents(PUBLISHED_SPOKES.values()),
            "code": code_of("spoke_stiffness"),
        },
    script:
        "../scripts/spoke_stiffness.py"


rule compare_published:
    input:
        cases="results/tables/cases.csv",
        designs=expand("results/4_design/{study}.csv", study=COMPARED_STUDIES),
    output:
        table=report(
            "results/tables/stiffness_against_published.csv",
            caption="../report/compared.rst",
            category="Cases",
        ),
        errors="results/tables/stiffness_errors.csv",
        levels="results/tables/stiffness_by_level.csv",
        exponents="results/tables/stiffness_exponents.csv",
    log:
        "results/logs/compare_published.log",
    priority: 1  # decisions wait for it
    params:
        job={
            "studies": {
                name: {
                    "factors": [f.name for f in CONFIG.study(name).factors],
                    "solvers": [s for s in tyre_solvers(name) if s != PUBLISHED],
                    "calibration_cases": CONFIG.study(name).calibration_cases,
                }
                for name in COMPARED_STUDIES
            },
            "code": code_of("compare_published"),
        },
    script:
        "../scripts/compare_published.py"


rule neutral_line:
    input:
        records=[
            path
            for name in LINE_STUDIES
            for solver in tyre_solvers(name)
            for path in record_batches(name, solver)
        ],
        designs=expand("results/4_design/{study}.csv", study=LINE_STUDIES),
    output:
        lines="results/tables/neutral_line.csv",
    log:
        "results/logs/neutral_line.log",
    params:
        job={
            "cases": [CONFIG.study(name).neutral_line_cases for name in LINE_STUDIES],
            "code": code_of("neutral_line"),
        },
    script:
        "../scripts/neutral_line.py"


LCA_PUBLISHED = {
    "table_7": CONFIG.lca_validation.published_fem,
    "table_10": CONFIG.lca_validation.spoke_stiffness,
    "table_11": CONFIG.lca_validation.published,
    "figure_15": CONFIG.lca_validation.published_loads,
}


rule lca_validation:
    input:
        **{name: ancient(path) for name, path in LCA_PUBLISHED.items()},
    output:
        validation="results/tables/lca_validation.csv",
        fem="results/tables/lca_against_fem.csv",
        neutral_line="results/tables/lca_neutral_line.csv",
    log:
        "results/logs/lca_validation.log",
    params:
        job={
            "shear_band_c10_mpa": CONFIG.lca_validation.shear_band_c10_mpa,
            "tyre": plain(CONFIG.tyre),
            "published": contents(LCA_PUBLISHED.values()),
            "code": code_of("lca_validation"),
        },
    script:
        "../scripts/lca_validation.py"


rule displacement_by_load:
    input:
        cases="results/tables/cases.csv",
        curves="results/tables/tyre_curves.csv",
        validation="results/tables/lca_validation.csv",
    output:
        table="results/tables/displacement_by_load.csv",
    log:
        "results/logs/displacement_by_load.log",
    params:
        job={
            "shear_band_c10_mpa": CONFIG.lca_validation.shear_band_c10_mpa,
            "code": code_of("displacement_by_load"),
        },
    script:
        "../scripts/displacement_by_load.py"
