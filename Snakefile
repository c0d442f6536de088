# From raw test files to the report. What depends on what is said in workflow/rules, one file per stage.
from snakemake.utils import min_version

min_version("9.0")


configfile: "config/config.yaml"


include: "workflow/rules/common.smk"
include: "workflow/rules/ingest.smk"
include: "workflow/rules/reduce.smk"
include: "workflow/rules/calibrate.smk"
include: "workflow/rules/design.smk"
include: "workflow/rules/solve.smk"
include: "workflow/rules/surface.smk"
include: "workflow/rules/responses.smk"
include: "workflow/rules/compare.smk"
include: "workflow/rules/report.smk"


rule all:
    default_target: True
    input:
        "results/report.html",
        "results/workbook.xlsx",
        "results/verdict.txt",
        "results/material_card.json",
        TABLES,
