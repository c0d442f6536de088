# Raw files → one tidy curve per specimen, and an account of every file in the folder.
from nptcs.ingest.folder import find_file, raw_files


def files_of_specimen(wildcards):
    """The specimen's files that exist; a missing one is an error of that specimen alone."""
    found = []
    for name in SPECIMEN[wildcards.specimen].files:
        try:
            found.append(str(find_file(SHEET.parent, name)))
        except InputError:
            continue
    return found


# the profiles decide how files are read: their content, not their time stamps
PROFILES = {
    path.name: sha256_of_file(path)
    for path in sorted(Path(CONFIG.lab_data.formats).glob("*.yaml"))
}


def ingest_job(wildcards):
    return {
        "specimen": plain(SPECIMEN[wildcards.specimen]),
        "folder": str(SHEET.parent),
        "formats": CONFIG.lab_data.formats,
        "profiles": PROFILES,
        "settings": plain(CONFIG.ingest),
        "code": code_of("ingest"),
    }


rule ingest:
    input:
        files_of_specimen,
    output:
        curve="results/1_ingest/{specimen}.csv",
        record="results/1_ingest/{specimen}.json",
    log:
        "results/logs/ingest/{specimen}.log",
    params:
        job=ingest_job,
    script:
        "../scripts/ingest.py"


rule account:
    input:
        [str(path) for path in raw_files(SHEET.parent).values() if path != SHEET],
        sheet=str(SHEET),
        records=records(SPECIMENS),
    output:
        files="results/tables/files.csv",
    log:
        "results/logs/account.log",
    params:
        job={"code": code_of("account")},
    script:
        "../scripts/account.py"
