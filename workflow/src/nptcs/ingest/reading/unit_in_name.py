"""A column's name and the unit that is written in it."""

from __future__ import annotations

import re
from functools import lru_cache

from nptcs.ingest.reading.units import BRACKETS, clean_unit, find_unit, is_unit

_TAIL = re.compile(r"^(.*[^\s/,])(?:\s*/\s*|\s+in\s+|\s+[-–—:]\s+|,\s*|_|\.)(\S+)$")
_WORD_BEHIND = re.compile(r"^(.*[^\s,])\s+(\S+)$")
_OF_STRAIN = r"(?:strain|eps(?:ilon)?|dehnung|ひずみ|歪み?|应变|應變)"
_OF_LOAD = r"(?:force|load|kraft|last|charge|carga|carico|荷重|荷载|载荷|负荷|试验力|試験力)"
_WHOLE, _WITH_STRAIN = r"\g<name>", r"\g<name> strain\g<behind>"
_UNIT_IN_WORDS = (
    (r"(?:%|percent(?:age)?|pct\.?)[ _]+(?P<name>\D.*)", "%", _WHOLE),
    (rf"(?P<name>.*{_OF_STRAIN})[ _-]?percent(?:age)?", "%", _WHOLE),
    (r"(?P<name>.*?)micro[ _-]?strains?(?P<behind>[ _-]?\d*)", "microstrain", _WITH_STRAIN),
    (r"(?P<name>|.*[ _-])[uµμ][ _-]?strains?(?P<behind>[ _-]?\d*)", "microstrain", _WITH_STRAIN),
    (r"(?P<name>.*?)milli[ _-]?strains?(?P<behind>[ _-]?\d*)", "millistrain", _WITH_STRAIN),
    (rf"(?P<name>.*{_OF_STRAIN})[ _-]?(?:micro|[\[(（][uµμ][\])）])", "microstrain", _WHOLE),
    (rf"(?P<name>.*{_OF_STRAIN})[ _-]?milli", "millistrain", _WHOLE),
    (rf"(?P<name>.*{_OF_LOAD})kn", "kN", _WHOLE),
    (rf"(?P<name>.*{_OF_LOAD})\s*[\[(（](?-i:t)[\])）]", "tonne", _WHOLE),
    (rf"(?P<name>.*{_OF_LOAD})\s*[\[(（](?-i:T)[\])）]", "ton", _WHOLE),
)
"""Names that say their unit in words, the unit, and the name without it: ``Percentage Strain``,
``StrainMicro``, ``Load (t)``; a `t` or `µ` alone is a unit only after such a name."""
_PATTERNS = tuple(
    (re.compile(f"(?i)^{words}$"), unit, rest) for words, unit, rest in _UNIT_IN_WORDS
)
_UNCLOSED = re.compile(r"^([^\[(（]+)[\[(（]([^\])）]+)$")
"""A name whose end was cut off: ``Kraft [kN``."""
_WRITTEN_TOGETHER = re.compile(r"(?<=[a-z])(?=(?:[A-Z][a-z]*|KN|MPa|GPa)$)")
NO_UNIT = frozenset(["-", "1", "strain", "abs", "pound", "d", "g", "me", "e-6", "e-3"])
"""Units that are part of a name when they follow it, unless in brackets."""
_WORDS = frozenset(["k", "v", "j", "h", "m", "min", "in", "minutes"])
"""The same for a word or letter after a blank: ``Force min``, ``Load in``."""
_CAPACITY = re.compile(r"\s(?P<number>\d+(?:\.\d+)?)$")
_SMALLEST_CELL = 5.0
"""A smaller number before a unit of force is that of a channel: ``Load 2 N``."""
_FACTOR = re.compile(
    r"[x×*·] ?(?:10+|1?e[+-]?\d+)(?![\d.])(?: ?\^ ?[+-]?\d+)?|\b10+ ?[x×*·]"
    r"|(?<=[^\W\d_])\)? ?/ ?10+\b|\bhalf\b|\bper (?:side|leg)\b|\bhalbe"
)


@lru_cache(maxsize=4096)
def split_unit(name: str) -> tuple[str, str | None]:
    """Split ``Force [kN]``, ``Kraft / kN``, ``F/N``, ``force_n``, ``Load N`` into name and unit.

    Returns
    -------
    name : str
        The name without its unit.
    unit : str or None
        None if the name carries no unit. The capacity of a load cell (``Load Cell 100 kN``) is not
        one.
    """
    for match in BRACKETS.finditer(name):
        inner = clean_unit(match.group(0))
        if is_unit(inner) or (match.group(1) and not inner.isdigit()):
            rest = f"{name[: match.start()].rstrip()} {name[match.end() :].lstrip()}".strip()
            return rest, inner
    for pattern, unit, rest in _PATTERNS:
        if found := pattern.match(name.strip()):
            return " ".join(found.expand(rest).strip(" _-").split()), unit
    if is_unit(name) and not name.strip().isalpha():
        return name.strip(), None
    if (unclosed := _UNCLOSED.match(name.strip())) and is_unit(unclosed.group(2)):
        return unclosed.group(1).strip(), clean_unit(unclosed.group(2))
    ways = [(_TAIL, NO_UNIT), (_WORD_BEHIND, NO_UNIT | _WORDS)]
    if "/" in name.strip().rpartition(" ")[2]:
        ways.reverse()  # 'Strain 1 mm/mm' ends with one unit, not with two
    for pattern, words in ways:
        tail = pattern.match(name.strip())
        if tail and is_unit(tail.group(2)) and tail.group(2).casefold() not in words:
            own = None if _is_capacity(*tail.groups()) else clean_unit(tail.group(2))
            return tail.group(1), own
    if _WRITTEN_TOGETHER.search(name):
        apart = split_unit(_WRITTEN_TOGETHER.sub("_", name))  # ForceKN, StrainPct
        # 'LoadkN' may be in kN: the letter before a unit must not make it another one
        longer = apart[1] and is_unit(f"{apart[0][-1:]}{apart[1]}")
        return apart if apart[1] and not longer else (name.strip(), None)
    return name.strip(), None


def _is_capacity(name: str, unit: str) -> bool:
    """Tell whether number and unit at the end of a name are the capacity of a load cell."""
    number = _CAPACITY.search(name)
    large = number is not None and float(number["number"]) >= _SMALLEST_CELL
    return large and find_unit("force", unit) is not None


def factor_in_name(name: str) -> str:
    """Return the part of a column's name that scales its readings: ``Load x10``; else empty."""
    found = _FACTOR.search(name.casefold())
    return found.group(0).strip() if found else ""
