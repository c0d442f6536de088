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
    return [ancient(path) for path in found]


LAB_FILES = [str(path) for path in raw_files(SHEET.parent).values() if path != SHEET]


def ingest_job(wildcards):
    return {
        "specimen": plain(SPECIMEN[wildcards.specimen]),
        "files": contents(files_of_specimen(wildcards)),
        "folder": str(SHEET.parent),
        "formats": CONFIG.lab_data.formats,
        "profiles": FACTS.profiles,  # what they say, not their comments or dates
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
        [ancient(path) for path in LAB_FILES],
        sheet=ancient(str(SHEET)),
        records=records(SPECIMENS),
    output:
        files="results/tables/files.csv",
    log:
        "results/logs/account.log",
    params:
        job=lambda wildcards: {
            "files": contents([SHEET, *LAB_FILES]),
            "code": code_of("account", words=True),
        },
    script:
        "../scripts/account.py"
