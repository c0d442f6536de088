"""What the course of a test shows: its loadings, and whether the specimen failed.

Force and strain (or travel) in the order of recording come in, with the load positive; the rows of
each loading and the evidence of failure go out. Files, standards and materials are not known here.
"""

from nptcs.loading.cycles import Loading, loadings, noise_of
from nptcs.loading.failure import Failure, judge_failure

__all__ = ["Failure", "Loading", "judge_failure", "loadings", "noise_of"]
