"""Guesses of a spoke's states with the help of other spokes.

Spokes that differ in pitch, plate thickness, fibre angle and rubber only have meshes of the same
nodes. Each state is extrapolated from the spoke's own states before it, and what that missed in
other spokes is added, interpolated between them by ordinary kriging. (Interpolated displacements
themselves stretch the plates, which turn by different angles, and bulge the rubber: from there
Newton's method fails.) The guess says where Newton's method begins. The state that is accepted is
an equilibrium of its own spoke to the same tolerance, whichever spokes were there.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.config.fe import EnergyTableOptions
from nptcs.fe.spoke.equilibrium import SpokeFields
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.spoke.sampling import Place
from nptcs.fe.spoke.stored import read_arrays, write_arrays
from nptcs.files import sha256_of_text
from nptcs.provenance import code_hash

KIND = "corrections of a spoke 1"
# correlation lengths of log pitch, log thickness, angle (degrees) and log C10
LENGTHS = np.array([1.0, 1.0, 45.0, 1.5])
# of the kriging matrix: keeps weights moderate where spokes are close to each other
NUGGET = 1e-6
# neighbours that are read for a spoke, and spokes whose states are kept for others
MOST_READ = 16
MOST_KEPT = 200


@dataclass(frozen=True)
class KeptCorrections:
    """What extrapolation missed in the states of one spoke.

    Parameters
    ----------
    site : array (4,)
        Pitch, thickness, angle and C10 of the spoke, in correlation lengths.
    number : mapping of place to int
        Where the state of a place is in the arrays.
    displacement : array (states, nodes, 3)
        mm, single precision.
    pressures : list of arrays (states, elements, modes)
        In parts of C10, single precision.
    """

    site: Array
    number: dict[Place, int]
    displacement: Array
    pressures: list[Array]


class Neighbours:
    """Other spokes, from which the corrections of one spoke are interpolated."""

    def __init__(self, design: SpokeDesign, spokes: Sequence[KeptCorrections]) -> None:
        self._site, self._c10_mpa = site_of(design), design.c10_mpa
        self._spokes = spokes
        self._weights: dict[tuple[int, ...], Array] = {}

    def correction(self, place: Place) -> SpokeFields | None:
        """Interpolate the corrections of a place; None where fewer than two spokes have one."""
        having = tuple(n for n, spoke in enumerate(self._spokes) if place in spoke.number)
        if len(having) < 2:
            return None
        if having not in self._weights:
            sites = np.array([self._spokes[n].site for n in having])
            self._weights[having] = kriging_weights(sites, self._site)
        weights = self._weights[having]
        states = [(self._spokes[n], self._spokes[n].number[place]) for n in having]
        displacement = _mean(weights, [spoke.displacement[i] for spoke, i in states])
        blocks = range(len(self._spokes[having[0]].pressures))
        return SpokeFields(
            displacement,
            [
                self._c10_mpa * _mean(weights, [spoke.pressures[block][i] for spoke, i in states])
                for block in blocks
            ],
        )


def _mean(weights: Array, parts: Sequence[Array]) -> Array:
    mean: Array = np.tensordot(weights, np.array(parts, dtype=float), axes=1)
    return mean


def kriging_weights(sites: Array, site: Array) -> Array:
    """Weights of ordinary kriging: their sum is 1, so that a constant is kept.

    Parameters
    ----------
    sites : array (n, parameters)
        Where values are known, in correlation lengths (squared exponential).
    site : array (parameters,)
        Where one is wanted.
    """
    count = len(sites)
    matrix = np.ones((count + 1, count + 1))
    distance = np.sum((sites[:, None] - sites) ** 2, axis=2)
    matrix[:count, :count] = np.exp(-0.5 * distance) + NUGGET * np.eye(count)
    matrix[count, count] = 0.0
    right = np.append(np.exp(-0.5 * np.sum((sites - site) ** 2, axis=1)), 1.0)
    weights: Array = np.linalg.solve(matrix, right)[:count]
    return weights


def site_of(design: SpokeDesign) -> Array:
    """Where a spoke is among others, in correlation lengths."""
    site = [
        np.log(design.pitch_mm),
        np.log(design.thickness_mm),
        design.angle_deg,
        np.log(design.c10_mpa),
    ]
    return np.array(site) / LENGTHS


class CorrectionsFolder:
    """Corrections of the spokes of one kind: the same section, mesh, ply and grid of states.

    Parameters
    ----------
    folder : Path
        Of the tables; the corrections are below it.
    design : SpokeDesign
    options : EnergyTableOptions
    """

    def __init__(self, folder: Path, design: SpokeDesign, options: EnergyTableOptions) -> None:
        own = {"pitch_mm", "plates", "thickness_mm", "angle_deg", "c10_mpa"}
        content = {
            "code": code_hash("nptcs.fe.spoke.sampling"),
            "design": {key: value for key, value in asdict(design).items() if key not in own}
            | {"geometry": design.geometry.model_dump(), "mesh": design.mesh.model_dump()},
            "options": options.model_dump(),
        }
        self._key = sha256_of_text(json.dumps(content, sort_keys=True))
        self._folder = folder / "guesses" / self._key[:16]
        self._design = design

    def _path(self, site: Array) -> Path:
        """Name of a spoke's file: its site, so that neighbours are found without reading."""
        return self._folder / ("_".join(f"{value:.9g}" for value in site) + ".npz")

    def neighbours(self) -> Neighbours:
        """Read the spokes nearest to this one; files that are not sound are passed over."""
        own = site_of(self._design)
        sites = [
            site for path in self._folder.glob("[!.]*.npz") if (site := _site(path)) is not None
        ]
        sites.sort(key=lambda site: (float(np.sum((site - own) ** 2)), tuple(site)))
        read = (self._read(site) for site in sites[:MOST_READ])
        return Neighbours(self._design, [states for states in read if states is not None])

    def _read(self, site: Array) -> KeptCorrections | None:
        arrays = read_arrays(self._path(site), f"{KIND} {self._key}")
        if arrays is None:
            return None
        places = {(int(row), int(level)): n for n, (row, level) in enumerate(arrays["places"])}
        pressures = [arrays[name] for name in sorted(arrays) if name.startswith("pressure_")]
        return KeptCorrections(site, places, arrays["displacement"], pressures)

    def keep(self, corrections: dict[Place, SpokeFields]) -> None:
        """Keep the corrections of this spoke, unless there are enough for later guesses."""
        if sum(1 for _ in self._folder.glob("[!.]*.npz")) >= MOST_KEPT:
            return
        found = list(corrections.values())
        arrays = {
            "places": np.array(list(corrections)),
            "displacement": np.array([fields.displacement for fields in found], dtype=np.float32),
        }
        for block in range(len(found[0].pressures)):
            values = np.array([fields.pressures[block] for fields in found])
            arrays[f"pressure_{block}"] = (values / self._design.c10_mpa).astype(np.float32)
        write_arrays(self._path(site_of(self._design)), f"{KIND} {self._key}", arrays)


def _site(path: Path) -> Array | None:
    """Read a site from the name of its file."""
    try:
        return np.array([float(part) for part in path.stem.split("_")])
    except ValueError:
        return None
