"""What the load-bearing model needs to be solved in the browser: the ring's section, the spokes."""

from __future__ import annotations

from scipy.interpolate import PchipInterpolator

from nptcs.lca.section import section_stiffness
from nptcs.lca.spokes.stiffness_table import SpokeStiffnessTable
from nptcs.report.data import Results
from nptcs.report.explorer.shared import Plain


def ring_payload(results: Results) -> Plain | None:
    """Return the ring and its spokes as plain values; None where no study is solved by ``lca``.

    EA, GA and EI are straight lines in the band's C10: their values at 0 and 1 MPa describe them.
    """
    given = results.lca_ring
    if given is None:
        return None
    tyre = results.config.tyre
    dimensions = tyre.model_dump()
    at_zero = section_stiffness(dimensions, 0.0, given.section)
    at_one = section_stiffness(dimensions, 1.0, given.section)
    table = SpokeStiffnessTable.from_rows(given.rows)
    return {
        "section": [
            [float(zero), float(one - zero)] for zero, one in zip(at_zero, at_one, strict=True)
        ],
        "kind": given.section,
        "table": given.file,
        "radius_mm": tyre.band_radius_mm,
        "outer_radius_mm": tyre.outer_diameter_mm / 2,
        "rim_radius_mm": tyre.rim_diameter_mm / 2,
        "width_mm": tyre.tread_width_mm,
        "spoke_count": tyre.spoke_count,
        "c10_mpa": table.c10_mpa.tolist(),
        "tension": _cubics(table, "tension_n_per_mm"),
        "compression": _cubics(table, "compression_n_per_mm"),
    }


def _cubics(table: SpokeStiffnessTable, column: str) -> list[list[float]]:
    """Coefficients of the monotone cubic on each interval, highest power first."""
    cubics = PchipInterpolator(table.c10_mpa, getattr(table, column)).c
    return [[float(value) for value in row] for row in cubics.T]
