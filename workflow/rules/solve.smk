# Design tables → one record per case. A failed case is a record too; records are kept by content.

from nptcs.campaign.queue import batch_memory_mb, batch_minutes, licence_request
from nptcs.campaign.tries import read_tries


def ply_card(wildcards):
    if not solver_of(wildcards.study, wildcards.solver).needs_ply:
        return []
    return [f"results/3_calibrate/{FACTS.ply[wildcards.study]}.json"]


def solver_tables(wildcards):
    options = solver_of(wildcards.study, wildcards.solver)
    return [ancient(path) for path in options.tables().values()]


def solve_job(wildcards, batch="batch_{batch}.jsonl"):
    # without `output`: Snakemake does not remember parameters that depend on it
    study = CONFIG.study(wildcards.study)
    options = CONFIG.solver_options(study)[wildcards.solver]
    checked = solver_of(wildcards.study, wildcards.solver)
    return {
        "study": study.case_definition(),
        "solver": wildcards.solver,
        "options": {
            k: v for k, v in options.items() if k not in checked.without_effect
        },
        "tables": contents(checked.tables().values()),
        "tyre": plain(CONFIG.tyre),
        "batch": int(wildcards.batch),
        "batches": batches_of(wildcards.study, wildcards.solver),
        "tries": read_tries(
            f"results/5_solve/{{study}}/{{solver}}/{batch}".format(**wildcards)
        ),
        "code": code_of("solve", module_of(wildcards.solver, options)),
    }


def solve_bulk_job(wildcards):
    options = CONFIG.solver_options(CONFIG.study(wildcards.study))[wildcards.solver]
    return {
        **solve_job(wildcards, "bulk_{batch}.npz"),
        "code": code_of("solve_bulk", module_of(wildcards.solver, options)),
    }


def solve_cores(wildcards):
    options = solver_of(wildcards.study, wildcards.solver)
    cases = CONFIG.study(wildcards.study).number_of_cases()
    batch = cases / batches_of(wildcards.study, wildcards.solver)
    return batch_cores(CONFIG.campaign.cores_per_batch, options, batch)


def solve_tokens(wildcards, threads):
    options = solver_of(wildcards.study, wildcards.solver)
    return batch_tokens(threads, options)


def solve_memory_mb(wildcards, threads, attempt):
    options = solver_of(wildcards.study, wildcards.solver)
    return batch_memory_mb(threads, options, attempt)


def solve_minutes(wildcards, threads, attempt):
    options = solver_of(wildcards.study, wildcards.solver)
    cases = CONFIG.study(wildcards.study).number_of_cases()
    parts = batches_of(wildcards.study, wildcards.solver)
    return batch_minutes(cases, parts, threads, options, attempt)


def solve_licence(wildcards, threads):
    return licence_request(
        solve_tokens(wildcards, threads), CONFIG.campaign.queue_licence
    )


rule solve:
    input:
        design="results/4_design/{study}.csv",
        ply=ply_card,
        tables=solver_tables,
    output:
        records="results/5_solve/{study}/{solver}/batch_{batch}.jsonl",
    log:
        "results/logs/solve/{study}_{solver}_{batch}.log",
    priority: 3  # a surface on one core would keep batches on two from starting
    threads: solve_cores
    resources:
        licence_tokens=solve_tokens,
        mem_mb=solve_memory_mb,
        runtime=solve_minutes,
        slurm_extra=solve_licence,
    params:
        job=lambda wildcards: solve_job(wildcards),
        store="results/5_solve/records",
    script:
        "../scripts/solve.py"


rule solve_bulk:
    input:
        design="results/4_design/{study}.csv",
        ply=ply_card,
        tables=solver_tables,
    output:
        results="results/5_solve/{study}/{solver}/bulk_{batch}.npz",
    log:
        "results/logs/solve/{study}_{solver}_bulk_{batch}.log",
    priority: 3  # a surface on one core would keep batches on two from starting
    threads: solve_cores
    resources:
        licence_tokens=solve_tokens,
        mem_mb=solve_memory_mb,
        runtime=solve_minutes,
        slurm_extra=solve_licence,
    params:
        job=solve_bulk_job,
        store="results/5_solve/records",
    script:
        "../scripts/solve_bulk.py"


rule cases:
    input:
        records=[path for study in STUDIES for path in batches(study)],
    output:
        cases=report(
            "results/tables/cases.csv",
            caption="../report/cases.rst",
            category="Cases",
        ),
    log:
        "results/logs/cases.log",
    priority: 1  # decisions wait for it
    params:
        job={"code": code_of("cases")},
    script:
        "../scripts/cases.py"
