"""The state of a run in words: the line that refreshes, and what is said at the end."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Sequence
from pathlib import Path

from nptcs.campaign.progress import Progress
from nptcs.errors import InputError
from nptcs.files import read_model
from nptcs.monitor.run import Run
from nptcs.runs.identity import RunIdentity

PAGES = ("results/report.html", "results/workbook.xlsx")
IDENTITY = "results/identity.json"
RECORDS = ".snakemake/metadata"
"""Where Snakemake records what it made each file from, under the file's name in base64."""

CHATTER = re.compile(
    r"^(RuleException|CalledProcessError|Error in rule|Error in group|Exiting because|"
    r"At least one job did not complete|Trying to restart|WorkflowError:\s*At least one job|"
    r"Not all output, log and benchmark|Full Traceback|\s*$)"
)
"""Messages of Snakemake that say less than the job's own message, which was shown before."""

SAID = re.compile(
    r"^(Nothing to be done|Unlocking|Touching|Will exit after|Terminating|Creating report|"
    r"Successfully|Report created)"
)
"""Messages of Snakemake that are not errors and that a person needs."""

TRACE = re.compile(r'(\n\s+File "[^\n]*)+\s*$')
"""Lines in which Snakemake says where its own file was being read."""

PLACE = re.compile(r"^WorkflowError(?: in file [^\n]*)?:?\n")


def duration(seconds: float) -> str:
    """Write a time in words.

    Examples
    --------
    >>> duration(41.2), duration(400), duration(9000)
    ('41 s', '7 min', '2.5 h')
    """
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def status_line(run: Run, width: int) -> str:
    """Write the line that refreshes: jobs, then each study and solver that is not done."""
    parts = [f"{run.done} of {run.total} jobs"]
    if run.failed:
        parts.append(f"{len(run.failed)} failed")
    open_ones = [one for one in run.campaigns() if one["done"] < one["total"]]
    parts += [campaign_words(one) for one in open_ones]
    line = " · ".join(parts)
    return line if len(line) < width else line[: width - 2] + "…"


def campaign_words(progress: Progress) -> str:
    """Say how far the cases of a study are by one solver."""
    words = f"{progress['study']}/{progress['solver']} {progress['done']:,}/{progress['total']:,}"
    if progress["failed"]:
        words += f", {progress['failed']:,} failed"
    if progress["left_s"] is not None and progress["done"] < progress["total"]:
        words += f", {duration(progress['left_s'])} left"
    return words


def closing_lines(
    run: Run,
    seconds: float,
    log: str,
    pages: Sequence[str] = PAGES,
    identity: str = IDENTITY,
) -> list[str]:
    """Say at the end what was done, what failed, and where the report is."""
    jobs = f"{run.done} of {run.total} jobs in {duration(seconds)}"
    lines = [jobs if run.failed or run.done < run.total else f"Done: {jobs}"]
    lines += [f"  {campaign_words(one)}" for one in run.campaigns()]
    for job in run.failed:
        lines.append(f"FAILED {job}: {first_line(job.log)}")
    lines += page_lines(pages)
    lines += identity_lines(identity)
    if log:
        lines.append(f"log of the run: {log}")
    return lines


def identity_lines(file: str) -> list[str]:
    """Name the run by its identity, once all its tables are there."""
    if not Path(file).is_file():
        return []
    try:
        found = read_model(file, RunIdentity)
    except InputError:
        return []  # being written again, or edited: the next reader of results says so
    return [f"run {found.short}: tables complete {found.made_text}"]


def page_lines(pages: Sequence[str] = PAGES) -> list[str]:
    """Name the report and the workbook, if they exist."""
    return [f"{Path(page).stem}: {page}" for page in pages if Path(page).is_file()]


def unrecorded_lines(pages: Sequence[str] = PAGES, records: str = RECORDS) -> list[str]:
    """Name the pages without a record of how they were made: Snakemake sees no change of theirs."""
    folder = Path(records)
    unrecorded = [
        page
        for page in pages
        if Path(page).is_file() and not (folder / b64encode(page.encode()).decode()).is_file()
    ]
    if not unrecorded:
        return []
    return [
        f"{', '.join(unrecorded)}: {records} has no record of how this was made, for example "
        "because results were copied here; changes of code and configuration since then were not "
        "noticed. To make everything but solved cases again: snakemake -j2 --forceall"
    ]


def first_line(log: str) -> str:
    """Return the first line of a job's log, or say that it has none."""
    try:
        text = Path(log).read_text(encoding="utf-8", errors="replace").strip()
    except OSError:
        text = ""
    return text.splitlines()[0] if text else "see the messages above"


def error_message(text: str) -> str:
    """Take from an error of Snakemake what a user needs; empty if it was already said."""
    text = TRACE.sub("", PLACE.sub("", text, count=1))
    return "" if CHATTER.match(text) else text.strip()
