"""Write the example data of a seed: raw files, specimen sheet, README."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import assert_never

import numpy as np

from nptcs.example import exports, truth
from nptcs.example.tests import (
    Draw,
    Readings,
    cell_force,
    draw,
    from_preload,
    load_to_break,
    not_simulated,
    with_noise,
    with_toe,
)
from nptcs.example.truth import Series
from nptcs.files import atomic_path, write_text
from nptcs.mechanical_tests import TestType

SEED = 20240529
CAMERA_NOISE = 1.5e-5
GAUGE_NOISE = 4e-6
EXTENSOMETER_NOISE_MM = 0.004
FORCE_FORMATS = {TestType.COMPRESSION: "testxpert-de-dms"}  # the others are detected
SHEET_COLUMNS = (
    "specimen",
    "test",
    "material",
    "orientation_deg",
    "width_mm",
    "thickness_mm",
    "gauge_length_mm",
    "force_file",
    "force_format",
    "strain_file",
    "strain_format",
    "strain_axis",
    "include",
    "reason",
    "origin",
    "remarks",
)
README = """SYNTHETIC data: made by a program, measured by nobody.

`nptcs example --seed {seed} FOLDER` writes this folder again, to the byte.

The truth behind the files is table 2 of the paper (E1 128000, E2 8800, G12 3147 MPa,
nu12 0.357), its C10 values within 15 % strain (1.18, 2.91, 4.77 MPa for 75A, 88A, 92A) and the
specimen sizes of its table 1 and section 2.2. Each specimen has its own modulus, Poisson's ratio,
strength and size, drawn around these; each channel has noise, preload or toe.

| series | files | traps |
|---|---|---|
| T0 | WDW machine (GBK, kN) and VIC-3D (semicolon, group row) | two rates, lost frames, exx and \
eyy change places |
| T90 | Bluehill (CSV, quoted, strain in %) | preload; T90-6 broke in the grip and is left out |
| C0, C90 | testXpert (German, latin-1, decimal comma) | compression positive, strain gauges on \
two faces, the sheet names the profile |
| S45 | Bluehill (CSV) and VIC-3D | two rates, two clocks on one trigger |
| R75, R88, R92 | Bluehill (CSV, extensometer in mm) | preload and toe |

Strengths are typical of such materials and come from no test.
"""


def generate(folder: Path, seed: int = SEED) -> None:
    """Write all example files into `folder`.

    Parameters
    ----------
    folder : Path
        Created if needed; files of the same name are replaced.
    seed : int
        Equal seeds give equal files.
    """
    rows = []
    for index, series in enumerate(truth.SERIES):
        for number in range(1, series.count + 1):
            random = np.random.default_rng([seed, index, number])
            specimen = draw(series, number, random)
            files = _files(series, specimen, number, random)
            for name, content in files.items():
                with atomic_path(folder / name) as temporary:
                    temporary.write_bytes(content)
            rows.append(_sheet_row(series, specimen, list(files)))
    write_text(folder / "specimens.csv", _sheet(rows))
    write_text(folder / "README.md", README.format(seed=seed))


def _files(
    series: Series, specimen: Draw, number: int, random: np.random.Generator
) -> dict[str, bytes]:
    """Raw files of one specimen: name → content; the force file first."""
    match series.test:
        case TestType.RUBBER_TENSION:
            return _rubber(series, specimen, random)
        case TestType.COMPRESSION:
            return _compression(series, specimen, random)
        case TestType.SHEAR:
            return _shear(series, specimen, random)
        case TestType.TENSION:
            if series.orientation_deg == 0:
                return _tension_0(series, specimen, number, random)
            return _tension_90(series, specimen, random)
        case (
            TestType.RUBBER_EQUIBIAXIAL
            | TestType.RUBBER_PURE_SHEAR
            | TestType.RUBBER_COMPRESSION
            | TestType.FLEXURE
        ):
            raise not_simulated(series.test)
        case _:
            assert_never(series.test)


def _tension_0(
    series: Series, specimen: Draw, number: int, random: np.random.Generator
) -> dict[str, bytes]:
    """WDW machine at 4 Hz and VIC-3D at 2 Hz; the camera's x axis changes with its mounting."""
    machine = load_to_break(series, specimen, 4.0)
    travel = with_toe(machine.axial * 130.0, machine.force_n, 0.25, 900.0)
    machine_file = exports.wdw_gbk(machine.time_s, travel, cell_force(machine, random))
    camera = _broken_off(load_to_break(series, specimen, 2.0))
    axial = with_noise(camera.axial, CAMERA_NOISE, random)
    across = with_noise(camera.transverse, CAMERA_NOISE, random)
    axial[40:43] = across[40:43] = np.nan
    pair = (across, axial) if number % 2 else (axial, across)
    shear = with_noise(0 * camera.axial, CAMERA_NOISE, random)
    strain = exports.vic_3d(camera.time_s, *pair, shear)
    return {f"{specimen.name}_wdw.txt": machine_file, f"{specimen.name}_vic3d.csv": strain}


def _broken_off(readings: Readings) -> Readings:
    """Frames up to the break: the camera loses the speckles with it."""
    last = int(np.argmax(np.abs(readings.force_n))) + 1
    return Readings(
        readings.time_s[:last],
        readings.force_n[:last],
        readings.axial[:last],
        readings.transverse[:last],
    )


def _tension_90(series: Series, specimen: Draw, random: np.random.Generator) -> dict[str, bytes]:
    """Bluehill with two strain channels in percent; the record starts at a preload."""
    readings = from_preload(load_to_break(series, specimen, 8.0), 40.0)
    columns = {
        ("Time", "s"): readings.time_s,
        ("Extension", "mm"): readings.axial * 125.0,
        ("Load", "kN"): cell_force(readings, random) / 1000,
        ("Strain 1", "%"): 100 * with_noise(readings.axial, GAUGE_NOISE, random),
        ("Strain 2", "%"): 100 * with_noise(readings.transverse, GAUGE_NOISE, random),
    }
    content = exports.bluehill_csv(specimen, columns, "synthetic")
    return {f"{specimen.name}.csv": content}


def _compression(series: Series, specimen: Draw, random: np.random.Generator) -> dict[str, bytes]:
    """Strain on testXpert, compression positive, strain on both faces of a slightly bent bar."""
    readings = load_to_break(series, specimen, 5.0)
    bending = 0.04 * random.uniform(-1, 1)
    front, back = (-readings.axial * (1 + side * bending) for side in (1, -1))
    columns = {
        ("Prüfzeit", "s"): readings.time_s,
        ("Standardweg", "mm"): -readings.axial * 14.0,
        ("Standardkraft", "N"): -cell_force(readings, random),
        ("DMS vorn", "%"): 100 * with_noise(front, GAUGE_NOISE, random),
        ("DMS hinten", "%"): 100 * with_noise(back, GAUGE_NOISE, random),
    }
    content = exports.testxpert_german(specimen, columns, series.gauge_length_mm)
    return {f"{specimen.name}.TRA": content}


def _shear(series: Series, specimen: Draw, random: np.random.Generator) -> dict[str, bytes]:
    """Bluehill at 4 Hz and VIC-3D at 2 Hz on one trigger."""
    machine = load_to_break(series, specimen, 4.0)
    columns = {
        ("Time", "s"): machine.time_s,
        ("Extension", "mm"): machine.axial * 138.0,
        ("Load", "kN"): cell_force(machine, random) / 1000,
    }
    camera = _broken_off(load_to_break(series, specimen, 2.0))
    axial = with_noise(camera.axial, CAMERA_NOISE, random)
    across = with_noise(camera.transverse, CAMERA_NOISE, random)
    shear = with_noise(0 * camera.axial, CAMERA_NOISE, random)
    return {
        f"{specimen.name}.csv": exports.bluehill_csv(specimen, columns, "synthetic"),
        f"{specimen.name}_vic3d.csv": exports.vic_3d(camera.time_s, axial, across, shear),
    }


def _rubber(series: Series, specimen: Draw, random: np.random.Generator) -> dict[str, bytes]:
    """Bluehill with a long-travel extensometer in mm, preload, and a toe of about 0.3 %."""
    readings = from_preload(load_to_break(series, specimen, 6.0), 0.3)
    toe = random.uniform(0.002, 0.004)
    scale = 0.0025 * float(readings.force_n.max())
    strain = with_toe(readings.axial, readings.force_n - readings.force_n[0], toe, scale)
    length = series.gauge_length_mm
    columns = {
        ("Time", "s"): readings.time_s,
        ("Extension", "mm"): strain * 1.7 * length,
        ("Load", "N"): cell_force(readings, random),
        ("Extensometer", "mm"): with_noise(strain * length, EXTENSOMETER_NOISE_MM, random),
    }
    content = exports.bluehill_csv(specimen, columns, "synthetic")
    return {f"{specimen.name}.csv": content}


def _sheet_row(series: Series, specimen: Draw, files: list[str]) -> dict[str, str]:
    left_out = truth.LEFT_OUT.get(specimen.name, "")
    orientation = series.orientation_deg
    return {
        "specimen": specimen.name,
        "test": series.test.value,
        "material": series.material,
        "orientation_deg": "" if orientation is None else f"{orientation:g}",
        "width_mm": ";".join(f"{station:.2f}" for station in specimen.width_mm),
        "thickness_mm": ";".join(f"{station:.3f}" for station in specimen.thickness_mm),
        "gauge_length_mm": f"{series.gauge_length_mm:g}",
        "force_file": files[0],
        "force_format": FORCE_FORMATS.get(series.test, ""),
        "strain_file": files[1] if len(files) > 1 else "",
        "include": "no" if left_out else "yes",
        "reason": left_out,
        "origin": "synthetic",
        "remarks": "made by 'nptcs example', see README.md",
    }


def _sheet(rows: list[dict[str, str]]) -> str:
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, SHEET_COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
