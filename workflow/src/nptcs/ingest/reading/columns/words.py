"""Columns by a word in their name and by their unit, where no profile knows the whole name."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from nptcs.ingest.reading.profiles import Quantity, normalise
from nptcs.ingest.reading.table_columns import Column
from nptcs.ingest.reading.units import DIMENSION, find_unit

NO_READING = re.compile(
    r"\b(?:f ?max|max|maximum|maxi|peak|min|minimum|std|stdev|s\.?d|deviation|rate|speed|command"
    r"|cmd|set ?point|soll|sollwert|target|error|limit|preload|vorkraft|true|wahre?|vraie?|log"
    r"|logarithmic|hencky|plastic|plastisch|elastic|energy|work|modulus|at|bei|break|bruch|rupture"
    r"|ultimate|yield|confidence|uncertainty)\b|最大|最小|真应|真ひ|真歪|断裂|屈服"
)
"""Words of columns that are not readings taken during the test, or are of another quantity."""
ACROSS = re.compile(
    r"transv|trans\b|lateral|\blat\b|quer(?!schnitt)|breiten|trasvers|poprzecz|попереч|pricn(?!ik)|横向|横"
    r"ひずみ|幅|宽度|\bwidth\b|\b(?:sg|dms|e|eps|ε) ?(?:t|q|lat|90)\b"
)
_BACK = re.compile(r"\bback\b|\brear\b|hinten|ruck|\bdos\b|背")
_STRAIN = (
    r"strain|dehnung|deform|elong|dms|\bga[u]?ge|jauge|galga|extensom|odkszt|деформац|удлин|应变"
    r"|應變|歪|ひずみ|변형|ekstens|estens|t[øö][jy]ning|venym|nyulas|gerinim|birim (?:uzama|sekil)"
    r"|şekil deg|sekil deg|\brek\b|prutahom|extenzom|ekstansom|신율|신장률|\bsg|\beps|ε|\bdl/l0\b"
)
_SENSOR = (
    r"extensom|estens(?:im|om|\.|\b)|ekstens|экстенз|тензом|feindehn|ansetz|aufnehmer|\bclip\b|引伸"
    r"|变形|變形|変形|伸び計|伸び計|신율계|신장계|prutahom|extenzom"
    r"|ekstansom|nyulasmer|töjningsgiv|virtual|video|laser|primary ext|axial ext"
    r"|\bga[u]?ge (?:disp|ext)|\bextn?\b|\bextens?\b"
    r"|^(?:e ?\d\d?|ext ?\d\d?|le|cod|ave ?\d?)(?= \|)"
)
_SHORT_STRAIN = r"^e ?\d{0,2}(?= \|)|\bext(?:n|ens|ension)?\b"
"""Short names that are a strain only in a unit of strain: ``E1 (%)``, ``Extension-1 (%)``."""
_OVER_LENGTH = r"\((?:extension|displacement|crosshead|stroke|position)\)"
"""After a strain: it is travel over a length."""


@dataclass(frozen=True)
class _Rule:
    """A quantity, the words that identify it, and the words that identify another."""

    quantity: Quantity
    words: re.Pattern[str]
    others: re.Pattern[str] = re.compile(r"(?!)")


_OTHER_FACE = re.compile(f"{ACROSS.pattern}|{_BACK.pattern}")
_IN_PLANE = r"(?:^|[^a-z])(?:e|eps|epsilon|strain|ε)[ ._-]?"
_RULES = (
    _Rule(
        "force",
        re.compile(
            r"force|load|kraft|charge|effort|carga|fuerza|carico|forza|forca|sila|siła|obciaz"
            r"|zatiz|усили|нагруз|сила|力|荷|하중|kuvvet|yuk\b|kracht|belasting|voima|kuorm|belastning|ero\b|terheles|messdose|dynamom"
        ),
    ),
    _Rule(
        "stress",
        re.compile(
            r"stress|spannung|contrainte|esfuerzo|tension|tensao|tensione|naprez|napeti|напряж"
            r"|应力|應力|応力|응력|σ"
        ),
    ),
    _Rule("strain_xx", re.compile(rf"{_IN_PLANE}(?:xx|x)\b")),
    _Rule("strain_yy", re.compile(rf"{_IN_PLANE}(?:yy|y)\b")),
    _Rule("strain", re.compile(_STRAIN), re.compile(f"{_OTHER_FACE.pattern}|{_OVER_LENGTH}")),
    _Rule("strain", re.compile(_SHORT_STRAIN), re.compile(f"{_OTHER_FACE.pattern}|{_OVER_LENGTH}")),
    _Rule("strain_transverse", ACROSS),
    _Rule("extension", re.compile(_SENSOR), _OTHER_FACE),
    _Rule("extension_transverse", ACROSS),
    _Rule(
        "displacement",
        re.compile(
            r"displ|travel|\bpos\b|verform|deform|\bdl\b|delta l\b"
            r"|cross ?head|stroke|position|weg\b|hub\b|travers|piston|kolben|actuator"
            r"|\bram\b|lvdt|distance|extension|elong|allung|alarg|deplac|spostam|corsa|course"
            r"|carrera|desplaz|desloc|curso|posuv|перемещ|ход|位移|変位|ストローク|行程|변위|스트로크|横梁|uzama|pricnik|verplaats|slag\b|f[øö]rskj|forskyv"
            r"|siirtym|elmozdul|przemieszcz"
        ),
        re.compile(f"{ACROSS.pattern}|{_SENSOR}"),
    ),
    _Rule(
        "time",
        re.compile(
            r"time|zeit|temps|tiempo|tempo|czas|cas\b|время|时间|時間|時刻|시간|zaman|tijd|\btid\b|aika|\bido\b"
        ),
    ),
)
_IN_PLANE_PAIR = {"strain", "extension", "strain_transverse", "extension_transverse"}
_INSTEAD: dict[str, set[str]] = {
    "strain_xx": _IN_PLANE_PAIR,
    "strain_yy": _IN_PLANE_PAIR,
    "strain": {"extension"},
    "strain_transverse": {"extension_transverse"},
}
"""Quantities that are not wanted any more once another one is found."""
_BY_UNIT_ALONE: tuple[Quantity, ...] = ("force", "strain", "time")
_NO_TELLING_UNIT = frozenset(["%", "1", "-", "m/m", "in/in"])
"""Units in which many quantities other than strain are written."""


def map_by_words(
    mapped: dict[str, Column], wanted: set[str], columns: Sequence[Column]
) -> list[str]:
    """Add quantities of `wanted` whose column a word in its name and its unit identify.

    The unit must be stated and be one of the quantity. If no name contains a word, the only column
    with a unit of force, of time, or of no other quantity than strain is taken. Where several
    columns fit, none is taken.

    Parameters
    ----------
    mapped : dict of str to Column
        Quantity → column; is added to.
    wanted : set of str
        Quantities that may be added.
    columns : sequence of Column
        Of the test.

    Returns
    -------
    list of str
        A note for each column that was read this way.
    """
    notes, wanted = [], set(wanted)
    for rule in _RULES:
        free = [c for c in columns if not any(c is taken for taken in mapped.values())]
        if rule.quantity not in wanted or rule.quantity in mapped:
            continue
        if found := _fitting(rule, free):
            mapped[rule.quantity] = found
            wanted -= _INSTEAD.get(rule.quantity, set())
            notes.append(f"column '{found.name}' in {found.unit} is read as {rule.quantity}")
    return notes


def _fitting(rule: _Rule, columns: Sequence[Column]) -> Column | None:
    """Return the one column that fits a rule; None if none does, or several."""
    possible = [
        column
        for column in columns
        if _in_unit(column, rule.quantity)
        and is_reading(column)
        and not rule.others.search(_full(column))
    ]
    named = [column for column in possible if rule.words.search(_full(column))]
    if not named and rule.quantity in _BY_UNIT_ALONE:
        named = possible
        if rule.quantity == "strain":
            named = [c for c in named if c.unit not in _NO_TELLING_UNIT]
    return named[0] if len(named) == 1 else None


_NUMBER_BEHIND = re.compile(r"(?<=[^\W\d_])(?=\d)")


def _full(column: Column) -> str:
    """Name with the label above it (names may take two rows), in three ways of writing.

    Without accents, with them, and with a number at the end of a word apart (``Estens1``).
    """
    name = f"{column.group} {column.name}"
    apart = _NUMBER_BEHIND.sub(" ", normalise(name))
    return f"{normalise(name)} | {name.casefold()} | {apart}"


def _in_unit(column: Column, quantity: Quantity) -> bool:
    return bool(column.unit) and find_unit(DIMENSION[quantity], str(column.unit)) is not None


def is_reading(column: Column) -> bool:
    """Tell whether a column is not a largest value, a setpoint, a scatter or the like."""
    return not NO_READING.search(_full(column))


def may_be(kind: Literal["load", "strain"], column: Column) -> bool:
    """Tell whether a column that no profile knows is probably a load, or a strain.

    A word in its name suggests it; for a strain also its unit: one of strain or of length.
    """
    if not is_reading(column) or column.clock:
        return False
    wanted = ("force", "stress") if kind == "load" else ("strain", "extension", "displacement")
    rules = [rule for rule in _RULES if rule.quantity in wanted]
    units = () if kind == "load" else ("strain", "length")
    in_unit = any(column.unit and find_unit(unit, column.unit) for unit in units)
    return in_unit or any(rule.words.search(_full(column)) for rule in rules)


_TRAVEL_WORDS = re.compile(
    r"displ|travel|travers|cross ?head|stroke|position|\bpos\b|weg\b|piston|kolben|actuator|course"
    r"|corsa|carrera|desloc|curso|ход|перемещ|位移|変位|ストローク|行程|横梁"
)


def may_be_gauge(column: Column) -> bool:
    """Tell whether a column that was not read may be what a gauge on the specimen measured.

    It is in a unit of strain or length, and its name is not that of a travel.
    """
    in_unit = any(column.unit and find_unit(unit, column.unit) for unit in ("strain", "length"))
    full = _full(column)
    across = ACROSS.search(full) or _TRAVEL_WORDS.search(full)
    return in_unit and is_reading(column) and not column.clock and not across
