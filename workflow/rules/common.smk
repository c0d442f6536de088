# The configuration and the specimen sheet, checked; what the rules ask of them.
import shlex
import sys
import time
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError

from nptcs.calibrate.plan import check_materials, plies, ply_of, rubbers
from nptcs.campaign.checks import name_faults, refuse_faults, study_faults
from nptcs.campaign.queue import batch_count
from nptcs.campaign.schedule import batch_cores, batch_tokens
from nptcs.config.root import read_config
from nptcs.errors import InputError
from nptcs.files import sha256_of_file
from nptcs.provenance import code_hash
from nptcs.solvers.registry import (
    load,
    model_choices,
    module_of,
    needs_ply,
    read_options,
)
from nptcs.tables.catalogue import result_files
from nptcs.tables.specimens import read_sheet
from nptcs.threads import one_thread_per_process

STARTED = time.time()

one_thread_per_process()  # of the linear algebra in all jobs; cases already share the cores
# Snakemake writes the interpreter of scripts and submitted jobs into shell commands as it is, and a
# blank in its path (a virtual environment in "OneDrive - Lab") would end the command there: its
# issue 2645, open in 9.27
if Path(sys.executable).exists():
    sys.executable = shlex.quote(sys.executable)

try:
    CONFIG = read_config(config)
    SHEET = Path(CONFIG.lab_data.specimen_sheet)
    SPECIMENS, SHEET_ERRORS = read_sheet(SHEET)
    faults, _ = check_materials(
        [
            (study, needs_ply(study, CONFIG.solver_options(study)))
            for study in CONFIG.studies
        ],
        SPECIMENS,
        CONFIG.calibration,
    )
    if faults:
        raise faults[0]
    if workflow.is_main_process:
        refuse_faults([*study_faults(CONFIG), *name_faults(SPECIMENS, CONFIG)])
except InputError as error:
    raise WorkflowError(str(error)) from None

SPECIMEN = {specimen.specimen: specimen for specimen in SPECIMENS}
SERIES = sorted({specimen.series for specimen in SPECIMENS})
RUBBERS = rubbers(SPECIMENS)
STUDIES = [study.name for study in CONFIG.studies]
SURFACE_STUDIES = [study.name for study in CONFIG.studies if study.terms]

TABLES = [f"results/tables/{file}" for file, _, _ in result_files(SURFACE_STUDIES)]


wildcard_constraints:
    specimen="[A-Za-z0-9._-]+",
    series="[A-Za-z0-9._-]+",
    rubber="[A-Za-z0-9._-]+",
    study="[a-z][a-z0-9_]*",
    solver="[a-z][a-z0-9_]*",
    batch=r"\d+",


def plain(section):
    """A configuration section or a row of the sheet as plain values.

    Snakemake notices each change of them. Remarks decide nothing; only the report shows them.
    """
    return section.model_dump(mode="json", exclude={"remarks"})


# found from this file: the workflow may be the top Snakefile, or a module of another
SCRIPTS = (
    Path(workflow.current_basedir.get_path_or_uri(secret_free=False)).parent / "scripts"
)


def code_of(script, *modules, words=False):
    """Hash of a rule's script, of everything that it imports from the package, and of further modules.

    Snakemake looks at the script's time stamp, which a checkout renews, and not at its imports.
    Rules whose output shows messages and descriptions ask for `words` too.
    """
    return code_hash(
        str(SCRIPTS / f"{script}.py"),
        *modules,
        words=words,
    )


@cache
def content_of(path):
    return sha256_of_file(path) if Path(path).is_file() else "missing"


def contents(paths):
    """Hash of each input file that a user gives, for `params`.

    Such inputs are `ancient`: what they hold decides whether a rule runs, not their date, which
    a copy, an archive or a checkout sets as it likes.
    """
    return {str(path): content_of(str(path)) for path in paths}


def specimens_of_series(series):
    return [specimen for specimen in SPECIMENS if specimen.series == series]


def specimens_of_material(material):
    return [specimen for specimen in SPECIMENS if specimen.material == material]


def curves(specimens):
    return [f"results/1_ingest/{specimen.specimen}.csv" for specimen in specimens]


def records(specimens):
    return [f"results/1_ingest/{specimen.specimen}.json" for specimen in specimens]


def solver_of(study_name, solver_name):
    """A study's solver with its checked options."""
    options = CONFIG.solver_options(CONFIG.study(study_name))[solver_name]
    solver = load(module_of(solver_name, options))
    return solver, read_options(solver, options)


def tyre_solvers(study_name):
    """The solvers of a study that load a tyre; the others compute single spokes."""
    return [
        name
        for name in CONFIG.study(study_name).solvers
        if solver_of(study_name, name)[0].loads_tyre
    ]


def batches_of(study_name, solver_name):
    """Number of jobs into which the cases of a study are divided for a solver."""
    _, options = solver_of(study_name, solver_name)
    return batch_count(
        CONFIG.study(study_name).number_of_cases(), CONFIG.campaign, options
    )


def batches(study_name, solver_name=None):
    study = CONFIG.study(study_name)
    return [
        f"results/5_solve/{study_name}/{solver}/batch_{batch}.jsonl"
        for solver in ([solver_name] if solver_name else study.solvers)
        for batch in range(1, batches_of(study_name, solver) + 1)
    ]
