"""The load-bearing analysis model (LCA): a Timoshenko ring on spokes, pressed onto flat ground.

A ring section, spokes and a load come in, the loaded ring goes out. It is the paper's section 3.3,
solved exactly: ``solve`` for one design, ``curve`` for its load–displacement curve,
``solve_batch`` for a table of designs; ``solve_law`` for spokes whose force follows a curve or that
act one by one. Comparing with the paper belongs to `nptcs.compare`.
"""

from nptcs.lca.any_spokes.with_law import LawState, solve_law, stiffness_ripple
from nptcs.lca.batch import Batch, solve_batch
from nptcs.lca.section import ShearBandSection
from nptcs.lca.single import ModelError, curve, solve
from nptcs.lca.spokes.law import SpokeLaw
from nptcs.lca.spokes.linear import LinearSpokes
from nptcs.lca.state import LcaState

__all__ = [
    "Batch",
    "LawState",
    "LcaState",
    "LinearSpokes",
    "ModelError",
    "ShearBandSection",
    "SpokeLaw",
    "curve",
    "solve",
    "solve_batch",
    "solve_law",
    "stiffness_ripple",
]
