"""Propose a specimen sheet from a folder of exports; what is not known stays empty."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from nptcs.errors import InputError
from nptcs.ingest.folder import is_note, raw_files
from nptcs.ingest.inspect import Inspection, inspect_file
from nptcs.ingest.reading.labels import LabelValue
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.quantities import LOADS, STRAINS, Test
from nptcs.ingest.reading.raw_file import header_labels
from nptcs.tables.specimens import COLUMNS

_ROLE_WORDS = re.compile(
    r"(?i)[ _.-]+(vic-?[23]d|vic|dic|aramis|gom|strain|strains|dehnung|force|load|kraft|wdw|mts|"
    r"instron|bluehill|zwick|shimadzu|machine|raw|rawdata|data|camera|extensometer)$"
)
_DIMENSIONS = {"width": "width_mm", "thickness": "thickness_mm", "gauge_length": "gauge_length_mm"}


@dataclass
class Proposal:
    """A proposed sheet, and the files that found no place in it with the reason."""

    rows: list[dict[str, str]] = field(default_factory=list)
    left: dict[str, str] = field(default_factory=dict)

    def text(self) -> str:
        """Return the sheet as CSV."""
        out = io.StringIO(newline="")
        writer = csv.DictWriter(out, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.rows)
        return out.getvalue()


def propose_sheet(folder: Path, profiles: Mapping[str, FormatProfile]) -> Proposal:
    """Look into every file of a folder and propose a row for each test with a force.

    A file of strains only goes with the force file of the same name, role words such as
    ``_vic3d`` apart. Dimensions come from the files' headers. Test, material and fibre angle
    cannot be known from a file and stay empty: the sheet is refused until they are filled in.
    A README is a note and is passed over.

    Raises
    ------
    InputError
        If no file of the folder holds a test.
    """
    proposal = Proposal()
    strains: dict[str, str] = {}
    for name, path in raw_files(folder).items():
        if is_note(name):
            continue
        try:
            inspection = inspect_file(path, profiles)
        except InputError as error:
            proposal.left[name] = error.message
            continue
        loaded = [test for test in inspection.tests if set(LOADS) & set(test.quantities)]
        loaded = [test for test in loaded if _has_strain_or_travel(test)] or loaded
        if loaded:
            proposal.rows += [_row(name, test, inspection, len(loaded) > 1) for test in loaded]
        elif any(set(STRAINS) & set(test.quantities) for test in inspection.tests):
            strains[name] = specimen_id(name)
        else:
            problem = inspection.problem
            proposal.left[name] = problem.message if problem else "no force and no strain found"
    _add_strain_files(proposal, strains)
    if not proposal.rows:
        raise InputError(
            "no file holds a test", "look at one file with: nptcs inspect FILE", folder
        )
    return proposal


def specimen_id(name: str) -> str:
    """Specimen id from a file name: without folder, suffix and role words."""
    stem = Path(name).stem
    while _ROLE_WORDS.search(stem):
        stem = _ROLE_WORDS.sub("", stem)
    return re.sub(r"[^A-Za-z0-9._-]+", "_", stem).strip("_") or "specimen"


def _has_strain_or_travel(test: Test) -> bool:
    return bool({*STRAINS, "displacement"} & set(test.quantities))


def _row(name: str, test: Test, inspection: Inspection, several: bool) -> dict[str, str]:
    labels = header_labels(test, inspection.profile, inspection.dialect)
    own = specimen_id(test.label) if several else specimen_id(name)
    row = {
        "specimen": f"{specimen_id(name)}_{own}" if several and own.isdigit() else own,
        "force_file": name,
        "force_part": test.label if several else "",
        "include": "yes",
        "origin": "measured",
        "remarks": "proposed: fill in test, material, orientation_deg"
        + _missing_dimensions(labels),
    }
    for label, column in _DIMENSIONS.items():
        found = labels.get(label)
        if found is not None and found.value is not None:
            row[column] = f"{found.value:g}"
    return row


def _missing_dimensions(labels: Mapping[str, LabelValue]) -> str:
    missing = [
        column
        for label, column in _DIMENSIONS.items()
        if label not in labels or labels[label].value is None
    ]
    return "".join(f", {column}" for column in missing)


def _add_strain_files(proposal: Proposal, strains: dict[str, str]) -> None:
    for name, own in strains.items():
        rows = [row for row in proposal.rows if row["specimen"].casefold() == own.casefold()]
        if len(rows) == 1 and not rows[0].get("strain_file"):
            rows[0]["strain_file"] = name
        else:
            proposal.left[name] = f"strains of '{own}', but {len(rows)} force files of that name"
