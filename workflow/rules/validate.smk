# The load-bearing model against the paper's tables 7, 10 and 11, at the loads of figure 15.


rule lca_validation:
    input:
        spoke_stiffness=CONFIG.lca_validation.spoke_stiffness,
        published=CONFIG.lca_validation.published,
        published_loads=CONFIG.lca_validation.published_loads,
        published_fem=CONFIG.lca_validation.published_fem,
    output:
        validation="results/tables/lca_validation.csv",
        fem="results/tables/lca_against_fem.csv",
        neutral_line="results/tables/lca_neutral_line.csv",
    log:
        "results/logs/lca_validation.log",
    params:
        job={
            "settings": plain(CONFIG.lca_validation),
            "tyre": plain(CONFIG.tyre),
            "code": code_of("lca_validation"),
        },
    script:
        "../scripts/lca_validation.py"
