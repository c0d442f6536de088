"""A tension test about which everything is known, in the export formats of many programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.ingest import ingest_specimen
from nptcs.reduce import reduce_record
from nptcs.tables.laboratory.specimens import Specimen

E_MPA, AREA_MM2, ULTIMATE = 120_000.0, 10.0, 0.012
LOADED, AFTER = 300, 12
TIME = np.arange(LOADED + AFTER) / 5
STRAIN = np.append(np.linspace(0, ULTIMATE, LOADED), np.full(AFTER, 0.3 * ULTIMATE))
ACROSS = -0.3 * STRAIN
FORCE = np.where(TIME < LOADED / 5, E_MPA * AREA_MM2 * STRAIN, 15.0)
FORCE = FORCE + np.random.default_rng(3).standard_normal(len(TIME))
TRAVEL = np.append(np.linspace(0, 2.4, LOADED), 2.4 + 0.008 * np.arange(1, AFTER + 1))
EXTENSION = 50 * STRAIN
KN, PERCENT, MICRO = FORCE / 1e3, 100 * STRAIN, 1e6 * STRAIN
FULL = {"modulus": E_MPA, "strength": E_MPA * ULTIMATE, "ultimate_strain": ULTIMATE}
WITH_NU = FULL | {"poisson_ratio": 0.3}
LENGTH = {"gauge_length_mm": 50.0}


def export(
    columns: Mapping[str, Any],
    by: str = ",",
    decimal: str = ".",
    units: Sequence[str] = (),
    head: Sequence[str] = (),
    quoted: bool = False,
    lead: str = "",
    row: str = "",
) -> str:
    """Write columns under their names, as a program does; `row` formats a row in its own way."""

    def line(cells: Sequence[str]) -> str:
        return by.join(f'"{cell}"' if quoted else cell for cell in cells)

    def cell(value: Any) -> str:
        return value if isinstance(value, str) else f"{value:.7g}".replace(".", decimal)

    values = zip(*columns.values(), strict=True)
    rows = [row.format(*one) if row else line([cell(value) for value in one]) for one in values]
    names = [lead + line(list(columns)), *([line(units)] if units else [])]
    return "\n".join([*head, *names, *rows]) + "\n"


def reduced(folder: Path, profiles: Any, content: str | bytes, **fields: Any) -> Any:
    name = str(fields.setdefault("force_file", "a.csv"))
    raw = content if isinstance(content, bytes) else content.encode()
    (folder / name).write_bytes(raw)
    standard: dict[str, Any] = {
        "specimen": "S", "test": "tension", "material": "m", "orientation_deg": 0,
        "width_mm": (10.0,), "thickness_mm": (1.0,),
    }  # fmt: skip
    specimen = Specimen(**(standard | fields))
    done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
    table = reduce_record(done.curve, specimen, done.record, ReductionSettings())
    return table.set_index("property"), done.record
