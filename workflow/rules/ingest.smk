# Raw files → one tidy curve a specimen, and an account of every file in the folder.


def raw_files(wildcards):
    """The specimen's files that exist; a missing one is an error of that specimen alone."""
    paths = [SHEET.parent / name for name in SPECIMEN[wildcards.specimen].files]
    return [str(path) for path in paths if path.is_file()]


# the profiles decide how files are read: their content, not their time stamps
PROFILES = {
    path.name: sha256_of_file(path) for path in sorted(Path(CONFIG.lab_data.formats).glob("*.yaml"))
}


def ingest_job(wildcards):
    return {
        "specimen": plain(SPECIMEN[wildcards.specimen]),
        "folder": str(SHEET.parent),
        "formats": CONFIG.lab_data.formats,
        "profiles": PROFILES,
        "settings": plain(CONFIG.ingest),
        "code": code_hash("nptcs.ingest"),
    }


rule ingest:
    input:
        raw_files,
    output:
        curve="results/1_ingest/{specimen}.csv",
        record="results/1_ingest/{specimen}.json",
    log:
        "results/logs/ingest/{specimen}.log",
    params:
        job=ingest_job,
    script:
        "../scripts/ingest.py"


def files_in_folder():
    """Names, sizes and times of all raw files: what `account` rests on, without reading them."""
    return sorted(
        str(path) for path in SHEET.parent.rglob("*") if path.is_file() and path != SHEET
    )


rule account:
    input:
        sheet=str(SHEET),
        files=files_in_folder(),
        records=records(SPECIMENS),
    output:
        files="results/tables/files.csv",
    log:
        "results/logs/account.log",
    params:
        job={"folder": str(SHEET.parent), "code": code_hash("nptcs.ingest")},
    script:
        "../scripts/account.py"
