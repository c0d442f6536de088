"""Make the site's math font: the glyphs that the pages need, of TeX Gyre Pagella Math.

``python docs/make_math_font.py texgyrepagella-math.otf`` (Debian's package fonts-texgyre-math has
it) writes ``docs/_static/math.woff`` with the tables for typesetting equations. The GUST Font
License requires that a changed font has another name, so the subset has one.
"""

from __future__ import annotations

import sys
from pathlib import Path

from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont

RANGES = [
    (0x20, 0x7E),  # Latin
    (0xA0, 0xFF),
    (0x0300, 0x0338),  # accents
    (0x0370, 0x03FF),  # Greek
    (0x2010, 0x2063),  # dashes, primes, invisible operators
    (0x2190, 0x2193),
    (0x2200, 0x22FF),  # operators
    (0x2308, 0x230B),
    (0x27E8, 0x27E9),
    (0x1D434, 0x1D467),  # italic letters
    (0x1D6A4, 0x1D6A5),
    (0x1D6E2, 0x1D71B),  # italic Greek
    (0x210E, 0x210E),
]
FAMILY = "nptcs docs math"
NAMES = {1: FAMILY, 3: FAMILY, 4: FAMILY, 6: FAMILY.replace(" ", ""), 16: FAMILY}


def main() -> int:
    """Write the subset."""
    font = TTFont(sys.argv[1])
    subsetter = Subsetter(Options(layout_features=["*"], name_IDs=[0, 1, 2, 3, 4, 6, 13, 14, 16]))
    subsetter.populate(unicodes=[code for low, high in RANGES for code in range(low, high + 1)])
    subsetter.subset(font)
    for record in font["name"].names:
        if record.nameID in NAMES:
            record.string = NAMES[record.nameID]
    font["CFF "].cff.fontNames = [NAMES[6]]
    font.flavor = "woff"
    target = Path(__file__).parent / "_static" / "math.woff"
    font.save(target)
    print(f"{target} ({target.stat().st_size / 1000:.0f} kB)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
