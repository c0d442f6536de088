"""Spoke tables stored under a hash of everything that they depend on, so that cases share them."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from nptcs.config.solvers.fe import EnergyTableOptions, FeModel
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.spoke.sampling import computed_table
from nptcs.fe.spoke.stored import read_arrays, write_arrays
from nptcs.files import sha256_of_text
from nptcs.provenance import code_hash

KIND = "energy table of a spoke 3"


def table_key(design: SpokeDesign, options: EnergyTableOptions) -> str:
    """SHA-256 over everything that a spoke's table depends on."""
    content: dict[str, Any] = {
        "code": code_hash("nptcs.fe.spoke.sampling"),
        "design": {
            **asdict(design),
            "geometry": design.geometry.model_dump(),
            "mesh": design.mesh.model_dump(),
        },
        "options": options.model_dump(),
    }
    return sha256_of_text(json.dumps(content, sort_keys=True))


@threadpool_limits.wrap(limits=1)
def shared_table(model: FeModel, design: SpokeDesign, folder: Path | None) -> SpokeEnergyTable:
    """Read a spoke's table from the folder, or compute it and store it there.

    Files are written atomically under the key of everything they depend on: if two workers compute
    the same spoke at the same time, the later one replaces the file with an equal one.

    Parameters
    ----------
    model : FeModel
    design : SpokeDesign
    folder : Path or None
        None computes the table without storing it.
    """
    if folder is None:
        return computed_table(design, model.table)
    key = table_key(design, model.table)
    path = folder / f"{key}.npz"
    known = read_energy_table(path, key)
    if known is not None:
        return known
    table = computed_table(design, model.table)
    write_energy_table(path, key, table)
    return table


def write_energy_table(path: Path, key: str, table: SpokeEnergyTable) -> None:
    """Write a table atomically, with its key and a checksum."""
    arrays = {
        "height_mm": np.array(table.height_mm),
        "straight_mm": np.array(table.straight_mm),
        "low": table.low,
        "high": table.high,
        "exponents": table.exponents,
        "coefficients": table.coefficients,
        "narrowing": np.array(table.narrowing),
        "force_residual_n": np.array(table.force_residual_n),
    }
    write_arrays(path, f"{KIND} {key}", arrays)


def read_energy_table(path: Path, key: str) -> SpokeEnergyTable | None:
    """Read what `write_energy_table` wrote; None if there is no intact table under this key."""
    data = read_arrays(path, f"{KIND} {key}")
    if data is None:
        return None
    return SpokeEnergyTable(
        float(data["height_mm"]),
        float(data["straight_mm"]),
        data["low"],
        data["high"],
        data["exponents"].astype(np.int64),
        data["coefficients"],
        float(data["narrowing"]),
        float(data["force_residual_n"]),
    )
