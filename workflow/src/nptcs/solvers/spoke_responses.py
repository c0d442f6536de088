"""The stiffness of a single spoke as a solver reports it: lines through the origin, table 10."""

from __future__ import annotations

from nptcs.fe.spoke.stiffness_line import StiffnessLine


def spoke_responses(tension: StiffnessLine, compression: StiffnessLine) -> dict[str, float]:
    """Return `nptcs.solvers.contract.SPOKE_RESPONSES`: k_t, k_c (N/mm) and R² of both lines."""
    return {
        f"{direction}_{quantity}": value
        for direction, line in (("tension", tension), ("compression", compression))
        for quantity, value in (
            ("stiffness_n_per_mm", line.slope),
            ("r2_uncentred", line.r2_uncentred),
            ("r2_centred", line.r2_centred),
        )
    }
