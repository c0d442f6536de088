# Properties → the ply's nine constants; rubber curves → hyperelastic constants; one card.
PLY_SERIES = sorted({s.series for s in SPECIMENS if not s.test.is_rubber})


rule calibrate_ply:
    input:
        properties=expand("results/2_reduce/{series}.csv", series=PLY_SERIES),
    output:
        card="results/3_calibrate/ply.json",
    log:
        "results/logs/calibrate/ply.log",
    params:
        job={
            "specimens": [plain(s) for s in SPECIMENS if not s.test.is_rubber],
            "settings": plain(CONFIG.calibration),
            "code": code_of("calibrate_ply"),
        },
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
        plies=["results/3_calibrate/ply.json"] if PLY_SERIES else [],
        rubbers=expand("results/3_calibrate/{rubber}.json", rubber=RUBBERS),
        rubber_models=expand("results/3_calibrate/{rubber}_models.csv", rubber=RUBBERS),
        rubber_ranges=expand("results/3_calibrate/{rubber}_ranges.csv", rubber=RUBBERS),
    output:
        card="results/material_card.json",
        models="results/tables/hyperelastic_models.csv",
        ranges="results/tables/c10_against_range.csv",
    log:
        "results/logs/material_card.log",
    params:
        job={"code": code_of("material_card")},
    script:
        "../scripts/material_card.py"
