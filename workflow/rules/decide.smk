# Surfaces, cards and tolerances → uncertainty of each response, and designs that meet the goals.

from nptcs.campaign.queue import confirmation_memory_mb, confirmation_minutes

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


def confirming_solvers():
    """The solver of each decision that is confirmed, and the most cases that it may solve."""
    return [
        (FACTS.solvers[one.study][one.solver], one.rounds)
        for one in CONFIG.decisions
        if one.confirm
    ]


def decide_cores(wildcards):
    # designs are solved one after the other
    return max((one.cores_per_case() for one, _ in confirming_solvers()), default=1)


def decide_tokens(wildcards):
    return max((batch_tokens(1, one) for one, _ in confirming_solvers()), default=0)


def decide_memory_mb(wildcards, attempt):
    return confirmation_memory_mb([one for one, _ in confirming_solvers()], attempt)


def decide_minutes(wildcards, attempt):
    return confirmation_minutes(confirming_solvers(), attempt)


def decide_licence(wildcards):
    return licence_request(decide_tokens(wildcards), CONFIG.campaign.queue_licence)


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
    priority: 2  # the longest of those that the report waits for, where it solves its choice
    threads: decide_cores
    resources:
        licence_tokens=decide_tokens,
        mem_mb=decide_memory_mb,
        runtime=decide_minutes,
        slurm_extra=decide_licence,
    params:
        job=decide_job(),
        store="results/5_solve/records",
    script:
        "../scripts/decide.py"
