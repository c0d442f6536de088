"""Format profiles: what a vendor's export looks like, declared in YAML, one file each."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from fnmatch import fnmatchcase
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, ValidationError, model_validator

from nptcs.config.base import Strict
from nptcs.errors import InputError
from nptcs.ingest.reading.units import DIMENSION, FACTORS, find_unit
from nptcs.yaml_files import read_yaml

Quantity = Literal[
    "time",
    "force",
    "stress",
    "displacement",
    "extension",
    "extension_transverse",
    "strain",
    "strain_transverse",
    "strain_back",
    "strain_xx",
    "strain_yy",
    "stretch",
    "frame",
    "trigger",
    "x",
    "y",
]
UNITLESS: tuple[Quantity, ...] = ("frame", "trigger", "x", "y")
"""Numbers of frames, trigger levels and places in a picture: taken as they are."""
COUNTERS: tuple[Quantity, ...] = ("frame", "trigger")
"""Any machine may record these under the names of `PLAIN`."""
ContentKind = Literal["text", "workbook"]
"""Lines whose dialect is to be found, or sheets of native cells (also of TDMS and MAT files)."""
Label = Literal["width", "thickness", "area", "gauge_length", "specimen"]
StrainSource = Literal["extensometer", "dic", "strain_gauge", "crosshead", "unspecified"]
DELIMITERS = {",": ",", ";": ";", "tab": "\t", "|": "|", "spaces": "spaces"}
PLAIN = "plain"


class FormatProfile(Strict):
    """One export format. What is left out is detected, and detection explains itself."""

    name: str = Field(pattern=r"^[a-z0-9][a-z0-9-]*$", description="As in the specimen sheet")
    title: str = Field(description="Machine, program, language")
    signature: tuple[str, ...] = Field(
        (), description="Regular expressions that all must occur in the head of such a file"
    )
    kind: ContentKind = Field("text", description="text or workbook (XLSX, XLS)")
    encoding: str = Field("", description="E.g. cp1252, gb18030; empty: detect")
    delimiter: Literal["", ",", ";", "tab", "|", "spaces"] = Field("", description="empty: detect")
    decimal: Literal["", ".", ","] = Field("", description="Decimal mark; empty: detect")
    decimal_in_head: str = Field(
        "", description="Regular expression whose group 1 is the decimal mark in the file's head"
    )
    thousands: Literal["", ".", ",", " ", "'"] = Field(
        "", description="Thousands mark; counts only with a declared decimal mark"
    )
    columns: dict[Quantity, tuple[str, ...]] = Field(
        default_factory=dict,
        description="Quantity → column names, first match wins; case, blanks and unit do not "
        "count, * stands for anything",
    )
    columns_in_order: tuple[Quantity | Literal["-"], ...] = Field(
        (), description="For tables without names: the quantity of each column, '-' to skip it"
    )
    units: dict[Quantity, str] = Field(
        default_factory=dict, description="Units where the file states none"
    )
    wrong_units: dict[Quantity, str] = Field(
        default_factory=dict, description="Units that replace what the file states wrongly"
    )
    part: str = Field("", description="Workbook sheet or table number, if always the same")
    unnamed_columns: Literal["", "first", "last"] = Field(
        "", description="Where the surplus columns are if there are fewer names than columns"
    )
    missing: tuple[str, ...] = Field((), description="Further words for 'no value'")
    strain_source: StrainSource = Field("unspecified", description="What measures the strain")
    loading: Literal["", "tension", "compression", "flexure"] = Field(
        "", description="Loading of the tests in such files; empty: by the words in the file"
    )
    window: dict[Literal["x", "y"], tuple[float, float]] = Field(
        default_factory=dict,
        description="Part of a strain field, in its own coordinates, over which the mean is taken; "
        "empty: all of it",
    )
    labels: dict[Label, tuple[str, ...]] = Field(
        default_factory=dict, description="Header keys of dimensions and specimen id"
    )

    @model_validator(mode="after")
    def _coherent(self) -> Self:
        for pattern in (*self.signature, self.decimal_in_head):
            try:
                re.compile(pattern)
            except re.error as error:
                raise ValueError(f"expression {pattern!r}: {error}") from error
        for quantity, unit in [*self.units.items(), *self.wrong_units.items()]:
            if find_unit(DIMENSION[quantity], unit) is None:
                choices = ", ".join(FACTORS[DIMENSION[quantity]])
                raise ValueError(f"{unit!r} is not a unit of {quantity}; use one of {choices}")
        if self.thousands and (not self.decimal or self.thousands == self.decimal):
            raise ValueError("a thousands mark needs a declared, different decimal mark")
        if self.delimiter and self.delimiter == self.decimal:
            raise ValueError("delimiter and decimal mark are the same")
        return self

    @cached_property
    def words(self) -> frozenset[str]:
        """Names of columns and labels, without the ``*`` that stands for anything."""
        names = (*self.columns.values(), *self.labels.values())
        return frozenset(name.strip("*") for several in names for name in several)

    def for_head(self, head: str) -> FormatProfile:
        """Return the profile with the decimal mark that a file's head states."""
        found = re.search(self.decimal_in_head, head) if self.decimal_in_head else None
        return self.model_copy(update={"decimal": found.group(1)}) if found else self

    def matches(self, head: str) -> bool:
        """Tell whether every expression of the signature occurs in `head`."""
        return bool(self.signature) and all(
            re.search(pattern, head, re.MULTILINE) for pattern in self.signature
        )


@lru_cache(maxsize=16384)
def normalise(name: str) -> str:
    """Write a column name as names are compared: without case, accents and wide forms."""
    if not name.isascii():
        wide = unicodedata.normalize("NFKD", name)
        name = "".join(mark for mark in wide if not unicodedata.combining(mark))
    return re.sub(r"[\s_]+", " ", name.replace('"', " ")).strip().strip(":").strip().casefold()


_PREFIXES = re.compile(
    r"^(?:(?:c|ch|chan|channel|kanal|canal|voie|ai|ad|analog|analog in|sensor|signal)"
    r"[ .:-]*\d*[ .:-]+|\d+[ .:-]+|mx\d\w* (?:ch\d+ )?|(?:c?daq|dev)\w*/\w+ "
    r"|(?:primary|universal|main|station|machine|axial|"
    r"mts|instron|zwick|measured|actual) )+"
)
_SUFFIXES = re.compile(
    r"(?:[ .:-]+(?:filtered|filt|unfiltered|raw|signal|channel|value|wert|istwert|measured|"
    r"actual|gefiltert|filtre|filtrado|filtrato|1)|[ ]*\((?:filtered|raw)\)|(?<=[^\W\d_])1)+$"
)


@lru_cache(maxsize=4096)
def without_channel(name: str) -> str:
    """Take a channel's prefix and suffix off a name: ``C_1_Force``, ``Ch Disp.``, ``Load_Raw``."""
    short = _SUFFIXES.sub("", _PREFIXES.sub("", normalise(name)))
    return short.strip(" .:-") or normalise(name)


_QUALIFIERS = (
    "engineering eng nominal axial longitudinal long lengthwise längs laengs axiale axialer "
    "assiale longitudinale optical optisch optique video laser noncontact non contact "
    "corrected corr compensated korrigiert filtered filt smoothed smooth raw gefiltert "
    "measured actual average averaged avg mean mittlere tensile tension traction trazione "
    "tração tracción zug compressive compression flexure flexural bending total sensor "
    "channel signal value calculated calc computed current specimen sample standard of the a "
    "en por de di da in продольная осевая средняя 軸 平均"
)
"""Words of a name that say how a quantity was measured, not which it is."""


@lru_cache(maxsize=4096)
def core_name(name: str) -> str:
    """Take the words off a name that say how it was measured: ``Corrected strain (laser)``.

    Words that make it another quantity (true, transverse, plastic, maximum) stay.
    """
    words = re.findall(r"[^\W\d_]+", normalise(name))
    return " ".join(dict.fromkeys(word for word in words if word not in _QUALIFIERS_FOLDED))


@lru_cache(maxsize=65536)
def name_matches(name: str, pattern: str) -> bool:
    """Tell whether a column name (without its unit) is what a profile calls it."""
    return fnmatchcase(_normalised(name), _normalised(pattern))


_normalised = lru_cache(maxsize=4096)(normalise)
_QUALIFIERS_FOLDED = frozenset(normalise(_QUALIFIERS).split())


def read_profile(path: str | Path) -> FormatProfile:
    """Read one profile; raise InputError with the key at fault."""
    path = Path(path)
    content = read_yaml(path)
    if not isinstance(content, dict):
        raise InputError("is not a profile", "write 'key: value' lines", path)
    try:
        return FormatProfile(**content)
    except (ValidationError, TypeError) as error:
        raise _profile_error(path, error) from error


def _profile_error(path: Path, error: ValidationError | TypeError) -> InputError:
    if isinstance(error, TypeError):
        return InputError("keys must be words", "quote the keys", path)
    problem = error.errors()[0]
    key = ".".join(str(part) for part in problem["loc"])
    keys = ", ".join(FormatProfile.model_fields)
    return InputError(problem["msg"], f"keys of a profile: {keys}", path, column=key or None)


def load_profiles(folder: str | Path) -> dict[str, FormatProfile]:
    """Read every ``*.yaml`` of a folder.

    Returns
    -------
    dict of str to FormatProfile
        By name, in alphabetical order.

    Raises
    ------
    InputError
        If a profile is not valid or not named like its file, or there is no profile `PLAIN`.
    """
    folder = Path(folder)
    profiles: dict[str, FormatProfile] = {}
    for path in sorted(folder.glob("*.yaml")):
        profile = read_profile(path)
        if profile.name != path.stem:
            raise InputError(
                "name and file name differ", f"call it {path.stem}", path, column="name"
            )
        profiles[profile.name] = profile
    if PLAIN not in profiles:
        raise InputError(f"no profile '{PLAIN}.yaml'", "restore it, detection needs it", folder)
    return {name: _with_counters(one, profiles[PLAIN]) for name, one in profiles.items()}


def _with_counters(profile: FormatProfile, plain: FormatProfile) -> FormatProfile:
    """Give a profile the names of frame counter and trigger, which any machine may record."""
    names = {name: plain.columns[name] for name in COUNTERS if name in plain.columns}
    return profile.model_copy(update={"columns": {**names, **profile.columns}})


def choose(name: str, profiles: Mapping[str, FormatProfile], specimen: str) -> FormatProfile:
    """Return the profile that the sheet names.

    Raises
    ------
    InputError
        If there is no profile of that name.
    """
    if name not in profiles:
        raise InputError(
            "unknown format",
            "use one of " + ", ".join(profiles) + ", or leave it empty to detect",
            specimen=specimen,
            value=name,
        )
    return profiles[name]
