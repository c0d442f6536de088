# Properties → the nine constants of each ply; rubber curves → hyperelastic constants; one card.
PLIES = FACTS.plies


def series_of_material(material):
    return sorted({s.series for s in specimens_of_material(material)})


def calibrate_ply_job(wildcards):
    return {
        "ply": wildcards.ply,
        "specimens": [plain(s) for s in specimens_of_material(wildcards.ply)],
        "settings": plain(CONFIG.calibration),
        "code": code_of("calibrate_ply"),
    }


rule calibrate_ply:
    input:
        properties=lambda wildcards: [
            f"results/2_reduce/{series}.csv"
            for series in series_of_material(wildcards.ply)
        ],
        records=lambda wildcards: records(specimens_of_material(wildcards.ply)),
    output:
        card="results/3_calibrate/{ply}.json",
    log:
        "results/logs/calibrate/{ply}.log",
    wildcard_constraints:
        ply="|".join(map(re.escape, PLIES)) or "none",
    params:
        job=calibrate_ply_job,
    script:
        "../scripts/calibrate_ply.py"


def calibrate_rubber_job(wildcards):
    return {
        "rubber": wildcards.rubber,
        "specimens": [plain(s) for s in specimens_of_material(wildcards.rubber)],
        "settings": plain(CONFIG.calibration),
        "code": code_of("calibrate_rubber"),
    }


rule calibrate_rubber:
    input:
        curves=lambda wildcards: curves(specimens_of_material(wildcards.rubber)),
        records=lambda wildcards: records(specimens_of_material(wildcards.rubber)),
    output:
        card="results/3_calibrate/{rubber}.json",
        models="results/3_calibrate/{rubber}_models.csv",
        ranges="results/3_calibrate/{rubber}_ranges.csv",
    log:
        "results/logs/calibrate/{rubber}.log",
    wildcard_constraints:
        rubber="|".join(map(re.escape, RUBBERS)) or "none",
    params:
        job=calibrate_rubber_job,
    script:
        "../scripts/calibrate_rubber.py"


rule material_card:
    input:
        plies=expand("results/3_calibrate/{ply}.json", ply=PLIES),
        rubbers=expand("results/3_calibrate/{rubber}.json", rubber=RUBBERS),
        rubber_models=expand("results/3_calibrate/{rubber}_models.csv", rubber=RUBBERS),
        rubber_ranges=expand("results/3_calibrate/{rubber}_ranges.csv", rubber=RUBBERS),
    output:
        card=report(
            "results/material_card.json",
            caption="../report/material_card.rst",
            category="Materials",
        ),
        models="results/tables/hyperelastic_models.csv",
        ranges="results/tables/c10_against_range.csv",
    log:
        "results/logs/material_card.log",
    params:
        job={"code": code_of("material_card")},
    script:
        "../scripts/material_card.py"
