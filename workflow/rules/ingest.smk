# Raw files → one tidy curve per specimen, and an account of every file in the folder.
from nptcs.ingest.folder import find_file, raw_files

INGEST_BATCH = (
    20  # Snakemake keeps the parameters of a job once for each of its outputs
)


def files_of_specimen(specimen):
    """The specimen's files that exist; a missing one is an error of that specimen alone."""
    found = []
    for name in specimen.files:
        try:
            found.append(str(find_file(SHEET.parent, name)))
        except InputError:
            continue
    return found


def files_of_batch(specimens):
    return [ancient(path) for one in specimens for path in files_of_specimen(one)]


LAB_FILES = [str(path) for path in raw_files(SHEET.parent).values() if path != SHEET]


def ingest_job(specimens):
    return {
        "specimens": [
            {"specimen": plain(one), "files": contents(files_of_specimen(one))}
            for one in specimens
        ],
        "folder": str(SHEET.parent),
        "formats": CONFIG.lab_data.formats,
        "profiles": FACTS.profiles,  # what they say, not their comments or dates
        "settings": plain(CONFIG.ingest),
        "code": code_of("ingest"),
    }


# a rule for each batch, because the outputs of a rule cannot depend on what a wildcard stands for
for series in SERIES:
    for begin in range(0, len(specimens_of_series(series)), INGEST_BATCH):
        batch = specimens_of_series(series)[begin : begin + INGEST_BATCH]

        rule:
            name:
                f"ingest_{series}_{begin // INGEST_BATCH + 1}"
            input:
                lambda wildcards, batch=batch: files_of_batch(batch),
            output:
                # not removed before the job: files for which nothing changed are left as they are
                curves=update(curves(batch)),
                records=update(records(batch)),
            log:
                f"results/logs/ingest/{series}_{begin // INGEST_BATCH + 1}.log",
            params:
                job=lambda wildcards, batch=batch: ingest_job(batch),
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
