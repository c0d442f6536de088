"""Propose a specimen sheet from a folder of exports; what is not known stays empty."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.dimension_tables import Dimensions, read_dimensions
from nptcs.ingest.file_names import (
    family,
    proposed_angle,
    proposed_material,
    proposed_test,
    series_names,
    specimen_id,
    unique_ids,
)
from nptcs.ingest.folder import is_note, raw_files
from nptcs.ingest.inspect import Inspection, inspect_file
from nptcs.ingest.kinds_of_files import is_camera, is_field, is_summary
from nptcs.ingest.pair_files import NO_MACHINE, add_dimensions, pair_cameras
from nptcs.ingest.reading.columns.labels import LabelValue
from nptcs.ingest.reading.columns.names import LOADS, STRAINS
from nptcs.ingest.reading.columns.quantities import Test
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.raw_file import head_lines, header_labels
from nptcs.ingest.reading.units import VOLTS
from nptcs.ingest.runs_of_pieces import mark_runs
from nptcs.ingest.strain_fields import FEWEST_FRAMES
from nptcs.mechanical_tests import TestType
from nptcs.tables.laboratory.specimens import COLUMNS

__all__ = ["Proposal", "propose_sheet", "specimen_id"]

_DIMENSIONS = {"width": "width_mm", "thickness": "thickness_mm", "gauge_length": "gauge_length_mm"}


@dataclass
class Proposal:
    """A proposed sheet, and the files left out of it with the reasons."""

    rows: list[dict[str, str]] = field(default_factory=list)
    left: dict[str, str] = field(default_factory=dict)
    travel_only: set[str] = field(default_factory=set)
    """Force files whose only strain is the crosshead's travel."""
    lengths_only: set[str] = field(default_factory=set)
    """Force files whose strain, if there is one, is in mm: an extension or a travel."""

    def text(self) -> str:
        """Return the sheet as CSV."""
        out = io.StringIO(newline="")
        writer = csv.DictWriter(out, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.rows)
        return out.getvalue()

    def open_series(self) -> dict[str, tuple[int, list[str]]]:
        """For each series, the number of its rows and the columns that a person has to fill in."""
        names = series_names(row["force_file"] for row in self.rows)
        found: dict[str, tuple[int, list[str]]] = {}
        for row in self.rows:
            count, wanted = found.get(names[row["force_file"]], (0, []))
            wanted = list(dict.fromkeys([*wanted, *self.open_in(row)]))
            found[names[row["force_file"]]] = (count + 1, wanted)
        return found

    def open_cells(self) -> dict[str, int]:
        """Count the rows in which a person still has to fill in each column."""
        wanted: Counter[str] = Counter()
        for row in self.rows:
            wanted.update(self.open_in(row))
        return dict(wanted)

    def open_in(self, row: Mapping[str, str]) -> list[str]:
        """Columns that a person has to fill in before the row is accepted and can be reduced."""
        needed = ["test", "material", "width_mm", "thickness_mm"]
        test, file = row.get("test", ""), row["force_file"]
        if not test.startswith("rubber"):
            needed.insert(2, "orientation_deg")
        if test in _BENDING:
            needed.append("span_mm")
        elif file in self.lengths_only and not row.get("strain_file"):
            optional = file in self.travel_only and not test.startswith("rubber")
            needed += [] if optional else ["gauge_length_mm"]
        return [column for column in needed if not row.get(column)]


@dataclass
class _Found:
    """What the files of a folder contain: tests with a force, strains alone, dimensions.

    `with_force` are strain files that contain a copy of the machine's force.
    """

    tests: list[tuple[str, Test, Inspection, bool]] = field(default_factory=list)
    copies: dict[str, str] = field(default_factory=dict)
    strains: list[str] = field(default_factory=list)
    with_force: dict[str, tuple[Test, Inspection]] = field(default_factory=dict)
    dimensions: list[Dimensions] = field(default_factory=list)


_BENDING = {test.value for test in TestType if test.is_bending}
_IN_STRAIN = set(STRAINS) - {"extension"}
_ANGLES = {TestType.SHEAR.value: "45"}  # no other test implies an angle


def propose_sheet(
    folder: Path,
    profiles: Mapping[str, FormatProfile],
    limits: FileLimits = FileLimits(),  # noqa: B008  (immutable)
) -> Proposal:
    """Look into every file of a folder and propose a row for each test with a force.

    A camera's file goes with the machine's file whose names, folders included, name the same
    specimen: ``DIC/DIC_UD_1.csv`` with ``MTS/MTS_UD_1.csv``. Dimensions come from the heads of
    the files, or from tables of dimensions in the folder. Test, material and fibre angle are
    proposed where names or heads contain a word for them, and marked in the remarks; where none
    does, they stay empty and the sheet is refused until a person fills them in. Notes and
    summaries are left out with the reason; a copy of another file is proposed as left out.

    Raises
    ------
    InputError
        If no file of the folder contains a test.
    """
    proposal = Proposal()
    found = _look(folder, profiles, proposal, limits)
    proposal.rows = [_row(*test) for test in found.tests]
    for row in proposal.rows:
        if row["force_file"] in found.copies:
            first = found.copies[row["force_file"]]
            row |= {"include": "no", "reason": f"the same bytes as {first}"}
    proposal.left |= pair_cameras(proposal.rows, found.strains)
    _add_cameras_alone(found, proposal)
    add_dimensions(proposal.rows, found.dimensions)
    names = {
        number: (row["specimen"], row["force_file"]) for number, row in enumerate(proposal.rows)
    }
    for number, own in unique_ids(names).items():
        proposal.rows[number]["specimen"] = own
    mark_runs(proposal.rows)
    for number in names:
        _remark(proposal.rows[number], proposal)
    if not proposal.rows:
        why = "".join(f"; {name}: {reason}" for name, reason in list(proposal.left.items())[:1])
        raise InputError(
            f"no file holds a test{why}", "look at one file with: nptcs inspect FILE", folder
        )
    return proposal


def _add_cameras_alone(found: _Found, proposal: Proposal) -> None:
    """Propose a camera's file with a force as a test where no machine's file goes with it."""
    for name, (test, inspection) in found.with_force.items():
        force = test.quantities.get("force")
        if proposal.left.get(name) != NO_MACHINE or force is None:
            continue
        if force.unit and force.unit not in VOLTS:
            del proposal.left[name]
            proposal.rows.append(_row(name, test, inspection, several=False))
        else:
            proposal.left[name] = (
                f"{NO_MACHINE}, and the unit of its own force ('{force.name}') is not known: state "
                "it in a profile, and name file and profile in the sheet"
            )


def _look(
    folder: Path, profiles: Mapping[str, FormatProfile], proposal: Proposal, limits: FileLimits
) -> _Found:
    """Read every file once and sort it; of a camera's frames only the first one."""
    found = _Found()
    seen: dict[str, str] = {}
    files = {name: path for name, path in raw_files(folder).items() if not is_note(name)}
    sizes = Counter(map(family, files))
    frames: set[str] = set()
    for name, path in files.items():
        if family(name) in frames:
            continue
        try:
            inspection = inspect_file(path, profiles, limits=limits)
        except InputError as error:
            proposal.left[name] = error.message
            continue
        if sizes[family(name)] >= FEWEST_FRAMES and is_field(inspection):
            frames.add(family(name))
            found.strains.append(str(PurePosixPath(name).parent))
            continue
        first = seen.setdefault(inspection.opened.sha256, name)
        if first != name:
            found.copies[name] = first
        _sort(name, path, inspection, profiles, found, proposal, limits)
    return found


def _sort(
    name: str,
    path: Path,
    inspection: Inspection,
    profiles: Mapping[str, FormatProfile],
    found: _Found,
    proposal: Proposal,
    limits: FileLimits,
) -> None:
    """Put a file with the tests, the strains or the dimensions, or leave it with the reason."""
    loaded = [test for test in inspection.tests if set(LOADS) & set(test.quantities)]
    loaded = [test for test in loaded if _has_strain_or_travel(test)] or loaded
    dimensions = [] if loaded else read_dimensions(name, path, profiles, limits)
    if cameras := [test for test in inspection.tests if is_camera(test)]:
        found.strains.append(name)
        if loaded and len(cameras) == 1:
            found.with_force[name] = cameras[0], inspection
    elif dimensions:
        found.dimensions += dimensions
        proposal.left[name] = f"a table of dimensions of {len(dimensions)} specimens"
    elif loaded and is_summary(name, loaded):
        proposal.left[name] = "a summary of results by its name and size, not a test"
    elif loaded:
        found.tests += [(name, test, inspection, len(loaded) > 1) for test in loaded]
        if not any({*STRAINS} & set(test.quantities) for test in loaded):
            proposal.travel_only.add(name)
        if not any(_IN_STRAIN & set(test.quantities) for test in loaded):
            proposal.lengths_only.add(name)
    elif any(set(STRAINS) & set(test.quantities) for test in inspection.tests):
        found.strains.append(name)
    else:
        proposal.left[name] = inspection.obstacle()


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
    }
    for label, column in _DIMENSIONS.items():
        found = labels.get(label)
        if found is not None and found.value is not None:
            row[column] = f"{found.value:g}"
    columns = [column.name for column in test.quantities.values()]
    row |= {
        "test": proposed_test(name, [*head_lines(test), *columns]),
        "material": proposed_material(name),
    }
    rubber = row["test"].startswith("rubber")
    row["orientation_deg"] = "" if rubber else proposed_angle(name) or _angle_of(row["test"])
    row["remarks"] = _obstacle(test, inspection, labels)
    return row


def _angle_of(test: str) -> str:
    return _ANGLES.get(test, "")


def _obstacle(test: Test, inspection: Inspection, labels: Mapping[str, LabelValue]) -> str:
    """Say which unit is missing, and which strain."""
    told = [inspection.no_unit(test)]
    if not _has_strain_or_travel(test):
        told.append("no strain in this file")
    unread = [name for name, label in labels.items() if name in _DIMENSIONS and not label.value]
    told += [f"{name} in the head is '{labels[name].text}' without a known unit" for name in unread]
    return "; ".join(text for text in told if text)


def _remark(row: dict[str, str], proposal: Proposal) -> None:
    """Say what is a proposal and what is to be filled in."""
    proposed = [name for name in ("test", "material", "orientation_deg") if row.get(name)]
    wanted = proposal.open_in(row)
    travel = row["force_file"] in proposal.travel_only and not row.get("strain_file")
    travel = travel and row["test"] not in _BENDING and "gauge_length_mm" not in wanted
    parts = [
        f"proposed by words, to be checked: {', '.join(proposed)}" if proposed else "",
        f"fill in {', '.join(wanted)}" if wanted else "",
        "crosshead travel only: without gauge_length_mm no modulus, no strain" if travel else "",
        row["remarks"],
    ]
    row["remarks"] = "; ".join(part for part in parts if part)
