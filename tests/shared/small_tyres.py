"""One design of the paper, and the coarsest finite elements that solve it, for tests of many rooms.

Their numbers mean nothing: tests look at what must hold on any mesh.
"""

from nptcs.config.solvers.fe import EnergyTableOptions, SpokeGeometry, SpokeMesh
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

VALUES = {
    "spacing_mm": 15.0,
    "thickness_mm": 1.8,
    "angle_deg": 45.0,
    "spoke_c10_mpa": 3.0,
    "shear_band_c10_mpa": 5.0,
}
COARSE_SPOKE = SpokeMesh(rows=(1, 1, 1, 1, 1, 1))
COARSE_TABLE = EnergyTableOptions(
    elongation_mm=(-12.0, 5.0),
    inclination_rad=0.1,
    phi_rad=(-0.08, 0.08),
    samples=(4, 3, 3),
    degrees=(6, 4),
)


def spoke_design(**change):
    """One spoke of the paper's middle design on the coarsest mesh, with changes."""
    values = {
        "geometry": SpokeGeometry(),
        "mesh": COARSE_SPOKE,
        "pitch_mm": 15.0,
        "plate_width_mm": 5.0,
        "thickness_mm": 1.8,
        "angle_deg": 45.0,
        "c10_mpa": 1.0,
        "ply": PUBLISHED_PLY,
        "plates": 14,
        "plate_coupling": "embedded",
    }
    return SpokeDesign(**{**values, **change})
