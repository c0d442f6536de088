"""Units as machines write them, and the factor to s, N, mm, MPa and dimensionless strain."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

_INCH = 25.4
_POUND = 4.4482216152605
_PSI = _POUND / _INCH**2

FACTORS: dict[str, dict[str, float]] = {
    "time": {
        "s": 1,
        "sec": 1,
        "sec.": 1,
        "seconds": 1,
        "ms": 1e-3,
        "µs": 1e-6,
        "min": 60,
        "h": 3600,
        "秒": 1,
        "с": 1,
        "с.": 1,
        "сек": 1,
        "сек.": 1,
        "мс": 1e-3,
        "мин": 60,
        "ч": 3600,
        "hr": 3600,
        "hours": 3600,
        "毫秒": 1e-3,
        "分": 60,
        "seg": 1,
        "seg.": 1,
        "secs": 1,
        "second": 1,
        "sekunden": 1,
        "msec": 1e-3,
        "sek": 1,
        "sek.": 1,
        "segundos": 1,
        "secondes": 1,
        "secondi": 1,
        "millisecond": 1e-3,
        "milliseconds": 1e-3,
        "minutes": 60,
        "sn": 1,
        "초": 1,
    },
    "force": {
        "N": 1,
        "kN": 1e3,
        "MN": 1e6,
        "mN": 1e-3,
        "daN": 10,
        "cN": 1e-2,
        "lbf": _POUND,
        "lb": _POUND,
        "lbs": _POUND,
        "lb-f": _POUND,
        "pound": _POUND,
        "pounds": _POUND,
        "kips": 1e3 * _POUND,
        "klbf": 1e3 * _POUND,
        "kip": 1e3 * _POUND,
        "kgf": 9.80665,
        "g": 9.80665e-3,
        "kNewton": 1e3,
        "lb-force": _POUND,
        "lbsf": _POUND,
        "klb": 1e3 * _POUND,
        "ozf": _POUND / 16,
        "kg-f": 9.80665,
        "newton": 1,
        "newtons": 1,
        "kilonewton": 1e3,
        "kilonewtons": 1e3,
        "gf": 9.80665e-3,
        "kp": 9.80665,
        "kg": 9.80665,
        "tf": 9806.65,
        **dict.fromkeys(
            ("tonne", "tonnes", "metric ton", "metric tons", "吨", "吨力", "тонн"), 9806.65
        ),
        **dict.fromkeys(("US ton", "short ton", "short tons"), 2e3 * _POUND),
        **dict.fromkeys(("UK ton", "long ton", "long tons"), 2240 * _POUND),
        **dict.fromkeys(("kgs", "kg.f", "kilogram", "kilograms", "kilogram-force"), 9.80665),
        **dict.fromkeys(("gmf", "grams", "gram-force"), 9.80665e-3),
        **dict.fromkeys(("lbs.", "lb.", "lbf.", "pound-force", "pounds-force"), _POUND),
        "klbs": 1e3 * _POUND,
        "牛": 1,
        "牛顿": 1,
        "千牛": 1e3,
        "Н": 1,
        "кН": 1e3,
        "МН": 1e6,
        "даН": 10,
        "кгс": 9.80665,
        "тс": 9806.65,
        "公斤": 9.80665,
        "公斤力": 9.80665,
        "千克力": 9.80665,
        "뉴턴": 1,
        "ニュートン": 1,
    },
    "length": {
        "mm": 1,
        "cm": 10,
        "m": 1e3,
        "µm": 1e-3,
        "um": 1e-3,
        "micron": 1e-3,
        "microns": 1e-3,
        "millimeter": 1,
        "millimeters": 1,
        "millimetre": 1,
        "millimetres": 1,
        "in": _INCH,
        "in.": _INCH,
        "inch": _INCH,
        "inches": _INCH,
        "mil": 1e-3 * _INCH,
        "mils": 1e-3 * _INCH,
        "thou": 1e-3 * _INCH,
        "毫米": 1,
        "微米": 1e-3,
        "мм": 1,
        "см": 10,
        "м": 1e3,
        "мкм": 1e-3,
    },
    "stress": {
        "MPa": 1,
        "N/mm²": 1,
        "N/mm2": 1,
        "N/mm^2": 1,
        "N/sq.mm": 1,
        "N/sq mm": 1,
        "N mm-2": 1,
        "N·mm-2": 1,
        "N mm^-2": 1,
        "megapascal": 1,
        "GPa": 1e3,
        "kPa": 1e-3,
        "Pa": 1e-6,
        "psi": _PSI,
        "ksi": 1e3 * _PSI,
        "kgf/mm²": 9.80665,
        "kgf/mm2": 9.80665,
        "kgf/cm²": 0.0980665,
        "kgf/cm2": 0.0980665,
        "兆帕": 1,
        "МПа": 1,
        "ГПа": 1e3,
        "кПа": 1e-3,
        "Па": 1e-6,
        "Н/мм²": 1,
        "Н/мм2": 1,
        "кгс/мм²": 9.80665,
        "кгс/мм2": 9.80665,
        "кгс/см²": 0.0980665,
    },
    "strain": {
        "1": 1,
        "-": 1,
        "mm/mm": 1,
        "m/m": 1,
        "in/in": 1,
        "inch/inch": 1,
        "strain": 1,
        "dimensionless": 1,
        "abs": 1,
        "unitless": 1,
        "%": 1e-2,
        "% strain": 1e-2,
        "percent": 1e-2,
        "pct": 1e-2,
        "pct.": 1e-2,
        "per cent": 1e-2,
        "%o": 1e-3,
        "o/oo": 1e-3,
        "10^-3": 1e-3,
        "E-3": 1e-3,
        "mStrain": 1e-3,
        "m strain": 1e-3,
        "me": 1e-3,
        "10^-6": 1e-6,
        "E-6": 1e-6,
        "ppm": 1e-6,
        "microm/m": 1e-6,
        "micro strain": 1e-6,
        "µstr": 1e-6,
        "um/um": 1,
        "um/mm": 1e-3,
        "µm/mm": 1e-3,
        "µm/µm": 1,
        "prozent": 1e-2,
        "‰": 1e-3,
        "mm/m": 1e-3,
        "µε": 1e-6,
        "uε": 1e-6,
        "ue": 1e-6,
        "µm/m": 1e-6,
        "um/m": 1e-6,
        "µstrain": 1e-6,
        "ustrain": 1e-6,
        "microstrain": 1e-6,
        "microstrains": 1e-6,
        "µS": 1e-6,
        "millistrain": 1e-3,
        "mε": 1e-3,
        "мм/мм": 1,
        "м/м": 1,
        "мкм/м": 1e-6,
        "微应变": 1e-6,
        "マイクロひずみ": 1e-6,
        "µd": 1e-6,
    },
    "stretch": {"1": 1, "-": 1, "mm/mm": 1, "m/m": 1},
    "count": {"1": 1, "-": 1},
    "area": {
        "mm²": 1,
        "mm2": 1,
        "mm^2": 1,
        "cm²": 100,
        "cm2": 100,
        "cm^2": 100,
        "in²": _INCH**2,
        "in2": _INCH**2,
        "in^2": _INCH**2,
        "sq in": _INCH**2,
        "мм²": 1,
        "мм2": 1,
        "см²": 100,
        "平方毫米": 1,
    },
}
OTHER_UNITS = frozenset(
    [
        "d",
        "V",
        "mV",
        "mV/V",
        "°C",
        "Cel",
        "°F",
        "K",
        "Nm",
        "deg",
        "°",
        "rad",
        "Hz",
        "MPa/s",
        "N/s",
        "mm/min",
        "mm/s",
        "%/min",
        "1/s",
        "J",
        "mJ",
        "pixel",
        "px",
    ]
)

VOLTS = frozenset(["V", "mV", "mV/V"])
"""Units of a raw signal, which is a quantity only with the calibration of its sensor."""

TONS = frozenset(["ton", "tons", "tonf", "ton-f", "ton force"])
"""Units of force that mean a different force in each country, in lower case."""

DIMENSION = {
    "time": "time",
    "force": "force",
    "stress": "stress",
    "displacement": "length",
    "extension": "length",
    "extension_transverse": "length",
    "strain": "strain",
    "strain_transverse": "strain",
    "strain_back": "strain",
    "strain_xx": "strain",
    "strain_yy": "strain",
    "stretch": "stretch",
    "frame": "count",
    "trigger": "count",
    "x": "count",
    "y": "count",
    "width": "length",
    "thickness": "length",
    "gauge_length": "length",
    "area": "area",
}
"""Quantity → dimension, for all quantities that ingest knows."""

BRACKETS = re.compile(r"\[([^\[\]]*)\]|\(([^()]*)\)|（([^（）]*)）|<([^<>]*)>")
_POWER_OF_TEN = re.compile(
    r"(?i)(?:[x×*·]? ?10 ?(?:\^|e|\*\*)? ?|1?e)[-\u2212] ?0?(?P<power>[36])"
    r"(?: (?:m/m|strain|mm/mm|ε))?"
)
"""A strain in thousandths or millionths: ``×10-6``, ``1e-6``, ``10^-3``."""


def usual_units(dimension: str) -> str:
    """Return the units of a dimension that people write most, for messages."""
    short = [unit for unit in FACTORS[dimension] if unit.isascii() and len(unit) <= _SHORT]
    return f"{', '.join(short[:_SHOWN])}, …" if len(short) > _SHOWN else ", ".join(short)


_SHORT, _SHOWN = 5, 10


def clean_unit(text: str) -> str:
    """Strip brackets and quotes, and write the micro sign and small variants one way."""
    text = unicodedata.normalize("NFC", text).strip().strip('"').strip()
    bracketed = BRACKETS.fullmatch(text)
    if bracketed:
        text = next(group for group in bracketed.groups() if group is not None).strip()
    wide = unicodedata.normalize("NFKC", text) if not text.isascii() else text
    text = wide if any(wide in units for units in FACTORS.values()) else text
    text = re.sub(r"\s*/\s*", "/", text)
    if power := _POWER_OF_TEN.fullmatch(text):
        text = f"10^-{power['power']}"
    return text.replace("\u03bc", "\u00b5").replace("％", "%")


@lru_cache(maxsize=4096)
def find_unit(dimension: str, text: str) -> str | None:
    """Return the table's spelling of a unit of `dimension`, None if it is not one.

    Case counts (mN, MN); other case is accepted where only one unit can be meant (KN, Mpa).
    """
    known = FACTORS[dimension]
    unit = clean_unit(text)
    if unit in known:
        return unit
    same = {name for name in known if name.casefold() == unit.casefold()}
    return same.pop() if len(same) == 1 else None


@lru_cache(maxsize=4096)
def is_unit(text: str) -> bool:
    """Tell whether `text` is a unit of any dimension, even one that ingest does not use."""
    unit = clean_unit(text)
    if unit in OTHER_UNITS or unit.casefold() in TONS:
        return True
    return any(find_unit(dimension, unit) for dimension in FACTORS)


def factor(quantity: str, unit: str) -> float | None:
    """Factor from `unit` to the base unit of `quantity`, None if it is not one of its units."""
    dimension = DIMENSION[quantity]
    found = find_unit(dimension, unit)
    return None if found is None else FACTORS[dimension][found]
