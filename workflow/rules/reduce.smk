# Curves → properties of each specimen by the standards → statistics of each group.


def reduce_job(wildcards):
    return {
        "specimens": [plain(s) for s in specimens_of_series(wildcards.series)],
        "settings": plain(CONFIG.reduction),
        "plausible": plain(CONFIG.ingest.plausible),
        "code": code_of("reduce"),
    }


rule reduce:
    input:
        curves=lambda wildcards: curves(specimens_of_series(wildcards.series)),
        records=lambda wildcards: records(specimens_of_series(wildcards.series)),
    output:
        properties="results/2_reduce/{series}.csv",
        problems="results/2_reduce/{series}_problems.csv",
    log:
        "results/logs/reduce/{series}.log",
    params:
        job=reduce_job,
    script:
        "../scripts/reduce.py"


rule statistics:
    input:
        properties=expand("results/2_reduce/{series}.csv", series=SERIES),
        records=records(SPECIMENS),
    output:
        specimens="results/tables/specimens.csv",
        flags="results/tables/flags.csv",
        statistics=report(
            "results/tables/statistics.csv",
            caption="../report/statistics.rst",
            category="Materials",
        ),
    log:
        "results/logs/statistics.log",
    params:
        job={
            "specimens": [plain(specimen) for specimen in SPECIMENS],
            "settings": plain(CONFIG.reduction),
            "code": code_of("statistics"),
        },
    script:
        "../scripts/statistics.py"
