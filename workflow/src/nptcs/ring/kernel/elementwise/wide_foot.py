"""A spoke's foot that covers several nodes: the squeeze of the band under it."""

from __future__ import annotations

from nptcs.ring.kernel.compiled import compilable
from nptcs.ring.kernel.elementwise.places import Value


@compilable
def squeeze_step(
    soft_r: Value, soft_turn: Value, stiff: Value, gap_r: Value, gap_turn: Value
) -> tuple[Value, Value]:
    """Solve (1 + C K) x = gap for u_r and φ; C has the squeeze of the band under a foot."""
    a, b = 1.0 + soft_r * stiff[0, 0], soft_r * stiff[0, 2]
    c, d = soft_turn * stiff[2, 0], 1.0 + soft_turn * stiff[2, 2]
    inverse = 1.0 / (a * d - b * c)
    return inverse * (d * gap_r - b * gap_turn), inverse * (a * gap_turn - c * gap_r)


@compilable
def squeezed_stiffness(soft_r: Value, soft_turn: Value, stiff: Value, hold: Value) -> None:
    """Set `hold` (3, 3) to K (1 + C K)⁻¹, K the stiffness of a spoke."""
    for j in range(3):
        by_r, by_turn = squeeze_step(
            soft_r, soft_turn, stiff, soft_r * stiff[0, j], soft_turn * stiff[2, j]
        )
        for i in range(3):
            hold[i, j] = stiff[i, j] - stiff[i, 0] * by_r - stiff[i, 2] * by_turn
