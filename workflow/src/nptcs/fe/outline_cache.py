"""Outlines of loaded tyres, stored under a hash of everything that they depend on.

Drawing one solves the tyre and each of its spokes again, so outlines drawn before are read.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import loaded_tyre, spoke_design, tyre_model
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.output.outlines import COORDINATES, tyre_outlines
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.stored import read_arrays, write_arrays
from nptcs.files import sha256_of_text
from nptcs.provenance import code_hash
from nptcs.tables.tyres.deformed_tyre import PARTS

KIND = "outlines of a tyre 1"


@dataclass(frozen=True)
class DrawnCase:
    """A case that was solved, and what its solver was given.

    Parameters
    ----------
    key : str
        Of its record: a hash of everything that decides its result, including the solver's code.
    values : mapping of str to float
        Factors of the case.
    load_n : float
    options : FeModel
    tyre : TyreGeometry
    ply : mapping of str to float
        The nine ply constants.
    """

    key: str
    values: Mapping[str, float]
    load_n: float
    options: FeModel
    tyre: TyreGeometry
    ply: Mapping[str, float]


def shared_outlines(case: DrawnCase, folder: Path, spokes: Path | None) -> pd.DataFrame:
    """Read the outlines of a loaded tyre from the folder, or draw them and store them there.

    Parameters
    ----------
    case : DrawnCase
    folder : Path
        Files are written atomically under the key of everything they depend on.
    spokes : Path or None
        Folder of spoke tables; None computes them without storing them.

    Returns
    -------
    DataFrame
        As `tyre_outlines`.

    Raises
    ------
    SpokeError, TyreError
        If the tyre or a spoke has no equilibrium.
    """
    key = sha256_of_text(f"{case.key} {code_hash(__name__)}")
    path = folder / f"{key}.npz"
    known = read_outlines(path, key)
    if known is not None:
        return known
    design = spoke_design(case.options, case.tyre, case.ply, case.values)
    table = shared_table(case.options, design, spokes)
    model = tyre_model(case.options, case.tyre, table, case.values["shear_band_c10_mpa"])
    state = loaded_tyre(model, case.options, case.load_n)
    rows = tyre_outlines(model, state, SpokeModel(design))
    write_outlines(path, key, rows)
    return rows


def write_outlines(path: Path, key: str, rows: pd.DataFrame) -> None:
    """Write outlines atomically, with their key and a checksum."""
    arrays = {
        "part": np.array([PARTS.index(part) for part in rows["part"]]),
        "outline": rows["outline"].to_numpy(int),
        "coordinates": rows[COORDINATES].to_numpy(float),
    }
    write_arrays(path, f"{KIND} {key}", arrays)


def read_outlines(path: Path, key: str) -> pd.DataFrame | None:
    """Read what `write_outlines` wrote; None if there are no intact outlines under this key."""
    data = read_arrays(path, f"{KIND} {key}")
    if data is None:
        return None
    rows = pd.DataFrame(data["coordinates"], columns=COORDINATES)
    rows.insert(0, "outline", data["outline"])
    rows.insert(0, "part", np.array(PARTS, dtype=object)[data["part"]])
    return rows
