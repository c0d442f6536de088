"""The load-bearing analysis model (LCA): a Timoshenko ring on spokes, pressed onto flat ground.

The paper's section 3.3, solved exactly: ``solve`` for one design, ``curve`` for its load–
displacement curve, ``solve_batch`` for a table of designs.
"""

from nptcs.lca.batch import Batch, solve_batch
from nptcs.lca.section import RingSection
from nptcs.lca.single import ModelError, curve, solve
from nptcs.lca.spokes import LinearSpokes
from nptcs.lca.state import LcaState

__all__ = [
    "Batch",
    "LcaState",
    "LinearSpokes",
    "ModelError",
    "RingSection",
    "curve",
    "solve",
    "solve_batch",
]
