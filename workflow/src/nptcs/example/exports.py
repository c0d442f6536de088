"""Export files as machines and cameras write them: one function per format."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from nptcs.arrays import Array
from nptcs.example.tests import Draw

CRLF = "\r\n"


def _lines(columns: Sequence[tuple[Array, str]], delimiter: str, decimal: str = ".") -> list[str]:
    """Rows of numbers; each column has its own number format."""
    texts = [[format(value, style) for value in values] for values, style in columns]
    return [delimiter.join(row).replace(".", decimal) for row in zip(*texts, strict=True)]


def bluehill_csv(specimen: Draw, columns: Mapping[tuple[str, str], Array], note: str) -> bytes:
    """Instron Bluehill, English: results table, a blank line, names, units, quoted numbers."""
    header = [
        "Results Table 1",
        ",Width (mm),Thickness (mm),Specimen label",
        f'1,"{np.mean(specimen.width_mm):.3f}","{np.mean(specimen.thickness_mm):.3f}",'
        f"{specimen.name}",
        "",
        f"Specimen note,{note}",
        "",
        "Raw Data Table 1",
        ",".join(name for name, _ in columns),
        ",".join(f"({unit})" for _, unit in columns),
    ]
    rows = _lines([(values, ".6f") for values in columns.values()], '","')
    return (CRLF.join([*header, *(f'"{row}"' for row in rows)]) + CRLF).encode("utf-8")


def testxpert_german(
    specimen: Draw, columns: Mapping[tuple[str, str], Array], gauge_length_mm: float
) -> bytes:
    """Zwick testXpert, German: tab, decimal comma, latin-1, key-value header."""

    def number(value: float) -> str:
        return f"{value:.3f}".replace(".", ",")

    header = [
        f'"Prüfnorm"\t"ASTM D6641"\t""\t"{specimen.name}"',
        f'"Probenbreite b0"\t{number(float(np.mean(specimen.width_mm)))}\t"mm"',
        f'"Probendicke a0"\t{number(float(np.mean(specimen.thickness_mm)))}\t"mm"',
        f'"Messlänge"\t{number(gauge_length_mm)}\t"mm"',
        '"Prüfgeschwindigkeit"\t1,300\t"mm/min"',
        '"Bemerkung"\t"synthetisch"\t""',
        "\t".join(f'"{name}"' for name, _ in columns),
        "\t".join(f'"{unit}"' for _, unit in columns),
    ]
    rows = _lines([(values, ".6g") for values in columns.values()], "\t", ",")
    return (CRLF.join([*header, *rows]) + CRLF).encode("latin-1")


def wdw_gbk(time: Array, travel: Array, force: Array) -> bytes:
    """WDW-type machine, Chinese: three columns, GBK, force in kN, bare names."""
    rows = _lines([(time, ".2f"), (travel, ".4f"), (force / 1000, ".5f")], "\t")
    return (CRLF.join(["时间(s)\t位移(mm)\t力(kN)", *rows]) + CRLF).encode("gbk")


def vic_3d(time: Array, strain_xx: Array, strain_yy: Array, shear: Array) -> bytes:
    """VIC-3D, mean strain of an area: a group row above quoted names; empty for a lost frame."""
    header = [
        '"Average";;;;;',
        '"Count";"Time [s]";"exx [1] - Lagrange";"eyy [1] - Lagrange";"exy [1] - Lagrange";',
    ]
    frames = np.arange(len(time), dtype=float)
    strains = [(values, ".7f") for values in (strain_xx, strain_yy, shear)]
    rows = _lines([(frames, ".0f"), (time, ".3f"), *strains], ";")
    rows = [row.replace("nan", "") + ";" for row in rows]
    return ("\n".join([*header, *rows]) + "\n").encode("ascii")
