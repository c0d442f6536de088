"""Which surface answers where none is named: one rule for reference designs and decisions."""

from __future__ import annotations

from nptcs.config.studies.study import Study
from nptcs.config.studies.surface import GaussianProcessModel, surface_name
from nptcs.surface.kinds.models import models_of
from nptcs.surface.registry import STIFFNESS, SurfaceRegistry

ALWAYS = GaussianProcessModel(kind="gaussian_process")
"""A surface that every study with factors has, whether it lists it or not."""


def answering_surface(
    asked: str | None,
    preferred: str | None,
    study: Study,
    solver: str,
    registry: SurfaceRegistry | None,
) -> str:
    """Name the surface through which the stiffness of a study's designs is predicted.

    The configured decisions and ``nptcs design`` both use this, so they give the same answer.

    Parameters
    ----------
    asked : str or None
        Named by the decision or by ``--surface``: always taken.
    preferred : str or None
        Named by ``uncertainty.surface``: taken if the study has it.
    study : Study
    solver : str
        Solver whose cases the surface was fitted to.
    registry : SurfaceRegistry or None
        The study's stored surfaces. Where none is named, the surface of its stiffness with the
        smallest rms error at left-out cases is taken.

    Returns
    -------
    str
        As `surface_name` writes it; the Gaussian process on the mean if no stored surface has been
        tested.
    """
    if asked is not None:
        return asked
    if preferred in {surface_name(ALWAYS), *models_of(study)}:
        return str(preferred)
    stored = registry.surfaces if registry is not None else ()
    tested = [
        one
        for one in stored
        if one.solver == solver
        and one.response.name == STIFFNESS
        and one.left_out_rms == one.left_out_rms  # assessed
    ]
    best = min(tested, key=lambda one: one.left_out_rms, default=None)
    return best.name if best is not None else surface_name(ALWAYS)
