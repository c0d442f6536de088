"""How much table 5's unstated rubbers matter: the five calibration designs with other rubbers.

    python benchmarks/fe_rubbers.py

Prints the tyre's stiffness for each pair of rubbers and its change from the assumed pair, both as a
value and as a ratio to the fiducial design (the trend).
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from functools import partial

from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import energy_table, loaded_tyre, spoke_design, tyre_model
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

ASSUMED_SPOKE, ASSUMED_BAND = 1.04, 5.0
SPOKES, BANDS = (1.0, ASSUMED_SPOKE, 1.1), (4.0, ASSUMED_BAND)
# spacing mm, thickness mm, angle degrees; the fiducial first
DESIGNS = (
    (15.0, 1.8, 45.0),
    (20.0, 1.2, 90.0),
    (10.0, 2.4, 0.0),
    (10.0, 1.2, 90.0),
    (20.0, 2.4, 0.0),
)


def stiffness(spoke_c10: float, design: tuple[float, float, float]) -> list[float]:
    """Secant stiffness at 5000 N with each band, N/mm."""
    model, tyre = FeModel(ring="paper_mesh"), TyreGeometry()
    names = ("spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa")
    values = dict(zip(names, (*design, spoke_c10), strict=True))
    table = energy_table(model, spoke_design(model, tyre, PUBLISHED_PLY, values))
    tyres = [tyre_model(model, tyre, table, band) for band in BANDS]
    return [5000.0 / loaded_tyre(assembled, model, 5000.0).rise_mm for assembled in tyres]


def main() -> None:
    """Compute all pairs and print them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", type=int, default=2)
    found: dict[tuple[float, float], list[float]] = {}
    with ProcessPoolExecutor(parser.parse_args().workers) as pool:
        for spoke in SPOKES:
            rows = list(pool.map(partial(stiffness, spoke), DESIGNS))
            for i, band in enumerate(BANDS):
                found[spoke, band] = [row[i] for row in rows]
    base = found[ASSUMED_SPOKE, ASSUMED_BAND]
    for (spoke, band), values in found.items():
        print(f"spokes C10 {spoke:g}, band C10 {band:g} MPa:")
        for design, value, assumed in zip(DESIGNS, values, base, strict=True):
            trend = (value / values[0]) / (assumed / base[0])
            print(
                "  S {:g} T {:g} A {:g}: ".format(*design)
                + f"{value:.2f} N/mm, {100 * (value / assumed - 1):+.2f} %; "
                f"over the fiducial {value / values[0]:.4f}, {100 * (trend - 1):+.2f} %"
            )


if __name__ == "__main__":
    main()
