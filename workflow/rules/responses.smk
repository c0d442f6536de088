# Records of solved tyres → what they do at any load, and the margins of their plates.
from nptcs.tables.solver_names import PUBLISHED

COMPOSITES = sorted({s.material for s in SPECIMENS if not s.test.is_rubber})


# the case that is drawn with all its spokes: the first that neutral_line_cases names
DRAWN = next(
    (
        (study.name, solver)
        for study in CONFIG.studies
        if study.neutral_line_cases
        for solver in study.solvers
        if solver in ("fe_tyre_paper", "fe_tyre")
    ),
    None,
)


rule deformed_tyre:
    input:
        records=record_batches(*DRAWN) if DRAWN else [],
        design=[f"results/4_design/{DRAWN[0]}.csv"] if DRAWN else [],
        ply=[f"results/3_calibrate/{FACTS.ply[DRAWN[0]]}.json"] if DRAWN else [],
    output:
        outlines="results/tables/deformed_tyre.csv",
    log:
        "results/logs/deformed_tyre.log",
    params:
        job={
            "study": DRAWN[0] if DRAWN else "",
            "solver": DRAWN[1] if DRAWN else "",
            "cases": CONFIG.study(DRAWN[0]).neutral_line_cases if DRAWN else [],
            "code": code_of("deformed_tyre"),
        },
        store="results/5_solve/outlines",
    script:
        "../scripts/deformed_tyre.py"


rule tyre_responses:
    input:
        records=[
            path
            for study in STUDIES
            for solver in tyre_solvers(study)
            if solver != PUBLISHED
            for path in record_batches(study, solver)
        ],
        statistics="results/tables/statistics.csv",
    output:
        responses="results/tables/tyre_responses.csv",
        curves="results/tables/tyre_curves.csv",
        plates="results/tables/plate_stress.csv",
    log:
        "results/logs/tyre_responses.log",
    priority: 1  # decisions wait for it
    params:
        job={
            "settings": plain(CONFIG.tyre_responses),
            "ply": COMPOSITES[0] if len(COMPOSITES) == 1 else None,
            "code": code_of("tyre_responses"),
        },
    script:
        "../scripts/tyre_responses.py"
