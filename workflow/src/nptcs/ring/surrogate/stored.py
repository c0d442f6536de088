"""A surrogate of the spokes as a sealed file, with the model that its tables belong to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.gaussian_process.kernels import Kernel

from nptcs.config.solvers.ring import RingModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.files import read_stored
from nptcs.ring.surrogate.model import DESIGN, SpokeSurrogate, start_kernel
from nptcs.seal import BrokenSealError, open_object, sealed_object

KIND = "SpokeSurrogate"


@dataclass(frozen=True)
class StoredSurrogate:
    """A surrogate, the tyre and the model of its spokes.

    Parameters
    ----------
    surrogate : SpokeSurrogate
    tyre : TyreGeometry
        Its width is that of the spokes.
    model : RingModel
        Section and mesh of the spokes, and the ring's own options.
    study : str
        Study whose spokes they are.
    """

    surrogate: SpokeSurrogate
    tyre: TyreGeometry
    model: RingModel
    study: str


def dump_surrogate(stored: StoredSurrogate) -> str:
    """Write a surrogate as JSON text."""
    surrogate = stored.surrogate
    first = surrogate.tables[0]
    content = {
        "study": stored.study,
        "tyre": stored.tyre.model_dump(mode="json"),
        "model": stored.model.model_dump(mode="json", include=set(RingModel.model_fields)),
        "ply": surrogate.ply,
        "designs": surrogate.designs.tolist(),
        "unfitted": surrogate.unfitted.tolist(),
        "thetas": [kernel.theta.tolist() for kernel in surrogate.kernels],
        "height_mm": first.height_mm,
        "straight_mm": first.straight_mm,
        "low": first.low.tolist(),
        "high": first.high.tolist(),
        "narrowing": first.narrowing,
        "exponents": first.exponents.tolist(),
        "coefficients": [table.coefficients.tolist() for table in surrogate.tables],
        "force_residual_n": [table.force_residual_n for table in surrogate.tables],
    }
    return sealed_object(content, KIND)


def read_surrogate(path: str | Path) -> StoredSurrogate:
    """Read a file that contains what `dump_surrogate` wrote.

    Raises
    ------
    InputError
        For a file that is missing, damaged or edited.
    """
    try:
        content = open_object(read_stored(path, "surrogate of the spokes"), KIND)
    except BrokenSealError as error:
        remedy = "write it again: nptcs surrogate fit"
        raise InputError(f"this surrogate cannot be used: {error}", remedy, path) from None
    return StoredSurrogate(
        SpokeSurrogate(
            np.array(content["designs"]),
            _tables(content),
            content["ply"],
            _kernels(content),
            np.array(content["unfitted"]).reshape(-1, len(DESIGN)),
        ),
        TyreGeometry.model_validate(content["tyre"]),
        RingModel.model_validate(content["model"]),
        content["study"],
    )


def _tables(content: Mapping[str, Any]) -> list[SpokeEnergyTable]:
    rows = zip(content["coefficients"], content["force_residual_n"], strict=True)
    return [
        SpokeEnergyTable(
            height_mm=content["height_mm"],
            straight_mm=content["straight_mm"],
            low=np.array(content["low"]),
            high=np.array(content["high"]),
            exponents=np.array(content["exponents"], dtype=np.int64),
            coefficients=np.array(coefficients),
            narrowing=content["narrowing"],
            force_residual_n=residual,
        )
        for coefficients, residual in rows
    ]


def _kernels(content: Mapping[str, Any]) -> list[Kernel]:
    return [start_kernel().clone_with_theta(np.array(theta)) for theta in content["thetas"]]
