# Solved cases → response surfaces → average gradients and comprehensive impact values.


def surface_job(wildcards):
    study = CONFIG.study(wildcards.study)
    return {
        "fit": {
            "study": study.name,
            "factors": [factor.name for factor in study.factors],
            "solvers": list(study.solvers),
            "terms": list(study.terms),
        },
        "published": contents(published_coefficients(wildcards)),
        "code": code_of("surface"),
    }


def published_coefficients(wildcards):
    path = CONFIG.study(wildcards.study).published_coefficients
    return [ancient(path)] if path else []


rule surface:
    input:
        records=lambda wildcards: batches(wildcards.study),
        published=published_coefficients,
    output:
        table="results/tables/{study}_surface.csv",
        surfaces="results/6_surface/{study}.json",
        quality="results/6_surface/{study}_quality.csv",
        problems="results/6_surface/{study}_problems.csv",
    log:
        "results/logs/surface/{study}.log",
    params:
        job=surface_job,
    script:
        "../scripts/surface.py"


PUBLISHED_IMPACT = list(filter(None, [CONFIG.sensitivity.published_impact]))


rule sensitivity:
    input:
        surfaces=expand("results/6_surface/{study}.json", study=SURFACE_STUDIES),
        designs=expand("results/4_design/{study}.csv", study=SURFACE_STUDIES),
        qualities=expand("results/6_surface/{study}_quality.csv", study=SURFACE_STUDIES),
        published=[ancient(path) for path in PUBLISHED_IMPACT],
    output:
        impact="results/tables/impact.csv",
        quality="results/tables/surface_quality.csv",
    log:
        "results/logs/sensitivity.log",
    params:
        job={
            "rules": list(CONFIG.sensitivity.rules),
            "published": contents(PUBLISHED_IMPACT),
            "code": code_of("sensitivity"),
        },
    script:
        "../scripts/sensitivity.py"
