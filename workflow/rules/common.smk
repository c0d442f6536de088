# The configuration and the specimen sheet, checked, and what the rules need from them.
import shlex
import sys
import time
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.persistence import PersistenceBase

from nptcs.campaign.queue import batch_count
from nptcs.campaign.schedule import batch_cores, batch_tokens
from nptcs.config.root import read_config
from nptcs.errors import InputError
from nptcs.files import remove_unfinished, sha256_of_file
from nptcs.processes.runs import begin_job, begin_run
from nptcs.processes.stops import stop_jobs_on_signals
from nptcs.report.stale import refused
from nptcs.runs.identity import WORDS_ONLY
from nptcs.start.facts import known_facts
from nptcs.start.pandas_values import look_for_pandas_only_if_imported
from nptcs.tables.laboratory.specimens import read_sheet
from nptcs.threads import one_thread_per_process

STARTED = time.time()
# found from this file: the workflow may be the top Snakefile, or a module of another
SCRIPTS = (
    Path(workflow.current_basedir.get_path_or_uri(secret_free=False)).parent / "scripts"
)
# unquoted, even where another workflow that uses this one as a module has read this file before
PYTHON = (
    sys.executable if Path(sys.executable).exists() else shlex.split(sys.executable)[0]
)

look_for_pandas_only_if_imported(PersistenceBase)
one_thread_per_process()  # of the linear algebra in all jobs; cases already share the cores
# Snakemake writes the interpreter of scripts and submitted jobs into shell commands as it is, and a
# blank in its path (a virtual environment in "OneDrive - Lab") would end the command there: its
# issue 2645, open in 9.27
if Path(sys.executable).exists():
    sys.executable = shlex.quote(sys.executable)

# Snakemake looks at its locks after it has read this file
if not workflow.is_main_process:
    begin_job()
elif begin_run(Path(".snakemake"), workflow.snakemake_tmp_dir):
    remove_unfinished("results")


onstart:
    stop_jobs_on_signals(sys.argv)
    needed = {job.rule.name for job in workflow.dag.needrun_jobs()}
    run_in_forks([rule for rule in workflow.rules if rule.name in needed])
    if any(name.startswith("solve") for name in needed):
        from nptcs.campaign.plan import plan_lines

        print(*plan_lines(CONFIG), sep="\n", file=sys.stderr, flush=True)


def run_in_forks(rules):
    """Let the scripts of rules run in forks of one process, which imports what they import."""
    if sys.platform != "linux":
        return
    from snakemake.script import PythonScript

    from nptcs.processes.hosted import ScriptHost, host_scripts

    host = ScriptHost(PYTHON)
    names = dict.fromkeys(Path(rule.script).name for rule in rules if rule.script)
    solvers = solvers_in_jobs(rules)
    host.prepare(
        [SCRIPTS / name for name in names],
        hashed=dict.fromkeys(one.module for one in solvers),
        compiled=dict.fromkeys(name for one in solvers for name in one.preload),
    )
    host_scripts(PythonScript, SCRIPTS, host)


def solvers_in_jobs(rules):
    """Facts about all solvers, if a rule is needed that solves cases."""
    if not any(rule.name.startswith("solve") for rule in rules):
        return []
    return [one for named in FACTS.solvers.values() for one in named.values()]


def own_solvers():
    """Files of solvers that do not belong to the package."""
    return [
        options["module"]
        for study in CONFIG.studies
        for options in CONFIG.solver_options(study).values()
        if "module" in options
    ]


def decisive():
    """The configuration without the report's wording, which decides nothing that rules must know.

    With the laboratory's own files for the report, which are checked at the start, it is complete.
    """
    own = CONFIG.laboratory.logo or CONFIG.report.templates
    return CONFIG.model_dump(mode="json", exclude=set() if own else set(WORDS_ONLY))


def find_facts():
    """What the rules must know, found with the whole package; see `nptcs.start`."""
    from nptcs.start.survey import survey

    return survey(CONFIG, SPECIMENS, checked=workflow.is_main_process)


try:
    CONFIG = read_config(config)
    SHEET = Path(CONFIG.lab_data.specimen_sheet)
    SPECIMENS, SHEET_ERRORS = read_sheet(SHEET)
    FACTS = known_facts(
        ".snakemake/nptcs/start.json",
        decisive(),
        [
            SHEET,
            *Path(CONFIG.lab_data.formats).glob("*.yaml"),
            *own_solvers(),
            *SCRIPTS.glob("*.py"),
        ],
        find_facts,
    )
except InputError as error:
    raise WorkflowError(refused(error, "results/report.html")) from None

SPECIMEN = {specimen.specimen: specimen for specimen in SPECIMENS}
SERIES = sorted({specimen.series for specimen in SPECIMENS})
RUBBERS = FACTS.rubbers
STUDIES = [study.name for study in CONFIG.studies]
SURFACE_STUDIES = [study.name for study in CONFIG.studies if study.terms]

TABLES = [f"results/tables/{file}" for file in FACTS.tables]


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


def code_of(script, *modules, words=False):
    """Hash of a rule's script, of everything that it imports from the package, and of further modules.

    Snakemake looks at the script's time stamp, which a checkout renews, and not at its imports.
    Rules whose output shows messages and descriptions include these with `words`.
    """
    return FACTS.code_of(
        str(SCRIPTS / f"{script}.py"),
        *modules,
        words=words,
    )


@cache
def content_of(path):
    return sha256_of_file(path) if Path(path).is_file() else "missing"


def contents(paths):
    """Hash of each input file that a user gives, for `params`.

    Such inputs are `ancient`: their content decides whether a rule runs, not their date, which a
    copy, an archive or a checkout may change.
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
    """Facts about a study's solver and its options (`nptcs.start.facts.SolverFacts`)."""
    return FACTS.solvers[study_name][solver_name]


def module_of(solver_name, options):
    """Module or file that defines a solver."""
    return str(options.get("module") or FACTS.modules[solver_name])


def tyre_solvers(study_name):
    """The solvers of a study that load a tyre; the others compute single spokes."""
    return [
        name
        for name in CONFIG.study(study_name).solvers
        if solver_of(study_name, name).loads_tyre
    ]


def batches_of(study_name, solver_name):
    """Number of jobs into which the cases of a study are divided for a solver."""
    cases = CONFIG.study(study_name).number_of_cases()
    return batch_count(cases, CONFIG.campaign, solver_of(study_name, solver_name))


def solved_in_bulk(study_name, solver_name):
    """Whether a solver solves the cases of a study as a table, without a record of each."""
    cases = CONFIG.study(study_name).number_of_cases()
    able = solver_of(study_name, solver_name).solves_tables
    return able and cases >= CONFIG.campaign.bulk_from


def batches(study_name, solver_name=None):
    """The files with the results of a study, of one of its solvers or of all."""
    study = CONFIG.study(study_name)
    return [
        f"results/5_solve/{study_name}/{solver}/"
        + (
            f"bulk_{batch}.npz"
            if solved_in_bulk(study_name, solver)
            else f"batch_{batch}.jsonl"
        )
        for solver in ([solver_name] if solver_name else study.solvers)
        for batch in range(1, batches_of(study_name, solver) + 1)
    ]


def record_batches(study_name, solver_name):
    """Like `batches`, but only those with a record of each case; none if it is solved in bulk."""
    return (
        []
        if solved_in_bulk(study_name, solver_name)
        else batches(study_name, solver_name)
    )
