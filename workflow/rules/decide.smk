# Surfaces, cards and tolerances → how sure each response is, and designs that meet the goals.
ADDED_CASES = (
    "results/7_decide/added_cases.csv"  # `nptcs design --confirm` appends to it
)

DECIDED = (
    "studies",
    "solvers",
    "tyre",
    "uncertainty",
    "decisions",
    "tyre_responses",
    "campaign",
)


def decide_job():
    settings = plain(CONFIG)
    solvers = sorted({(d.study, d.solver) for d in CONFIG.decisions})
    modules = [
        module_of(name, CONFIG.options_of(study, name)) for study, name in solvers
    ]
    return {
        "settings": {name: settings[name] for name in DECIDED},
        "added": ADDED_CASES,
        "added_cases": contents([ADDED_CASES]),
        "code": code_of("decide", *dict.fromkeys(modules), words=True),
    }


rule decide:
    input:
        models=expand("results/6_surface/models/{study}.json", study=SURFACE_STUDIES),
        cases="results/tables/cases.csv",
        responses="results/tables/tyre_responses.csv",
        curves="results/tables/tyre_curves.csv",
        statistics="results/tables/statistics.csv",
        errors="results/tables/stiffness_errors.csv",
        card="results/material_card.json",
    output:
        uncertainty="results/tables/uncertainty.csv",
        shares="results/tables/uncertainty_shares.csv",
        decisions="results/tables/decisions.csv",
        designs="results/tables/decision_designs.csv",
        front="results/tables/decision_front.csv",
        confirmation="results/tables/decision_confirmation.csv",
        problems="results/7_decide/problems.csv",
    log:
        "results/logs/decide.log",
    threads: CONFIG.campaign.cores_per_batch
    params:
        job=decide_job(),
        store="results/5_solve/records",
    script:
        "../scripts/decide.py"
