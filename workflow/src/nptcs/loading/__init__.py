"""What the course of a test tells: its loadings, and whether the specimen failed.

In come force and strain (or travel) in the order of recording, the load positive; out go the rows
of each loading and the evidence of failure. Nothing here knows of files, standards or materials.
"""

from nptcs.loading.cycles import Loading, loadings, noise_of
from nptcs.loading.failure import Failure, judge_failure

__all__ = ["Failure", "Loading", "judge_failure", "loadings", "noise_of"]
