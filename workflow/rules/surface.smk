# Solved cases → response surfaces → average gradients and comprehensive impact values.

from nptcs.compare.conditions import surface_faults

FITTED = (
    "name",
    "title",
    "factors",
    "fixed",
    "solvers",
    "solver_options",
    "terms",
    "least_cases",
    "surfaces",
    "load_n",
    "responses",
)


def surface_job(wildcards):
    study = CONFIG.study(wildcards.study)
    return {
        # without title and labels, which decide no number
        "study": {
            **study.model_dump(mode="json", include=set(FITTED)),
            "title": "",
            "factors": study.case_definition()["factors"],
        },
        "responses": response_job() if study.responses else None,
        "published": contents(published_coefficients(wildcards)),
        "code": code_of("surface"),
    }


def response_job():
    """How responses of solved tyres are taken, beyond the stiffness at the study's load."""
    composites = sorted({s.material for s in SPECIMENS if not s.test.is_rubber})
    return {
        "settings": plain(CONFIG.tyre_responses),
        "ply": composites[0] if len(composites) == 1 else None,
    }


def strength_statistics(wildcards):
    """The tested strengths, where the study has further responses."""
    return (
        ["results/tables/statistics.csv"]
        if CONFIG.study(wildcards.study).responses
        else []
    )


def published_coefficients(wildcards):
    path = CONFIG.study(wildcards.study).published_coefficients
    return [ancient(path)] if path else []


def surface_ply(wildcards):
    """The card of the plates' ply, where a surface of the study uses its constants."""
    study = CONFIG.study(wildcards.study)
    if not study.needs_ply():
        return []
    return [f"results/3_calibrate/{FACTS.ply[study.name]}.json"]


rule surface:
    input:
        ply=surface_ply,
        records=lambda wildcards: batches(wildcards.study),
        published=published_coefficients,
        statistics=strength_statistics,
    output:
        table="results/tables/{study}_surface.csv",
        surfaces="results/6_surface/{study}.json",
        models="results/6_surface/models/{study}.json",
        quality="results/6_surface/{study}_quality.csv",
        comparison="results/6_surface/{study}_comparison.csv",
        by_factor="results/6_surface/{study}_by_factor.csv",
        responses="results/6_surface/{study}_responses.csv",
        problems="results/6_surface/{study}_problems.csv",
    log:
        "results/logs/surface/{study}.log",
    priority: 2  # long, and more rules wait for it than for the others
    params:
        job=surface_job,
    script:
        "../scripts/surface.py"


PUBLISHED_IMPACT = list(filter(None, [CONFIG.sensitivity.published_impact]))


rule sensitivity:
    input:
        surfaces=expand("results/6_surface/{study}.json", study=SURFACE_STUDIES),
        designs=expand("results/4_design/{study}.csv", study=SURFACE_STUDIES),
        quality_parts=expand(
            "results/6_surface/{study}_quality.csv", study=SURFACE_STUDIES
        ),
        comparison_parts=expand(
            "results/6_surface/{study}_comparison.csv", study=SURFACE_STUDIES
        ),
        by_factor_parts=expand(
            "results/6_surface/{study}_by_factor.csv", study=SURFACE_STUDIES
        ),
        response_surfaces_parts=expand(
            "results/6_surface/{study}_responses.csv", study=SURFACE_STUDIES
        ),
        published=[ancient(path) for path in PUBLISHED_IMPACT],
    output:
        impact=report(
            "results/tables/impact.csv",
            caption="../report/impact.rst",
            category="Sensitivity",
        ),
        quality="results/tables/surface_quality.csv",
        comparison="results/tables/surface_comparison.csv",
        by_factor="results/tables/surface_by_factor.csv",
        response_surfaces="results/tables/response_surfaces.csv",
    log:
        "results/logs/sensitivity.log",
    params:
        job={
            "rules": list(CONFIG.sensitivity.rules),
            "near_tie_ratio": CONFIG.sensitivity.near_tie_ratio,
            "published": contents(PUBLISHED_IMPACT),
            "refused": [
                study.name for study in CONFIG.studies if surface_faults(study)
            ],
            "code": code_of("sensitivity"),
        },
    script:
        "../scripts/sensitivity.py"


rule diagnostics:
    input:
        surfaces=expand("results/6_surface/{study}.json", study=SURFACE_STUDIES),
    output:
        tests="results/tables/surface_tests.csv",
        anova="results/tables/surface_anova.csv",
        influence="results/tables/surface_influence.csv",
        stationary="results/tables/surface_stationary.csv",
        selection="results/tables/surface_selection.csv",
    log:
        "results/logs/diagnostics.log",
    params:
        job={"code": code_of("diagnostics")},
    script:
        "../scripts/diagnostics.py"


rule sobol:
    input:
        models=expand("results/6_surface/models/{study}.json", study=SURFACE_STUDIES),
        quality="results/tables/surface_quality.csv",
    output:
        indices="results/tables/sobol_indices.csv",
        effects="results/tables/main_effects.csv",
        impacts="results/tables/response_impact.csv",
        problems="results/6_surface/sobol/problems.csv",
    log:
        "results/logs/sobol.log",
    priority: 1  # long, and the report waits for it
    params:
        job={"settings": plain(CONFIG.sensitivity), "code": code_of("sobol")},
    script:
        "../scripts/sobol.py"


rule case_coverage:
    input:
        cases="results/tables/cases.csv",
        designs=expand("results/4_design/{study}.csv", study=STUDIES),
    output:
        coverage="results/tables/case_coverage.csv",
    log:
        "results/logs/case_coverage.log",
    params:
        job={
            "studies": {
                study.name: {
                    "factors": [factor.name for factor in study.factors],
                    "solvers": list(study.solvers),
                    "terms": list(study.terms),
                    "least_cases": study.least_solved_cases(),
                }
                for study in CONFIG.studies
            },
            "code": code_of("case_coverage"),
        },
    script:
        "../scripts/case_coverage.py"
