"""Fuzzing of the readers: mutated files are read correctly or refused, never silently misread.

    python benchmarks/ingest_fuzz.py [--inputs 12000] [--seed 1] [--labdata ../shared/labdata]

Each input is a real or example file with one to three mutations. What is read also goes through
pairing, conditioning and the checks of physics. The judge is a second, strict
parser of a few lines, which knows the layout of the file before it was mutated and shares no code
with the package but the table of units. What counts as a failure: any exception but InputError,
or a reading that differs from the judge's.
"""

from __future__ import annotations

import argparse
import csv
import math
import re
import tempfile
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nptcs.config.materials.ingest import IngestSettings
from nptcs.errors import InputError
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.ingest.reading.profiles import UNITLESS, FormatProfile
from nptcs.ingest.reading.raw_file import RawFile, read_raw
from nptcs.ingest.reading.units import DIMENSION, FACTORS
from nptcs.tables.laboratory.curves import Role
from nptcs.tables.laboratory.specimens import Specimen

ROOT = Path(__file__).resolve().parents[1]
ROWS = 60
"""Readings kept of each file; few, so that mutations interact."""
MISSING = {
    *("", "nan", "-nan", "nan(ind)", "-nan(ind)", "1.#qnan", "-1.#ind", "1.#inf", "-1.#inf"),
    *("inf", "-inf", "+inf", "null", "none", "n/a", "na", "n.a.", "k.a.", "n. def.", "n.def."),
    *("#n/a", "#nv", "#div/0!", "#value!", "#wert!", "#ref!", "#bezug!", "#name?", "#num!"),
    *("-", "--", "---", "–", "—", "*", "****", "/"),
}
TOKENS = (
    b"", b"nan", b"abc", b"1,234", b"1.234", b"--", b"1e5", b"-1000000", b"1e999", b'"', b"0x10",
    b"1 000", b"12 kN", b"1_0", b"\xb5", b"\xff\xfe", b"1.2.3", b"+5", b".5", b"5.", b"1E+02",
    b"inf",
)  # fmt: skip


@dataclass(frozen=True)
class Base:
    """A file, and what is known of it before it is mutated."""

    name: str
    content: bytes
    role: Role
    table: RawFile
    specimen: Specimen
    partner: Path | None = None

    @property
    def first(self) -> int:
        """Row of the first reading, from 0."""
        assert self.table.first_line is not None
        return self.table.first_line - 1


def lines_of(content: bytes) -> list[bytes]:
    """Lines, as the judge splits them."""
    return re.split(rb"\r\n|\n|\r", content)


def mutate(base: Base, random: np.random.Generator) -> bytes:
    """Mutate the table one to three times."""
    content = base.content
    start = len(b"\n".join(lines_of(content)[: base.first]))
    for _ in range(int(random.integers(1, 4))):
        mutation = MUTATIONS[int(random.integers(len(MUTATIONS)))]
        content = mutation(content, min(start, len(content) - 2), base, random)
        if len(content) < 10:
            break
    return content


def _position(content: bytes, start: int, random: np.random.Generator) -> int:
    return int(random.integers(start, max(len(content), start + 1)))


def replace_byte(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Replace one byte by any other."""
    at = _position(content, start, random)
    marks = b"0123456789.,;\t -+eE\"'\n\r" + bytes(random.integers(1, 256, 8).astype(np.uint8))
    return content[:at] + bytes([marks[int(random.integers(len(marks)))]]) + content[at + 1 :]


def delete_byte(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Delete one byte."""
    at = _position(content, start, random)
    return content[:at] + content[at + 1 :]


def insert_token(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Insert a token anywhere."""
    at = _position(content, start, random)
    return content[:at] + TOKENS[int(random.integers(len(TOKENS)))] + content[at:]


def replace_cell(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Replace a whole cell by a token."""
    lines = lines_of(content)
    if len(lines) <= base.first + 1:
        return content
    row = int(random.integers(base.first, len(lines)))
    mark = base.table.delimiter.encode() if base.table.delimiter != "spaces" else b" "
    cells = lines[row].split(mark)
    cells[int(random.integers(len(cells)))] = TOKENS[int(random.integers(len(TOKENS)))]
    lines[row] = mark.join(cells)
    return b"\n".join(lines)


def truncate(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Cut the file off."""
    return content[: _position(content, start, random)]


def move_line(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Delete, duplicate, or insert a line."""
    lines = lines_of(content)
    row = int(random.integers(min(base.first, len(lines) - 1), len(lines)))
    action = int(random.integers(4))
    if action == 0:
        del lines[row]
    elif action == 1:
        lines.insert(row, lines[row])
    elif action == 2:
        lines.insert(row, b"")
    else:
        lines.insert(row, b"Extensometer removed")
    return b"\n".join(lines)


def change_header(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Replace or delete a byte above the table."""
    if start < 2:
        return content
    at = int(random.integers(0, start))
    mark = b"" if random.integers(2) else bytes([int(random.integers(32, 127))])
    return content[:at] + mark + content[at + 1 :]


def add_header(content: bytes, start: int, base: Base, random: np.random.Generator) -> bytes:
    """Put lines above the file: nothing may change but the line numbers."""
    head = (b"Operator: X\r\n", b"\xef\xbb\xbf", b"Date,29.05.2024\r\n", b"\r\n\r\n")
    return head[int(random.integers(len(head)))] + content


MUTATIONS: tuple[Callable[[bytes, int, Base, np.random.Generator], bytes], ...] = (
    replace_byte,
    delete_byte,
    insert_token,
    replace_cell,
    truncate,
    move_line,
    change_header,
    add_header,
)


def judge(content: bytes, base: Base, table: RawFile) -> str | None:
    """Read the mutated file strictly, and say where the package's reading differs."""
    text = content.decode("latin-1")
    text = text.removeprefix("\xef\xbb\xbf")
    lines = re.split(r"\r\n|\n|\r", text)
    wanted = (table.first_line or 1) - 1
    names = cells_of(lines[(table.header_line or 1) - 1], table.delimiter)
    raw_names = [name.encode("latin-1") for name in names]
    positions = {}
    for quantity in table.values:
        position = position_of(table, quantity, raw_names, base)
        if position is None:
            return f"{quantity}: column '{table.columns[quantity]}' is not in the names {names}"
        positions[quantity] = position
    for quantity, position in positions.items():
        if not unit_is_stated(table, quantity, position, lines):
            return f"{quantity}: unit '{table.units[quantity]}' is not in the header"
    rows = strict_rows(lines[wanted:], table, positions)
    if isinstance(rows, str):
        return rows
    return compare(rows, table, positions)


def cells_of(line: str, delimiter: str) -> list[str]:
    """Cells without quotes."""
    if delimiter == "spaces":
        return line.split()
    row = next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    return [cell.strip() for cell in row]


def position_of(table: RawFile, quantity: str, names: list[bytes], base: Base) -> int | None:
    """Column of a quantity: where the name that the package reports is in the header."""
    reported = table.columns[quantity]
    for position, name in enumerate(names):
        for encoding in (table.encoding.replace(" (damaged)", ""), "cp1252", "utf-8"):
            text = name.decode(encoding, errors="replace")
            if same_name(text, reported):
                return position
    return None


def unit_is_stated(table: RawFile, quantity: str, position: int, lines: list[str]) -> bool:
    """Tell whether a unit is in the name or below it, or in the profile."""
    unit, declared = table.units[quantity], table.profile.units.get(quantity)  # type: ignore[call-overload]
    if not unit or unit == declared:
        return True
    first = (table.header_line or 1) - 1
    rows = (cells_of(line, table.delimiter) for line in lines[first : first + 3])
    cells = [row[position] for row in rows if position < len(row)]
    words = {word.casefold() for cell in cells for word in re.split(r"[\s\[\]()\"_,]+", cell)}
    stated = any(word for cell in cells[1:2] for word in re.findall(r"[A-Za-z%]+", cell))
    return unit.casefold() in words or (unit == "1" and not stated)


def same_name(text: str, reported: str) -> bool:
    """Equal except for bracketed parts, quotes, blanks, or what follows an underscore."""

    def bare(name: str) -> str:
        name = re.sub(r"\[[^\]]*\]|\([^)]*\)|（[^）]*）|<[^>]*>", "", name)
        return re.sub(r"[\s\"]", "", name)

    return bare(text) == bare(reported) or (
        bare(reported) != ""
        and re.fullmatch(re.escape(bare(reported)) + r"([_/,]|in).+", bare(text)) is not None
    )


def strict_rows(
    lines: list[str], table: RawFile, positions: Mapping[str, int]
) -> list[list[float]] | str:
    """Every reading of the needed columns, or a message about a row that is not a reading."""
    decimal = re.escape(table.decimal)
    number = re.compile(rf"[+-]?(\d+({decimal}\d*)?|{decimal}\d+)([eE][+-]?\d+)?", re.ASCII)
    grouped = grouped_numbers(table)
    thousands = " .,".replace(table.decimal, "")
    rows: list[list[float]] = []
    widths: list[int] = []
    for offset, line in enumerate(lines):
        cells = cells_of(line, table.delimiter)
        filled = [cell for cell in cells if cell]
        if not filled or (len(filled) == 1 and not number.fullmatch(filled[0])):
            continue
        values = []
        for position in positions.values():
            cell = cells[position] if position < len(cells) else ""
            if cell.casefold() in MISSING:
                values.append(math.nan)
            elif number.fullmatch(cell):
                values.append(float(cell.replace(table.decimal, ".")))
            elif grouped.fullmatch(cell):
                bare = re.sub(f"[{thousands}]", "", cell)
                values.append(float(bare.replace(table.decimal, ".")))
            elif offset > 5 and not any(number.fullmatch(one) for one in filled):
                return rows  # a new header: another table begins
            elif not any(line.strip() for line in lines[offset + 1 :]):
                return rows  # the last line is cut off
            else:
                return f"line {offset}: '{cell}' is not a number, and the package read on"
        rows.append(values)
        widths.append(len(cells))
    if len(widths) > 1 and widths[-1] < widths[-2]:
        rows.pop()  # the last line is cut off
    return rows


def grouped_numbers(table: RawFile) -> re.Pattern[str]:
    """Match a number with a thousands mark that the profile declares or the number proves.

    A number proves its mark if a decimal mark follows (`11,234.75`, `61 000.1`), or if the mark
    occurs twice (`1,234,567`): it cannot be the decimal mark then. `1,234` proves nothing.
    """
    declared, decimal = table.profile.thousands, re.escape(table.decimal)
    marks = declared or f"{'.' if table.decimal == ',' else ','} "
    forms = []
    for mark in marks:
        group = rf"{re.escape(mark)}\d{{3}}"
        if declared:
            forms.append(rf"({group})+({decimal}\d*)?")
        else:
            forms.append(rf"({group}){{2,}}({decimal}\d*)?|{group}{decimal}\d+")
    return re.compile(rf"[+-]?[1-9]\d{{0,2}}({'|'.join(forms)})", re.ASCII)


def compare(rows: list[list[float]], table: RawFile, positions: Mapping[str, int]) -> str | None:
    """Say where the readings differ; rows without any reading do not count."""
    expected = np.array([row for row in rows if not all(math.isnan(value) for value in row)])
    for index, name in enumerate(positions):
        counted = name in UNITLESS or not table.units[name]
        scale = 1.0 if counted else FACTORS[DIMENSION[name]][table.units[name]]
        ours, theirs = table.values[name], expected[:, index] * scale if len(expected) else expected
        if len(ours) != len(theirs):
            return f"{len(ours)} rows read, {len(theirs)} in the file"
        if not np.allclose(ours, theirs, rtol=1e-12, atol=0, equal_nan=True):
            row = int(np.argmax(~np.isclose(ours, theirs, rtol=1e-12, atol=0, equal_nan=True)))
            return f"{name}, row {row}: read {ours[row]!r}, in the file {theirs[row]!r}"
    return None


def _specimen(name: str, role: Role, partner: str) -> Specimen:
    """Make a specimen for a file; its size makes all moduli plausible."""
    rubber = name.startswith(("R", "Dragon"))
    return Specimen(
        specimen="S",
        test="rubber_tension" if rubber else "compression" if name.startswith("C") else "tension",
        material="m",
        orientation_deg=None if rubber else 0,
        width_mm=(12.0,),
        thickness_mm=(2.0,),
        gauge_length_mm=25.0,
        force_file=name if role != "strain" else partner,
        strain_file=partner if role == "force" else name if role == "strain" else "",
    )


def bases(profiles: Mapping[str, FormatProfile], labdata: Path | None) -> list[Base]:
    """Take example files of each format, and the real files that detection reads."""
    example = ROOT / "raw_data" / "example"
    files: list[tuple[Path, Role, str]] = [
        (example / "T90-1.csv", "force and strain", ""),
        (example / "R75-1.csv", "force and strain", ""),
        (example / "C90-1.TRA", "force and strain", ""),
        (example / "T0-1_wdw.txt", "force", "T0-1_vic3d.csv"),
        (example / "T0-1_vic3d.csv", "strain", "T0-1_wdw.txt"),
    ]
    if labdata is not None and labdata.is_dir():
        real = (
            "fraunhofer-steel/46NT9B.csv",
            "mts793-german/example4.csv",
            "silicone-d412/Dragon Skin 30.csv",
            "zwick-german/hbm-logger.csv",
        )
        files += [(labdata / name, "force and strain", "") for name in real]
    found = []
    for path, role, partner in files:
        table = read_raw(path, profiles, role=role)
        lines = lines_of(path.read_bytes())
        content = b"\n".join(lines[: (table.first_line or 1) + ROWS])
        specimen = _specimen(path.name, role, partner)
        other = example / partner if partner else None
        found.append(Base(path.name, content, role, table, specimen, other))
    return found


def fuzz(
    inputs: int, seed: int, labdata: Path | None, keep: Path | None = None
) -> tuple[Counter[str], list[str]]:
    """Run the inputs; return how many were read and refused, and every failure."""
    profiles = load_profiles(ROOT / "config" / "formats")
    random = np.random.default_rng(seed)
    outcome: Counter[str] = Counter()
    failures: list[str] = []
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("error")  # hides none: a warning of any library counts as a crash
        starts = bases(profiles, labdata)
        for number in range(inputs):
            base = starts[number % len(starts)]
            content = mutate(base, random)
            path = Path(folder) / base.name
            path.write_bytes(content)
            if base.partner is not None:
                (path.parent / base.partner.name).write_bytes(base.partner.read_bytes())
            result, message = one_input(path, content, base, profiles)
            outcome[result] += 1
            if result in ("crash", "wrong"):
                if keep is not None:
                    (keep / f"{number}_{base.name}").write_bytes(content)
                failures.append(f"input {number}, {base.name}: {message}")
    return outcome, failures


def one_input(
    path: Path, content: bytes, base: Base, profiles: Mapping[str, FormatProfile]
) -> tuple[str, str]:
    """``read``, ``refused``, ``crash`` or ``wrong``."""
    try:
        table = read_raw(path, profiles, role=base.role)
    except InputError as error:
        return ("refused", "") if str(error) else ("crash", "empty message")
    except Exception:  # noqa: BLE001  (what the fuzz looks for)
        return "crash", traceback.format_exc(limit=-3)
    difference = judge(content, base, table)
    if difference:
        return "wrong", difference
    try:
        curve = ingest_specimen(base.specimen, path.parent, IngestSettings(), profiles).curve
    except InputError as error:
        return ("read, specimen refused", "") if str(error) else ("crash", "empty message")
    except Exception:  # noqa: BLE001  (what the fuzz looks for)
        return "crash", traceback.format_exc(limit=-3)
    if not np.isfinite(curve[["force_n", "stress_mpa"]]).all(axis=None) or len(curve) < 5:
        return "wrong", "the curve contains readings without force"
    return "read and ingested", ""


def main() -> int:
    """Run and report; 1 if anything failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=12_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--labdata", type=Path, default=ROOT.parent / "shared" / "labdata")
    parser.add_argument("--keep", type=Path, help="folder for the inputs that failed")
    arguments = parser.parse_args()
    outcome, failures = fuzz(arguments.inputs, arguments.seed, arguments.labdata, arguments.keep)
    print(", ".join(f"{count} {name}" for name, count in sorted(outcome.items())))
    for failure in failures[:20]:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    raise SystemExit(main())
