"""Two runs' input files by their checksums."""

from __future__ import annotations

from nptcs.language import tr
from nptcs.runs.finished import FinishedRun
from nptcs.runs.part import RESULT, Found, Part, part_table, presence


def compare_inputs(a: FinishedRun, b: FinishedRun) -> Part:
    """Compare the input files of two runs by name and SHA-256."""
    rows: list[dict[str, object]] = []
    for file in sorted({*a.inputs, *b.inputs}):
        one, two = a.inputs.get(file), b.inputs.get(file)
        found = presence(one is not None, two is not None)
        if found is None:
            found = Found.SAME if one == two else Found.DIFFERENT
        rows.append({"file": file, "sha256_a": one or "", "sha256_b": two or "", RESULT: found})
    return Part(
        "inputs",
        tr("Input files"),
        tr("Files of the laboratory and files that the configuration names, by their SHA-256."),
        part_table(rows, ["file", "sha256_a", "sha256_b"]),
        tuple(
            tr(
                "run {run} has no identity: only the inputs that its folder still holds are known",
                run=letter,
            )
            for letter, run in (("A", a), ("B", b))
            if run.identity is None
        ),
    )
