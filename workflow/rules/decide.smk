# Surfaces, cards and tolerances → uncertainty of each response, and designs that meet the goals.
ADDED_CASES = (
    "results/7_decide/added_cases.csv"  # `nptcs design --confirm` appends to it
)

DECIDED = ("tyre", "uncertainty", "tyre_responses")


def decided_study(study):
    """A study without titles and labels, which decide no number."""
    return {
        **plain(study),
        "title": "",
        "factors": study.case_definition()["factors"],
        "decisions": [{**plain(one), "title": ""} for one in study.decisions],
        "solver_options": {},
    }


def confirming_options(study_name, solver_name):
    """Options of a solver that solves chosen designs, without those that change no result."""
    options = CONFIG.options_of(study_name, solver_name)
    words = FACTS.solvers[study_name][solver_name].without_effect
    return {key: value for key, value in options.items() if key not in words}


def decide_job():
    settings = plain(CONFIG)
    asked = sorted({(one.study, one.solver) for one in CONFIG.decisions})
    modules = [module_of(name, CONFIG.options_of(study, name)) for study, name in asked]
    return {
        "settings": {name: settings[name] for name in DECIDED},
        "studies": [decided_study(study) for study in CONFIG.studies],
        "options": [confirming_options(*one) for one in asked],
        "added": ADDED_CASES,
        "added_cases": contents([ADDED_CASES]),
        "code": code_of("decide", *dict.fromkeys(modules)),
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
