"""The most loaded spokes of a tyre, solved again at their motion for the stress inside them."""

from __future__ import annotations

from dataclasses import fields

from threadpoolctl import threadpool_limits

from nptcs.arrays import Array
from nptcs.fe.output.plate_stress import FaceStress, face_stress, rubber_extremes
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.tyre.responses import deciding_spokes

DIGITS = 6


@threadpool_limits.wrap(limits=1)
def loaded_spokes(
    model: SpokeModel, table: SpokeEnergyTable, motion: Array
) -> tuple[dict[str, list[float]], dict[str, float]]:
    """Stress of the plates and strain of the rubber in the spokes that may have the largest.

    Parameters
    ----------
    model : SpokeModel
    table : SpokeEnergyTable
        Of this spoke; says which spokes of the tyre are loaded most.
    motion : array (spokes, 3)
        (u_r, u_θ, φ) of every foot in the tyre.

    Returns
    -------
    plates : dict of str to list
        ``spoke`` and the columns of `FaceStress`, one row per face of a plate element.
    responses : dict of str to float
        Largest values over these spokes.

    Raises
    ------
    SpokeError
        If a spoke has no equilibrium at its motion.
    """
    names = [field.name for field in fields(FaceStress)]
    columns: dict[str, list[float]] = {name: [] for name in ("spoke", *names)}
    strain, density = 0.0, 0.0
    state = model.rest()
    for number in deciding_spokes(table, motion):
        # start from the previous spoke, loaded almost the same; `move` halves a step that fails
        state = model.move(state, motion[number])
        faces = face_stress(model, state)
        columns["spoke"] += [float(number)] * len(faces.leg)
        for name in names:
            columns[name] += _rounded(getattr(faces, name))
        extremes = rubber_extremes(model, state)
        strain, density = max(strain, extremes[0]), max(density, extremes[1])
    return columns, {
        "plate_largest_mises_mpa": max(columns["mises_mpa"]),
        "plate_largest_mean_mises_mpa": max(columns["mean_mises_mpa"]),
        "plate_largest_along_mpa": max(columns["along_mpa"]),
        "plate_smallest_along_mpa": min(columns["along_mpa"]),
        "plate_largest_across_mpa": max(columns["across_mpa"]),
        "plate_smallest_across_mpa": min(columns["across_mpa"]),
        "plate_largest_shear_mpa": max(map(abs, columns["shear_mpa"])),
        "rubber_largest_principal_strain": strain,
        "rubber_largest_energy_density_n_per_mm2": density,
    }


def _rounded(values: Array) -> list[float]:
    return [float(f"{value + 0.0:.{DIGITS}g}") for value in values]
