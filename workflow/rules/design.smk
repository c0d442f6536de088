# Factors, levels and kind of design → the design table of each study.


def rubber_cards(wildcards):
    """The cards of the tested rubbers that levels or fixed values of the study name."""
    named = CONFIG.study(wildcards.study).rubbers()
    return [
        f"results/3_calibrate/{rubber}.json" for rubber in named if rubber in RUBBERS
    ]


def design_job(wildcards):
    return {
        "study": CONFIG.study(wildcards.study).case_definition(),
        "tyre": plain(CONFIG.tyre),
        "code": code_of("design"),
    }


rule design:
    input:
        cards=rubber_cards,
    output:
        design="results/4_design/{study}.csv",
    log:
        "results/logs/design/{study}.log",
    params:
        job=design_job,
    script:
        "../scripts/design.py"
