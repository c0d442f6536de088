"""What a file calls its own test, against what the sheet says it is."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Literal, assert_never

from nptcs.errors import InputError
from nptcs.ingest.conditioning.signals import Signals
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.tables.laboratory.specimens import Specimen, TestType

NamedLoading = Literal["tension", "compression", "flexure"]
WORDS: dict[NamedLoading, re.Pattern[str]] = {
    "tension": re.compile(
        r"(?i)\btens(ile|ion)|\bzug(versuch|prüf|spann|kraft|dehn)|\btraction|\btracci[oó]n"
        r"|\btrazione|\btraç[aã]o|rozciąg|\btah(u|em|ov)|растяж|引張|拉伸|인장"
        r"|\bçekme|\btrekproef|\bdragprov|\bhúzó|\bvetokoe"
        r"|\bD ?(3039|638|412|3518)\b|\bISO ?(527|37|14129)\b"
    ),
    "compression": re.compile(
        r"(?i)\bcompressi|\bcompress[aã]o|\bcompresi[oó]n|\bdruck(versuch|prüf|spann|kraft|belast)"
        r"|\bstauch|ściskan|\btlak(u|em|ov)|сжати|圧縮|压缩|壓縮|압축"
        r"|\bbasma|\bdrukproef|\btryckprov|\bnyomó|\bD ?(695|6641|3410|575)\b"
        r"|\bISO ?(604|14126|7743)\b"
    ),
    "flexure": re.compile(
        r"(?i)\bflexur|\bflexion|\bflexi[oó]n|\bflex[aã]o|\bflessione|\bbiege|\bbending\b"
        r"|\b(3|4|three|four)[- ]?point|\bzginan|\bohyb|изгиб|曲げ|弯曲|彎曲|굽힘|굴곡"
        r"|\beğ(il)?me|\bbuigproef|\bböjprov|\bhajlító|\bD ?(790|7264)\b"
        r"|\bISO ?(178|14125)\b"
    ),
}
"""Words and standards by which files name the loading, in the languages of the profiles."""
_ABOUT_THE_TEST = re.compile(
    r"(?i)test|method|type|procedure|norm|standard|prüf|versuch|essai|méthode|ensayo|método|prova"
    r"|metodo|prueba|zkouš|badani|испыт|試験|试验|試驗|方法|시험|deney|proef|prov\b|provning|vizsg"
)


def loadings_named(texts: Iterable[str]) -> set[NamedLoading]:
    """Collect the loadings that some texts name."""
    return {loading for text in texts for loading, words in WORDS.items() if words.search(text)}


_IN_NAMES: dict[NamedLoading, re.Pattern[str]] = {
    "tension": re.compile(r"(?i)\bzug\b|\bzugprobe|\btens\b|\btracc?\b"),
    "compression": re.compile(r"(?i)\bdruck\b|\bdruckprobe|\bcomp\b|\bclc\b"),
    "flexure": re.compile(r"(?i)\bbiegung|\bbend\b|\b[34]pb\b|\bflex\b"),
}
"""Words that name the loading in a file's name, but may mean something else in a text."""


def loadings_in_name(path: str) -> set[NamedLoading]:
    """Collect the loadings that the names of a file and its folders mention."""
    words = re.sub(r"[_/.-]", " ", path)
    short = {loading for loading, pattern in _IN_NAMES.items() if pattern.search(words)}
    return loadings_named([path.replace("_", " ")]) | short


def loading_of(test: TestType) -> NamedLoading:
    """Return the loading of a test of the sheet: ±45° shear is a tension test."""
    match test:
        case TestType.COMPRESSION | TestType.RUBBER_COMPRESSION:
            return "compression"
        case TestType.FLEXURE:
            return "flexure"
        case (
            TestType.TENSION
            | TestType.SHEAR
            | TestType.RUBBER_TENSION
            | TestType.RUBBER_EQUIBIAXIAL
            | TestType.RUBBER_PURE_SHEAR
        ):
            return "tension"
        case _:
            assert_never(test)


def require_declared_test(signals: Signals, specimen: Specimen, table: RawFile, name: str) -> None:
    """Stop if a file calls itself compression or flexure and the sheet says another loading.

    The column names count, and the lines of the head that mention a test, method or standard; a
    loading that the profile states replaces both. A file or folder name that disagrees is only
    flagged.

    Raises
    ------
    InputError
        With the words that were found.
    """
    stated = loading_of(specimen.test)
    for where, texts in (
        ("columns", table.names),
        ("head", tuple(line for line in table.head if _ABOUT_THE_TEST.search(line))),
    ):
        named = {table.profile.loading} if table.profile.loading else loadings_named(texts)
        if not named or stated in named:
            continue
        own = " and ".join(sorted(named))
        if named == {"tension"}:
            signals.flags.append(f"{table.path.name} calls itself {own} ({where})")
            continue
        words = next((text for text in texts if loadings_named([text])), table.profile.name)
        raise InputError(
            f"the file calls itself {own} ({where}: '{words[:60]}'), the sheet says "
            f"{specimen.test}",
            "correct test in the sheet, or state the loading in a profile ('loading')",
            table.path,
            specimen=specimen.specimen,
        )
    in_name = loadings_in_name(name)
    if in_name and stated not in in_name and not table.profile.loading:
        signals.flags.append(
            f"the name '{name}' says {' and '.join(sorted(in_name))}, the sheet says {stated}"
        )
