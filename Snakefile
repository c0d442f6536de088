# From raw test files to the report: `snakemake -j2` here. What depends on what is in workflow/rules.
# workflow/Snakefile is where Snakemake's workflow catalogue, and a study that imports this workflow
# as a module, look for it.
include: "workflow/Snakefile"


# an included rule is not the default target until it is named here
workflow.default_target = "all"
