"""Spoke tables kept by the content of what they depend on, so that cases share them."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from nptcs.config.fe import EnergyTableOptions, FeModel
from nptcs.fe.case import energy_table
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeDesign
from nptcs.files import atomic_path, sha256_of_text
from nptcs.provenance import code_hash


def table_key(design: SpokeDesign, options: EnergyTableOptions) -> str:
    """SHA-256 over everything that a spoke's table depends on."""
    content: dict[str, Any] = {
        "code": code_hash("nptcs.fe.case"),
        "design": {
            **asdict(design),
            "geometry": design.geometry.model_dump(),
            "mesh": design.mesh.model_dump(),
        },
        "options": options.model_dump(),
    }
    return sha256_of_text(json.dumps(content, sort_keys=True))


def shared_table(model: FeModel, design: SpokeDesign, folder: Path | None) -> SpokeEnergyTable:
    """Read a spoke's table from the folder, or compute it and leave it there.

    Files are written whole under a name made from their content's key: two workers that compute
    the same spoke at the same time leave the same file.

    Parameters
    ----------
    model : FeModel
    design : SpokeDesign
    folder : Path or None
        None computes without keeping.
    """
    if folder is None:
        return energy_table(model, design)
    path = folder / f"{table_key(design, model.table)}.npz"
    with suppress(OSError, ValueError, KeyError, BadZipFile):  # an unreadable file is a miss
        return read_table(path)
    table = energy_table(model, design)
    write_table(path, table)
    return table


def write_table(path: Path, table: SpokeEnergyTable) -> None:
    """Write a table atomically."""
    with atomic_path(path) as temporary, temporary.open("wb") as stream:
        np.savez(
            stream,
            height_mm=np.array(table.height_mm),
            low=table.low,
            high=table.high,
            exponents=table.exponents,
            coefficients=table.coefficients,
            narrowing=np.array(table.narrowing),
            force_residual_n=np.array(table.force_residual_n),
        )


def read_table(path: Path) -> SpokeEnergyTable:
    """Read a table that `write_table` wrote."""
    with np.load(path) as data:
        return SpokeEnergyTable(
            float(data["height_mm"]),
            data["low"],
            data["high"],
            data["exponents"],
            data["coefficients"],
            float(data["narrowing"]),
            float(data["force_residual_n"]),
        )
