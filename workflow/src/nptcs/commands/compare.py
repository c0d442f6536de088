"""``nptcs compare``: what differs between two finished runs, and whether it matters."""

from __future__ import annotations

import argparse
import json
import tempfile
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

from nptcs.arguments import add_command, number_type, output_file
from nptcs.language import Language
from nptcs.ranges import Range
from nptcs.text_table import text_table

if TYPE_CHECKING:
    from nptcs.runs.compare import ComparedRuns
    from nptcs.runs.finished import FinishedRun
    from nptcs.runs.part import Part

MOST_ROWS = 12
"""Rows of a table that the terminal shows; page, workbook and JSON have them all."""

SHOWN = {
    "inputs": ("file", "result"),
    "constants": (
        "material",
        "constant",
        "a",
        "b",
        "unit",
        "difference_percent",
        "difference_over_error",
        "beyond_uncertainty",
        "data",
        "result",
    ),
    "stiffness_summary": (
        "study",
        "solver",
        "cases",
        "compared",
        "mean_percent",
        "largest_percent",
        "largest_case",
        "result",
    ),
    "ranking": (
        "study",
        "solver",
        "response",
        "factor",
        "impact_a",
        "impact_b",
        "rank_a",
        "rank_b",
        "note",
        "result",
    ),
    "decisions": ("decision", "what", "a", "b", "result"),
    "configuration": ("key", "a", "b", "result"),
    "software": ("software", "a", "b", "result"),
}
"""Columns that the terminal shows; cases and tables are printed differently."""


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "compare",
        "compare two finished runs: two campaigns, configurations or versions",
        "Compares inputs, material constants, stiffness, ranking, decisions, configuration, "
        "software and every table of two finished runs. Exit code: 0 no difference, 1 the runs "
        "differ or something could not be compared, 2 they cannot be compared.",
        "nptcs compare ../march .",
        "nptcs compare march.zip april.zip",
        "nptcs compare march.zip . --page changes.html --workbook changes.xlsx",
    )
    what = "project folder, folder of results, or archive made by 'nptcs archive'"
    parser.add_argument("a", metavar="A", help=f"the first run: {what}")
    parser.add_argument("b", metavar="B", help="the second run, likewise")
    parser.add_argument(
        "--page", type=output_file(".html"), metavar="FILE.html", help="write an HTML page"
    )
    parser.add_argument(
        "--workbook", type=output_file(".xlsx"), metavar="FILE.xlsx", help="write a workbook"
    )
    parser.add_argument(
        "--language",
        choices=get_args(Language),
        help="language of page and workbook; default: that of the report of B",
    )
    parser.add_argument("--json", action="store_true", help="print JSON for programs")
    parser.add_argument(
        "--k",
        type=number_type(Range(0, open_low=True)),
        default=2.0,
        help="coverage factor: a constant differs by more than its uncertainty if |B - A| > k "
        "times the combined standard error; default: %(default)g",
    )
    parser.add_argument(
        "--within",
        type=number_type(Range(0, 1)),
        default=1e-9,
        help="relative difference up to which numbers are the same; default: %(default)g",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print the comparison; 1 if anything differs or could not be compared."""
    from nptcs.language import language
    from nptcs.runs.compare import compare_runs

    for given in (arguments.a, arguments.b):
        refuse_missing(given)

    with ExitStack() as stack:
        a, b = (open_run(Path(given), stack) for given in (arguments.a, arguments.b))
        done = compare_runs(a, b, arguments.k, arguments.within)
        print(as_json(done) if arguments.json else as_text(done))
        if arguments.page is not None or arguments.workbook is not None:
            with language(arguments.language or b.language):
                write_outputs(compare_runs(a, b, arguments.k, arguments.within), arguments)
    return 0 if done.same else 1


def refuse_missing(given: str) -> None:
    """Refuse a run that does not exist, before the other one is read."""
    from nptcs.errors import InputError

    if not Path(given).exists():
        raise InputError(
            "this run does not exist", "name a folder or an archive made by 'nptcs archive'", given
        )


def open_run(given: Path, stack: ExitStack) -> FinishedRun:
    """Read a run from a folder, or from an archive, which must be as it was packed.

    Raises
    ------
    InputError
        If it is neither, if an archive was damaged or edited, and as
        `nptcs.runs.finished.read_run`.
    """
    from nptcs.archive.verify import packed_faults, packed_software, unpack
    from nptcs.errors import InputError
    from nptcs.runs.finished import read_run

    if given.is_dir():
        return read_run(given, str(given))
    folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="nptcs-compare-")))
    unpack(given, folder)
    if faults := packed_faults(folder):
        more = f" and {len(faults) - 1} more" if len(faults) > 1 else ""
        raise InputError(
            f"this archive was changed after it was packed: {faults[0]}{more}",
            "'nptcs verify' lists every fault; copy the archive again from where it was written",
            given,
        )
    return read_run(folder, str(given), packed_software(folder))


def write_outputs(done: ComparedRuns, arguments: argparse.Namespace) -> None:
    """Write the page and the workbook if they are requested."""
    import sys

    from nptcs.files import atomic_path, write_text
    from nptcs.report.comparison.page import comparison_page
    from nptcs.report.comparison.workbook import comparison_workbook

    if arguments.page is not None:
        write_text(arguments.page, comparison_page(done))
        print(f"page: {arguments.page}", file=sys.stderr)
    if arguments.workbook is not None:
        with atomic_path(arguments.workbook) as temporary:
            temporary.write_bytes(comparison_workbook(done))
        print(f"workbook: {arguments.workbook}", file=sys.stderr)


def as_text(done: ComparedRuns) -> str:
    """Write a comparison for a reader."""
    lines = [f"A = {done.a}", f"B = {done.b}"]
    if done.synthetic:
        lines.append("SYNTHETIC example data are among the materials of these runs.")
    if done.same_identity:
        lines.append("Both runs have the same identity.")
    lines += ["", done.verdict()]
    lines += [f"  {sentence}" for sentence in done.sentences()]
    for part in done.parts:
        if part.name != "stiffness":
            lines += _part_lines(part)
    return "\n".join(lines)


def _part_lines(part: Part) -> list[str]:
    """Write one part: its headline, what could not be compared, and the rows that differ."""
    from nptcs.runs.all_tables import described
    from nptcs.runs.part import RESULT

    lines = ["", f"{part.title}: {part.headline()}"]
    lines += [f"  note: {remark}" for remark in part.remarks]
    changed = part.differences
    if part.name not in SHOWN:
        lines += [f"  {file}: {words}" for file, words in described(part).items()]
        return lines
    columns = [
        name
        for name in SHOWN[part.name]
        if name == RESULT or not changed[name].map(_cell).eq("").all()
    ]
    if not changed.empty:
        rows = _rows(part)[:MOST_ROWS]
        numeric = [all(_is_number(row[name]) for row in rows) for name in columns]
        table = text_table(
            [name.replace("_", " ") for name in columns],
            [[_cell(row[name]) for name in columns] for row in rows],
            numeric,
        )
        lines += [f"  {line}" for line in table.splitlines()]
    if len(changed) > MOST_ROWS:
        lines.append(f"  … and {len(changed) - MOST_ROWS} more")
    return lines


def _rows(part: Part) -> list[dict[str, Any]]:
    records = part.differences.to_dict("records")
    return [{str(key): value for key, value in row.items()} for row in records]


def _is_number(value: object) -> bool:
    return isinstance(value, int | float)


def _cell(value: object) -> str:
    """Write one value to five digits; an empty text for a missing value."""
    if value is None or value != value:
        return ""
    text = f"{value:.5g}" if isinstance(value, float) else str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def as_json(done: ComparedRuns) -> str:
    """Write a comparison for a program: every row of every part."""
    content = {
        "a": done.a,
        "b": done.b,
        "same": done.same,
        "same_identity": done.same_identity,
        "synthetic": done.synthetic,
        "k": done.k,
        "within": done.within,
        "verdict": done.verdict(),
        "sentences": done.sentences(),
        "parts": {
            part.name: {
                "title": part.title,
                "about": part.about,
                "same": part.same,
                "remarks": part.remarks,
                "rows": json.loads(part.table.to_json(orient="records", double_precision=15)),
            }
            for part in done.parts
        },
    }
    return json.dumps(content, indent=1, ensure_ascii=False)
