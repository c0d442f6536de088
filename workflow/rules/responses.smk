# Records of solved tyres → what they do at any load, and the margins of their plates.
from nptcs.tables.solver_names import PUBLISHED

COMPOSITES = sorted({s.material for s in SPECIMENS if not s.test.is_rubber})


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
    params:
        job={
            "settings": plain(CONFIG.tyre_responses),
            "ply": COMPOSITES[0] if len(COMPOSITES) == 1 else None,
            "code": code_of("tyre_responses"),
        },
    script:
        "../scripts/tyre_responses.py"
